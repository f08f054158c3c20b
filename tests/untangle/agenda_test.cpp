#include "untangle/agenda.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace unsnarl {
namespace {

std::vector<Tier> three_tiers() {
  const auto named = [](std::string name) { return Strategy{std::move(name), {}, {}}; };
  return {{{named("a"), named("b")}}, {{named("c")}}, {{named("d")}, true}};
}

std::vector<std::string> names(const std::vector<Level>& levels, bool Level::*flag = nullptr) {
  std::vector<std::string> found;
  for (const Level& level : levels)
    if (!flag || level.*flag) found.push_back(level.strategy->name);
  return found;
}

using Names = std::vector<std::string>;

TEST(Levels, are_the_strategies_in_order) {
  const std::vector<Tier> tiers = three_tiers();
  const std::vector<Level> levels = levels_of(tiers, {});
  EXPECT_EQ(names(levels), (Names{"a", "b", "c", "d"}));
  EXPECT_EQ(names(levels, &Level::ends_tier), (Names{"b", "c", "d"}));
  EXPECT_EQ(names(levels, &Level::ends_waiting), (Names{"c", "d"})) << "nothing waits for a last resort";
}

TEST(Levels, do_without_what_is_left_out) {
  const std::vector<Tier> tiers = three_tiers();
  const auto without = [&](const Names& left_out) { return levels_of(tiers, left_out); };
  EXPECT_EQ(names(without({"b", "c"}), &Level::ends_tier), (Names{"a", "d"}));
  EXPECT_EQ(names(without({"b", "c"}), &Level::ends_waiting), (Names{"a", "d"}));
  EXPECT_EQ(names(without({"d"}), &Level::ends_waiting), (Names{"c"}));
  EXPECT_EQ(names(without({"a", "b", "c"}), &Level::ends_waiting), (Names{"d"}));
  EXPECT_TRUE(without({"a", "b", "c", "d"}).empty());
}

ConflictRegion region_of(std::vector<Index> core) {
  return {std::move(core), {}};
}

TEST(Agenda, tries_the_regions_on_the_lowest_level) {
  const std::vector<ConflictRegion> both = {region_of({0, 1}), region_of({4, 5})}, first = {both[0]};
  Agenda agenda(6, 2);
  EXPECT_EQ(agenda.advance(first).level, 0);
  const Agenda::Due due = agenda.advance(both);
  EXPECT_EQ(due.level, 0) << "the second region's";
  EXPECT_EQ(due.vertices, (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(agenda.advance(both).vertices, (std::vector<std::uint8_t>{1, 1, 0, 0, 1, 1})) << "both are on level 1";
  EXPECT_EQ(agenda.advance(both).level, 2) << "all levels have been tried";
  agenda.restart(std::vector<Index>{4});
  EXPECT_EQ(agenda.level_of(both[1]), 2) << "its other vertex does not restart";
  agenda.restart(both[1].core);
  EXPECT_EQ(agenda.advance(both).vertices, (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 1}));
}

}  // namespace
}  // namespace unsnarl
