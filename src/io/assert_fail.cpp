// The function that assertions of the C++ library call where they are on (UNSNARL_CHECKED): the layers from this one
// up. The one of libstdc++ came with GCC 12; with one of our own, program and wheel run where there is an older one
// (RHEL 9).
#include <cstdio>
#include <cstdlib>

#ifdef __GLIBCXX__
namespace std {

__attribute__((__noreturn__)) void __glibcxx_assert_fail(const char* file, int line, const char* function,
                                                         const char* condition) noexcept {
  std::fprintf(stderr, "%s:%d: %s: Assertion '%s' failed.\n", file, line, function, condition);
  std::abort();
}

}  // namespace std
#endif
