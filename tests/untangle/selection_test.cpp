#include "untangle/selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesh/areas.h"
#include "scene/shapes.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

/// What strategies see of a scene all of whose conflicts are due.
class Seen {
 public:
  explicit Seen(Scene scene)
      : scene_(std::move(scene)),
        pairs_(shapes::pairs_at(scene_.x, scene_.triangles)),
        is_due(static_cast<std::size_t>(scene_.vertex_count()), 1),
        is_rejected(static_cast<std::size_t>(scene_.vertex_count()), 0) {}

  std::vector<Selection> select(const Select& select) {
    return select({scene_, pairs_, pairs_, is_due, is_rejected,
                   [this]() -> const ConnectedParts& { return parts_ ? *parts_ : parts_.emplace(scene_); }});
  }
  const Scene& scene() const { return scene_; }
  const std::vector<IntersectingPair>& pairs() const { return pairs_; }

 private:
  Scene scene_;
  std::vector<IntersectingPair> pairs_;
  std::optional<ConnectedParts> parts_;

 public:
  std::vector<std::uint8_t> is_due, is_rejected;  // per vertex
};

/// A strip of n cells with a needle through each of some cells.
Scene pierced_strip(Index n, const std::vector<int>& cells) {
  Shape shape = shapes::grid(n, 1, false, [](double i, double j) { return Vec3(i, j, 0); });
  for (const int cell : cells) {
    Shape needle;
    needle.points = {Vec3(cell + 0.5, 0.3, -1), Vec3(cell + 0.5, 0.31, 1), Vec3(cell + 0.51, 0.3, 1)};
    needle.triangles = {{0, 1, 2}};
    shape.add(needle);
  }
  return shapes::scene_of(shape);
}

/// Two sheets that run through each other, the lower one fixed.
Scene half_fixed(const Shape& shape) {
  std::vector<std::uint8_t> fixed(shape.points.size(), 0);
  std::fill(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(fixed.size() / 2), std::uint8_t{1});
  return make_scene(shape.positions(), shape.triangles, fixed);
}

TEST(Selection, holds_the_vertices_around_a_region_and_how_far_they_may_go) {
  Seen seen(pierced_strip(30, {5, 20}));
  const std::vector<Selection> selections = seen.select(select_rings({.rings = 2, .reach = 3}));
  ASSERT_EQ(selections.size(), 2u);
  for (const Selection& selection : selections) {
    EXPECT_EQ(selection.free, dilate(seen.scene(), selection.region.core, 2));
    std::vector<Triangle> faces;
    for (const IntersectingPair& pair : selection.region.pairs)
      for (const Index t : {pair.a, pair.b}) faces.push_back(seen.scene().triangles[t]);
    EXPECT_DOUBLE_EQ(selection.edge_length, mean_equilateral_side(seen.scene().rest, faces));
    EXPECT_DOUBLE_EQ(selection.bound, 3 * selection.edge_length);
    EXPECT_EQ(selection.depth, 0);
  }
}

