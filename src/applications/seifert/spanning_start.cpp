#include "applications/seifert/spanning_start.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "applications/seifert/handles.h"
#include "applications/seifert/rim_short_cuts.h"
#include "geometry/splitmix.h"
#include "mesh/ear_clipper.h"

namespace unsnarl {
namespace {

/// The rim of the strand below winds around it on either side of the band, from this far from the crossing on (unit:
/// half length of the band)
constexpr double winding_of_band = 1.6;
/// Width of the collar, at most, so that all of it stays apart from the other strand's (unit: smallest gap between the
/// strands of a crossing)
constexpr double collar_of_gap = 0.25;
/// Width of the collar, at most (unit: smallest room beside a strand within a band)
constexpr double collar_of_room = 0.25;
/// Corners of discs are moved aside by up to half of this, so that no outline comes to cross itself (unit: smallest
/// room beside a strand within a band)
constexpr double corner_shift = 1e-3;
/// Corners of discs are moved aside by no more than half of this (unit: smallest distance of a corner of the link from
/// an edge in the picture)
constexpr double corner_shift_of_picture = 0.1;

/// A point of the collar's free rim, in the frame of the diagram.
struct RimPoint {
  Vec3 x;
  double fraction = 0;                            // of its edge
  Index crossing = -1;                            // where it is an end of a band
  bool over = false, arrives = false;             // of its strand, there
  Index next = -1;                                // along the link
  Index link_vertex = -1, next_link_vertex = -1;  // its edge
  ShortCut cut;                                   // of edges of the link, where it begins with the first of them
};

class Construction {
 public:
  Construction(const Link& link, const LinkDiagram& diagram, double step) : diagram_(diagram), step_(step) {
    for (const std::vector<double>& component : link.components)
      for (std::size_t k = 0; k < component.size(); k += 3)
        mesh_.x.emplace_back(component[k], component[k + 1], component[k + 2]);
  }

  SpanningMesh build(int handles) {
    room_ = room_in_picture();
    make_rim();
    hang_collar();
    place_bands();
    hang_walls();
    fill_discs(handles);
    return std::move(mesh_);
  }

 private:
  Index add(const Vec3& in_frame) {
    mesh_.x.push_back(diagram_.frame.transpose() * in_frame);
    return static_cast<Index>(mesh_.x.size() - 1);
  }

  Vec2 direction(const LinkDiagram::Strand& strand) const {
    const Positions& p = diagram_.points[strand.component];
    return (p.col((strand.edge + 1) % p.cols()) - p.col(strand.edge)).head<2>().normalized();
  }
  /// The strand below has the one above it to its left (1) or right (-1) where that comes from.
  int side_of_over(const LinkDiagram::Crossing& c) const {
    const Vec2 a = direction(c.under), b = direction(c.over);
    return a.x() * b.y() - a.y() * b.x() > 0 ? 1 : -1;
  }

  void make_rim() {
    double& collar = collar_ = step_;
    beside_ = step_;
    for (const LinkDiagram::Crossing& c : diagram_.crossings) {
      beside_ = std::min(beside_, c.beside);
      collar = std::min({collar, collar_of_gap * c.gap, collar_of_room * beside_});
    }
    const std::vector<std::vector<double>> depths = rim_depths();
    const std::vector<std::vector<ShortCut>> cuts = rim_short_cuts(diagram_, depths, step_, room_);
    Index first_vertex = 0;
    for (std::size_t c = 0; c < diagram_.points.size(); ++c) {
      const Positions& p = diagram_.points[c];
      const auto n = static_cast<Index>(p.cols());
      const auto first = static_cast<Index>(rim_.size());
      std::size_t pass = 0;
      for (Index k = 0; k < n; k += cuts[c][k].edges) {
        const Vec3 a = p.col(k), b = p.col((k + 1) % n);
        const double length = (b - a).head<2>().norm();
        const auto put = [&](double t) -> RimPoint& {
          RimPoint& r = rim_.emplace_back();
          r.x = (1 - t) * a + t * b - (t == 0 ? depths[c][k] : collar) * Vec3::UnitZ();
          r.fraction = t;
          r.link_vertex = first_vertex + k;
          r.next_link_vertex = first_vertex + (k + 1) % n;
          return r;
        };
        put(0).cut = cuts[c][k];
        for (; pass < diagram_.passes[c].size(); ++pass) {
          const LinkDiagram::Pass& visit = diagram_.passes[c][pass];
          const LinkDiagram::Crossing& crossing = diagram_.crossings[visit.crossing];
          const LinkDiagram::Strand& strand = visit.over ? crossing.over : crossing.under;
          if (strand.edge != k) break;
          const double half = crossing.band / length;
          if (!visit.over) put(strand.fraction - winding_of_band * half);
          for (const bool arrives : {true, false}) {
            RimPoint& r = put(strand.fraction + (arrives ? -half : half));
            r.crossing = visit.crossing;
            r.over = visit.over;
            r.arrives = arrives;
            // Below, the rim changes sides above its strand: from the side of the one circle to that of the other. It
            // does so straight across the strand and by the same way at every crossing, see hang_collar().
            if (!visit.over) {
              const Vec2 along = direction(crossing.under), left(-along.y(), along.x());
              r.x.head<2>() += (arrives == (side_of_over(crossing) > 0) ? collar : -collar) * left;
              r.x.z() += 2 * collar;
            }
          }
          if (!visit.over) put(strand.fraction + winding_of_band * half);
        }
      }
      for (Index k = first; k < static_cast<Index>(rim_.size()); ++k)
        rim_[k].next = k + 1 < static_cast<Index>(rim_.size()) ? k + 1 : first;
      first_vertex += n;
    }
    for (const RimPoint& r : rim_) rim_vertex_.push_back(add(r.x));
  }

