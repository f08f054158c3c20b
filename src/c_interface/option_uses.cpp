#include <array>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "arguments.h"

namespace unsnarl::c_interface {
namespace {

constexpr unsigned bits(std::initializer_list<Work> works) {
  unsigned all = 0;
  for (const Work work : works) all |= static_cast<unsigned>(work);
  return all;
}

/// The kinds of work that know a field of unsnarl_options. A text is compared as a text.
struct OptionUse {
  const char* name;
  std::size_t offset, size;
  bool is_text;
  unsigned works;
};
#define UNSNARL_OPTION(field, ...)                                                           \
  {                                                                                          \
#field, offsetof(unsnarl_options, field), sizeof(unsnarl_options::field),                \
        std::is_same_v < decltype(unsnarl_options::field), const char*>, bits({__VA_ARGS__}) \
  }
constexpr auto option_uses = [] {
  using enum Work;
  return std::to_array<OptionUse>({
      UNSNARL_OPTION(weld, search, repair, document, sequence, check_seifert),
      UNSNARL_OPTION(weld_tolerance, search, repair, document, sequence, check_seifert),
      UNSNARL_OPTION(both_diagonals, search, repair, document, sequence, check_seifert),
      UNSNARL_OPTION(threads, search, repair, document, sequence, curves, seifert, check_seifert, isotopy, routes,
                     knot_isotopy, relaxed_wire),
      UNSNARL_OPTION(goal, search, repair, document, sequence),
      UNSNARL_OPTION(precision, search, repair, document, sequence),
      UNSNARL_OPTION(min_gap, search, repair, document, sequence),
      UNSNARL_OPTION(max_displacement, search, repair, document, sequence),
      UNSNARL_OPTION(absolute, search, repair, document),
      UNSNARL_OPTION(min_dihedral, search, repair, document),
      UNSNARL_OPTION(memory_limit, search, repair, document),
      UNSNARL_OPTION(each_component, search, repair, document),
      UNSNARL_OPTION(paper, search, repair, document),
      UNSNARL_OPTION(time_limit, search, repair, document, sequence, curves, seifert, check_seifert, isotopy, routes,
                     knot_isotopy, relaxed_wire),
      UNSNARL_OPTION(recover, search, repair, document, curves),
      UNSNARL_OPTION(first_frame, sequence),
      UNSNARL_OPTION(last_frame, sequence),
      UNSNARL_OPTION(gap, curves),
      UNSNARL_OPTION(junction, curves),
      UNSNARL_OPTION(fix_ends, curves),
      UNSNARL_OPTION(edge, seifert, check_seifert),
      UNSNARL_OPTION(views, seifert, check_seifert),
      UNSNARL_OPTION(fair, seifert, check_seifert),
      UNSNARL_OPTION(points, isotopy, knot_isotopy),
      UNSNARL_OPTION(paper_bandwidth, search, repair, document),
      UNSNARL_OPTION(paper_adaptive, search, repair, document),
      UNSNARL_OPTION(paper_bandwidth_scale, search, repair, document),
      UNSNARL_OPTION(paper_neighbourhood, search, repair, document),
      UNSNARL_OPTION(paper_gaussian, search, repair, document),
      UNSNARL_OPTION(paper_mesh, search, repair, document),
      UNSNARL_OPTION(paper_mesh_energy, search, repair, document),
      UNSNARL_OPTION(paper_whole_polygons, search, repair, document),
      UNSNARL_OPTION(paper_arap, search, repair, document),
      UNSNARL_OPTION(paper_memory, search, repair, document),
      UNSNARL_OPTION(paper_iterations, search, repair, document),
      UNSNARL_OPTION(spacing, routes),
      UNSNARL_OPTION(handles, seifert, check_seifert),
      UNSNARL_OPTION(keep_partial, document),
      UNSNARL_OPTION(no_partial, document),
      UNSNARL_OPTION(gap_near_conflicts, search, repair, document, sequence),
      UNSNARL_OPTION(move_strands, curves),
      UNSNARL_OPTION(pairs, isotopy),
  });
}();
#undef UNSNARL_OPTION

bool are_equal(const OptionUse& option, const unsnarl_options& a, const unsnarl_options& b) {
  const char *of_a = reinterpret_cast<const char*>(&a) + option.offset,
             *of_b = reinterpret_cast<const char*>(&b) + option.offset;
  if (!option.is_text) return std::memcmp(of_a, of_b, option.size) == 0;
  const char *text_a = nullptr, *text_b = nullptr;
  std::memcpy(&text_a, of_a, sizeof text_a);
  std::memcpy(&text_b, of_b, sizeof text_b);
  if (text_a == nullptr || text_b == nullptr) return text_a == text_b;
  return std::strcmp(text_a, text_b) == 0;
}

}  // namespace

void refuse_what_is_not_used(const unsnarl_options& options, Work work) {
  const unsnarl_options defaults = default_options();
  for (const OptionUse& option : option_uses)
    if ((option.works & bits({work})) == 0 && !are_equal(option, options, defaults))
      throw std::invalid_argument(std::string("options: this function does not use '") + option.name +
                                  "'; leave it as unsnarl_options_init sets it");
}

}  // namespace unsnarl::c_interface
