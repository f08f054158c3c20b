#include "unsnarl/page.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "scene/shapes.h"
#include "unsnarl/report_json.h"

namespace unsnarl {
namespace {

const std::string page_template = "<body><!--unsnarl-data--></body>";

PageSource source_of(const Surface& surface) {
  PageSource source;
  source.before = surface;
  return source;
}

/// The text of the element with this id; empty: there is none.
std::string text_of(const std::string& page, const std::string& id) {
  const std::size_t at = page.find(" id=\"" + id + '"');
  if (at == std::string::npos) return {};
  const std::size_t begin = page.find('>', at) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST(ViewPage, shows_one_surface_or_two) {
  const Surface surface = shapes::crossing_bumps(6, 0.4).surface();
  PageSource source = source_of(surface);
  const std::string one = view_page(page_template, source);
  EXPECT_FALSE(text_of(one, "pairs_before").empty());
  EXPECT_FALSE(text_of(one, "curves_before").empty());
  EXPECT_TRUE(text_of(one, "pairs_after").empty());
  source.after = surface.positions;
  const std::string two = view_page(page_template, source);
  EXPECT_EQ(text_of(two, "pairs_after"), text_of(one, "pairs_before"));
}

TEST(ViewPage, the_goal_says_which_pairs_are_shown) {
  // Two triangles with a common vertex that cross elsewhere.
  const Surface surface = {{0, 0, 0, 4, -1, 0, 4, 1, 0, 4, 0, -1, 4, 0, 1}, {0, 1, 2, 0, 3, 4}, {}};
  PageSource source = source_of(surface);
  const std::string all = view_page(page_template, source);
  source.goal = Goal::disjoint;
  EXPECT_NE(text_of(all, "pairs_before"), text_of(view_page(page_template, source), "pairs_before"));
}

TEST(ViewPage, holds_the_report) {
  const Surface surface = shapes::bumpy_sheet(3, 0.5).surface();
  PageSource source = source_of(surface);
  EXPECT_NE(view_page(page_template, source).find("\"report\":null"), std::string::npos);
  source.report = report_json(repair(surface), {});
  EXPECT_NE(view_page(page_template, source).find("\"report\":{\"schema\":\"unsnarl-report\""), std::string::npos);
}

TEST(ViewPage, refuses_what_makes_no_sense) {
  const Surface surface = shapes::bumpy_sheet(3, 0.5).surface();
  PageSource source = source_of(surface);
  EXPECT_THROW(view_page("<body></body>", source), std::invalid_argument);
  source.report.push_back('{');
  EXPECT_THROW(view_page(page_template, source), std::invalid_argument);
  source.report.clear();
  source.after = std::span(surface.positions).first(3);
  EXPECT_THROW(view_page(page_template, source), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
