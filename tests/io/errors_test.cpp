#include "unsnarl/errors.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

namespace unsnarl {
namespace {

template <class Error, class Throw>
void expect_thrown(Throw throw_error, int error_number, const std::string& reason) {
  try {
    throw_error("a.obj: cannot open", error_number, "");
    ADD_FAILURE() << "nothing is thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), "a.obj: cannot open: " + reason);
    EXPECT_EQ(error.error_number(), error_number);
  }
}

void throw_write_error_of(const std::string& message, int error_number, const std::string&) {
  throw_write_error(message, error_number);
}

TEST(Errors, what_a_path_is_the_reason_of_is_an_error_of_the_file) {
  for (const int number : {ENOENT, EACCES, EISDIR, ENOTDIR, ELOOP, ENAMETOOLONG, ENOSPC, EROFS})
    EXPECT_FALSE(is_error_of_system(number)) << number;
  expect_thrown<FileError>(throw_read_error, ENOENT, "No such file or directory");
  expect_thrown<WriteError>(throw_write_error_of, EACCES, "Permission denied");
}

TEST(Errors, what_the_machine_is_the_reason_of_is_an_error_of_the_system) {
  for (const int number : {EMFILE, ENFILE, EIO, ENOMEM, EAGAIN, ESTALE, ETIMEDOUT})
    EXPECT_TRUE(is_error_of_system(number)) << number;
  expect_thrown<SystemError>(throw_read_error, EIO, "Input/output error");
  expect_thrown<SystemError>(throw_write_error_of, EMFILE, "Too many open files");
}

TEST(Errors, what_is_no_error_of_the_system_has_no_number) {
  EXPECT_EQ(FileError("line 3: no number").error_number(), 0);
  EXPECT_FALSE(is_error_of_system(0));
}

}  // namespace
}  // namespace unsnarl