  /// Below every point of the link. Only where an edge crosses another one is the collar narrow: else nothing but it is
  /// there in the picture.
  std::vector<std::vector<double>> rim_depths() const {
    std::vector<std::vector<double>> depths;
    for (const Positions& p : diagram_.points) depths.emplace_back(p.cols(), step_);
    for (const LinkDiagram::Crossing& crossing : diagram_.crossings)
      for (const LinkDiagram::Strand& strand : {crossing.over, crossing.under}) {
        std::vector<double>& of_component = depths[strand.component];
        for (const std::size_t k : {std::size_t(strand.edge), std::size_t(strand.edge) + 1})
          of_component[k % of_component.size()] = collar_;
      }
    return depths;
  }

  /// From every edge of the link to the rim below it: a fan from its first end, up to the middle, and one from its
  /// second.
  ///
  /// Seen from an end, however often the rim winds around the edge, it does not cross itself: across the edge, all of
  /// its points have the places (0, -w) or (+-w, w), the corners of one triangle T around the edge, and the farther
  /// ones are seen nearer to the edge. Along each piece of the rim, which follows a side of T or leads straight to the
  /// edge, the size of T that is seen there falls evenly; so no size, and no place, is seen twice.
  void hang_collar() {
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      const RimPoint &r = rim_[k], &next = rim_[r.next];
      if (r.cut.edges > 1) {
        hang_below_cut(k);
        continue;
      }
      const double end = next.link_vertex == r.link_vertex ? next.fraction : 1;
      const bool second_half = 0.5 * (r.fraction + end) > 0.5;
      const Index from = rim_vertex_[k], to = rim_vertex_[r.next];
      mesh_.faces.push_back({second_half ? r.next_link_vertex : r.link_vertex, to, from});
      const bool was_first_half = r.fraction == 0 || 0.5 * (rim_[k - 1].fraction + r.fraction) <= 0.5;
      if (second_half && was_first_half) mesh_.faces.push_back({r.link_vertex, r.next_link_vertex, from});
      if (!second_half && end == 1) mesh_.faces.push_back({r.link_vertex, r.next_link_vertex, to});
    }
  }

  /// Fans from the ends of the cut: rim_short_cuts() says why they do not meet.
  void hang_below_cut(std::size_t k) {
    const RimPoint& r = rim_[k];
    const Index from = rim_vertex_[k], to = rim_vertex_[r.next];
    const auto vertex = [&](Index i) { return i < r.cut.edges ? r.link_vertex + i : rim_[r.next].link_vertex; };
    for (Index i = 0; i < r.cut.edges; ++i)
      mesh_.faces.push_back({vertex(i), vertex(i + 1), i < r.cut.middle ? from : to});
    mesh_.faces.push_back({vertex(r.cut.middle), to, from});
  }

  void place_bands() {
    ends_.resize(diagram_.crossings.size());
    for (std::size_t k = 0; k < rim_.size(); ++k)
      if (rim_[k].crossing >= 0)
        ends_[rim_[k].crossing][rim_[k].over ? 0 : 1][rim_[k].arrives ? 0 : 1] = static_cast<Index>(k);
    for (const auto& [over, under] : ends_) {
      const Index a = rim_vertex_[over[0]], c = rim_vertex_[over[1]], b = rim_vertex_[under[0]],
                  d = rim_vertex_[under[1]];
      mesh_.faces.push_back({a, c, b});
      mesh_.faces.push_back({a, b, d});
    }
  }

  /// The next point along a Seifert circle: at a crossing the strands are exchanged.
  Index along_circle(Index k) const {
    const RimPoint& r = rim_[k];
    return r.crossing >= 0 && r.arrives ? ends_[r.crossing][r.over ? 1 : 0][1] : r.next;
  }

  bool contains(const std::vector<Index>& circle, const Vec3& p) const {
    bool inside = false;
    for (std::size_t k = 0; k < circle.size(); ++k) {
      const Vec3 &a = rim_[circle[k]].x, &b = rim_[circle[(k + 1) % circle.size()]].x;
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
    return inside;
  }

  void hang_walls() {
    std::vector<std::vector<Index>> circles;
    std::vector<bool> seen(rim_.size(), false);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t start = 0; start < rim_.size(); ++start) {
      lowest = std::min(lowest, rim_[start].x.z());
      if (seen[start]) continue;
      std::vector<Index>& circle = circles.emplace_back();
      for (auto k = static_cast<Index>(start); !seen[k]; k = along_circle(k)) {
        seen[k] = true;
        circle.push_back(k);
      }
    }
    std::vector<int> depth(circles.size(), 0);
    for (std::size_t i = 0; i < circles.size(); ++i)
      for (std::size_t j = 0; j < circles.size(); ++j)
        if (i != j) depth[i] += contains(circles[j], rim_[circles[i][0]].x);
    const int deepest = *std::max_element(depth.begin(), depth.end());
    lowest_ = lowest - step_ * (1 + deepest);
    for (std::size_t i = 0; i < circles.size(); ++i) hang_wall(circles[i], lowest_ + step_ * depth[i], depth[i] == 0);
  }