TEST(Selection, regions_that_reach_each_other_are_one) {
  Seen seen(pierced_strip(30, {3, 10, 24}));
  const std::vector<Selection> selections = seen.select(select_rings({.rings = 7}));
  ASSERT_EQ(selections.size(), 2u);
  EXPECT_GT(selections[0].region.pairs.size(), selections[1].region.pairs.size());
  std::vector<IntersectingPair> all;
  for (const Selection& selection : selections) {
    EXPECT_TRUE(std::is_sorted(selection.region.core.begin(), selection.region.core.end()));
    EXPECT_EQ(selection.free, dilate(seen.scene(), selection.region.core, 7));
    all.insert(all.end(), selection.region.pairs.begin(), selection.region.pairs.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_TRUE(all == seen.pairs()) << "every pair is in one region";
}

TEST(Selection, regions_that_are_not_due_are_only_taken_in) {
  Seen seen(pierced_strip(30, {3, 10, 24}));
  const std::vector<Selection> all = seen.select(select_rings({.rings = 1}));
  ASSERT_EQ(all.size(), 3u);
  std::fill(seen.is_due.begin(), seen.is_due.end(), std::uint8_t{0});
  for (const Index v : all[1].region.core) seen.is_due[static_cast<std::size_t>(v)] = 1;
  const std::vector<Selection> narrow = seen.select(select_rings({.rings = 1}));
  ASSERT_EQ(narrow.size(), 1u);
  EXPECT_EQ(narrow[0].region.core, all[1].region.core);
  const std::vector<Selection> wide = seen.select(select_rings({.rings = 7}));
  ASSERT_EQ(wide.size(), 1u);
  EXPECT_EQ(wide[0].region.pairs.size(), all[0].region.pairs.size() + all[1].region.pairs.size());
}

TEST(Selection, what_holds_no_free_vertex_is_not_selected) {
  Scene scene = pierced_strip(10, {5});
  std::fill(scene.fixed.begin(), scene.fixed.end(), std::uint8_t{1});
  EXPECT_TRUE(Seen(std::move(scene)).select(select_rings({.rings = 4})).empty());
}

TEST(Selection, a_region_that_cannot_be_selected_frees_those_that_it_reached) {
  Seen seen(pierced_strip(30, {3, 10}));
  int asked = 0;
  const Select select = [&](const Conflicts& conflicts) {
    return select_regions(conflicts, any_valence, [&](const ConflictRegion&) -> std::optional<Extent> {
      const bool is_first = asked++ == 0;
      const auto free = [&conflicts, is_first](const ConflictRegion& region) {
        return dilate(conflicts.scene, region.core, is_first ? 20 : 0);
      };
      return Extent{.free_vertices = free, .is_wanted = [is_first](const Selection&) { return !is_first; }, .reach = 1};
    });
  };
  const std::vector<Selection> selections = seen.select(select);
  ASSERT_EQ(selections.size(), 1u);
  EXPECT_EQ(selections[0].region.pairs.size() * 2, seen.pairs().size());
}

TEST(Selection, depth_is_that_of_the_tangle_or_a_multiple_of_it) {
  Seen shallow(half_fixed(shapes::crossing_bumps(12, 0.5)));
  Seen deep(shapes::scene_of(shapes::crossing_wide_bumps(2, 2)));
  const auto depths = [](Seen& seen, int factor) {
    std::vector<int> found;
    for (const Selection& selection :
         seen.select(select_by_depth({.rings_per_edge = 1.5, .reach = 2, .least = 4, .factor = factor}))) {
      EXPECT_EQ(selection.free, dilate(seen.scene(), selection.region.core, static_cast<int>(1.5 * selection.depth)));
      EXPECT_DOUBLE_EQ(selection.bound, 2 * selection.edge_length * selection.depth);
      found.push_back(selection.depth);
    }
    return found;
  };
  EXPECT_TRUE(depths(shallow, 1).empty());
  EXPECT_EQ(depths(shallow, 2), std::vector<int>{8});
  const std::vector<int> as_it_is = depths(deep, 1);
  ASSERT_EQ(as_it_is.size(), 1u);
  EXPECT_GE(as_it_is[0], 4);
  EXPECT_EQ(depths(deep, 3), std::vector<int>{3 * as_it_is[0]});
}

TEST(Selection, small_regions_may_be_left_to_others) {
  Seen seen(shapes::scene_of(shapes::crossing_wide_bumps(2, 2)));
  DepthOptions options = {.rings_per_edge = 1.5, .least = 4};
  const std::vector<Selection> selections = seen.select(select_by_depth(options));
  ASSERT_EQ(selections.size(), 1u);
  const std::size_t free = selections[0].free.size();
  options.least_free = free / 3;
  EXPECT_EQ(seen.select(select_by_depth(options)).size(), 1u);
  options.least_free = free;  // those of both components
  EXPECT_TRUE(seen.select(select_by_depth(options)).empty());
}

TEST(Selection, most_of_a_component_may_be_left_to_others) {
  Seen seen(shapes::scene_of(shapes::crossing_bumps(24, 0.5)));
  const auto is_selected = [&](double rings, bool leaves_most) {
    const DepthOptions options = {.rings_per_edge = rings, .least = 1, .factor = 2, .leaves_most = leaves_most};
    return !seen.select(select_by_depth(options)).empty();
  };
  EXPECT_TRUE(is_selected(0.5, true));
  EXPECT_FALSE(is_selected(12, true));
  EXPECT_TRUE(is_selected(12, false));
}

TEST(Selection, whole_components_are_free_but_for_fixed_vertices_and_rejected_regions) {
  Seen seen(half_fixed(shapes::crossing_bumps(12, 0.5)));
  const std::vector<Selection> selections = seen.select(select_whole_components(20));
  ASSERT_EQ(selections.size(), 1u);
  EXPECT_EQ(selections[0].free.size() * 2, static_cast<std::size_t>(seen.scene().vertex_count()));
  for (const Index v : selections[0].free) EXPECT_FALSE(seen.scene().fixed[v]);
  seen.is_rejected[static_cast<std::size_t>(selections[0].region.core.front())] = 1;
  EXPECT_TRUE(seen.select(select_whole_components(20)).empty());
}

TEST(Selection, tied_components_are_free_as_wholes) {
  Seen seen(pierced_strip(10, {5}));
  const std::vector<Selection> selections = seen.select(select_tied_components(20));
  ASSERT_EQ(selections.size(), 1u);
  EXPECT_EQ(selections[0].free.size(), static_cast<std::size_t>(seen.scene().vertex_count()));
  Seen held(half_fixed(shapes::crossing_bumps(12, 0.5)));
  for (const Selection& selection : held.select(select_tied_components(20)))
    for (const Index v : selection.free) EXPECT_GE(v, held.scene().vertex_count() / 2);
}

TEST(TiedComponents, are_tied_by_all_the_pairs_that_there_were) {
  const Shape shape = shapes::sheet_with_strips(3, 0.2);
  const Scene scene = shapes::scene_of(shape);
  const ConnectedParts parts(scene);
  const std::vector<IntersectingPair> pairs = shapes::pairs_of(shape);
  ConflictRegion region;
  region.pairs = {pairs.front()};
  const auto all = vertices_of_tied_components(scene, parts, region, pairs);
  EXPECT_EQ(static_cast<Index>(all.size()), scene.vertex_count());
  const auto two = vertices_of_tied_components(scene, parts, region, region.pairs);
  EXPECT_EQ(two.size(), 121u + 6u);
  // Within a single component there is nothing to place.
  region.pairs = {{0, 1, PairClass::folded}};
  EXPECT_TRUE(vertices_of_tied_components(scene, parts, region, pairs).empty());
}

TEST(TiedComponents, with_fixed_vertices_are_left_out) {
  const Shape shape = shapes::sheet_with_strips(1, 0.2);
  std::vector<std::uint8_t> fixed(shape.points.size(), 0);
  fixed[0] = 1;
  const Scene scene = make_scene(shape.positions(), shape.triangles, fixed);
  ConflictRegion region;
  region.pairs = shapes::pairs_of(shape);
  const auto free = vertices_of_tied_components(scene, ConnectedParts(scene), region, region.pairs);
  EXPECT_EQ(free.size(), 6u);
}

}  // namespace
}  // namespace unsnarl