  double room_in_picture() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Positions& p : diagram_.points)
      for (const Positions& q : diagram_.points)
        for (Index v = 0; v < p.cols(); ++v)
          for (Index k = 0; k < q.cols(); ++k) {
            const auto next = static_cast<Index>((k + 1) % q.cols());
            if (&p == &q && (v == k || v == next)) continue;
            const Vec2 at = p.col(v).head<2>(), a = q.col(k).head<2>(), d = q.col(next).head<2>() - a;
            const double t = std::clamp((at - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
            least = std::min(least, (at - a - t * d).norm());
          }
    return least;
  }

  /// Another one for each number, far below the room between walls.
  double shift(Index k) const {
    return std::min(corner_shift * beside_, corner_shift_of_picture * room_) *
           (splitmix_number(static_cast<std::uint64_t>(k) * splitmix_step) - 0.5);
  }

  void hang_wall(const std::vector<Index>& circle, double height, bool is_lowest) {
    const std::size_t n = circle.size();
    FlatDisc& disc = (is_lowest ? lowest_discs_ : discs_).emplace_back();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3& p = rim_[circle[k]].x;
      // Corners in line would make triangles without area.
      disc.outline.emplace_back(p.x() + shift(2 * circle[k]), p.y() + shift(2 * circle[k] + 1));
      disc.corners.push_back(add({disc.outline.back().x(), disc.outline.back().y(), height}));
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Index a = rim_vertex_[circle[k]], b = rim_vertex_[circle[(k + 1) % n]];
      const Index below_a = disc.corners[k], below_b = disc.corners[(k + 1) % n];
      mesh_.faces.push_back({a, b, below_b});
      mesh_.faces.push_back({a, below_b, below_a});
    }
  }

  /// Handles hang from the lowest discs, below which there is nothing.
  void fill_discs(int handles) {
    std::vector<std::vector<FlatDisc>> holes(lowest_discs_.size());
    for (const HandlePlace& place : handle_places(lowest_discs_, handles)) {
      FlatDisc& hole = holes[place.disc].emplace_back();
      std::array<Vec2, 6> corners = hexagon_of(place);
      if (is_clockwise(lowest_discs_[place.disc])) std::reverse(corners.begin() + 1, corners.end());
      std::array<Index, 6> hexagon;
      for (int k = 0; k < 6; ++k) hexagon[k] = add({corners[k].x(), corners[k].y(), lowest_});
      add_handle(mesh_, hexagon, -diagram_.frame.transpose() * Vec3::UnitZ());
      hole.corners.assign(hexagon.rbegin(), hexagon.rend());
      hole.outline.assign(corners.rbegin(), corners.rend());
    }
    for (std::size_t d = 0; d < lowest_discs_.size(); ++d) {
      cut_to_holes(lowest_discs_[d], std::move(holes[d]));
      fill(lowest_discs_[d]);
    }
    for (const FlatDisc& disc : discs_) fill(disc);
  }

  void fill(const FlatDisc& disc) {
    std::vector<Vec3> flat;
    for (const Vec2& p : disc.outline) flat.emplace_back(p.x(), p.y(), 0);
    std::vector<Triangle> cut;
    if (clipper_.clip(disc.corners, flat, is_clockwise(disc) ? Vec3(-Vec3::UnitZ()) : Vec3::UnitZ(), cut) > 0)
      throw NoSpanningStart("a Seifert circle crosses itself");
    for (const Triangle& t : cut) mesh_.faces.push_back({disc.corners[t[0]], disc.corners[t[1]], disc.corners[t[2]]});
  }

  const LinkDiagram& diagram_;
  const double step_;
  double collar_ = 0;  // its width
  double beside_ = 0;  // the smallest room beside a strand within a band, in the picture
  double room_ = 0;  // the smallest distance of a corner of the link from an edge that it is no end of, in the picture
  SpanningMesh mesh_;
  std::vector<FlatDisc> lowest_discs_, discs_;  // several side by side are the lowest, at the same height
  double lowest_ = 0;
  std::vector<RimPoint> rim_;
  std::vector<Index> rim_vertex_;
  std::vector<std::array<std::array<Index, 2>, 2>> ends_;  // rim points of a crossing: [over, under][arrives, leaves]
  EarClipper clipper_;
};

}  // namespace

SpanningMesh spanning_start(const Link& link, const LinkDiagram& diagram, double step, int handles) {
  return Construction(link, diagram, step).build(handles);
}

}  // namespace unsnarl
