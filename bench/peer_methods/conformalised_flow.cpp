// Kazhdan, Solomon, Ben-Chen: "Can Mean-Curvature Flow be Modified to be Non-singular?" (2012), §3 and §4:
// semi-implicit mean curvature flow whose stiffness matrix stays that of the input, (M_t + δ L_0) x_(t+1) = M_t x_t,
// with the mass matrix of each state. It ends where nothing intersects, as in Sacht et al.: "Consistent Volumetric
// Discretizations Inside Self-Intersecting Surfaces" (2013), §3.1, who flow back afterwards; the flow back is not here
// (see --recover).
//
// Each component keeps its area and its centre of gravity, so that the motion that is measured is a change of shape.
// Closed surfaces of genus zero converge to round spheres; nothing is promised of any others.
#include <Eigen/SparseCholesky>
#include <cmath>

#include "cotangent_laplacian.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"
#include "mesh/components.h"
#include "mesh/weld_map.h"
#include "peer.h"

namespace unsnarl::peers {
namespace {

struct ConformalisedFlowOptions {
  double time_step = 1e-3;     // in areas of the whole surface
  double least_motion = 1e-7;  // of any vertex in a step / square root of the area: the flow has converged
  int most_iterations = 1000;  // ours: the spheres are round after some hundred
};

struct Extents {
  std::vector<double> areas;
  std::vector<Vec3> centres;
};

Components components_of(const Start& start) {
  const SurfaceView surface{
      .positions = {start.rest.data(), static_cast<std::size_t>(start.rest.size())},
      .corners = {start.triangles.empty() ? nullptr : start.triangles.front().data(), 3 * start.triangles.size()}};
  return find_components(surface, weld(surface, Weld::none), start.triangles, build_edges(start.triangles));
}

class ConformalisedFlow : public Peer {
 public:
  ConformalisedFlow(const Start& start, const ConformalisedFlowOptions& options)
      : options_(options),
        triangles_(start.triangles),
        components_(components_of(start)),
        at_rest_(extents(start.rest)) {
    const double area = total_area(start.rest, triangles_);
    unit_ = std::sqrt(area);
    stiffness_ = options_.time_step * area * cotangent_laplacian(start.rest, start.triangles);
    SparseMatrix unused(start.rest.cols(), start.rest.cols());
    unused.setIdentity();
    for (Index v = 0; v < unused.cols(); ++v) unused.coeffRef(v, v) = components_.component_of_vertex[v] < 0 ? area : 0;
    unused_ = unused.pruned();
  }

  int most_iterations() const override { return options_.most_iterations; }

  bool step(const std::vector<IntersectingPair>&, Positions& x) override {
    const SparseMatrix mass = mass_matrix(x, triangles_) + unused_, system = mass + stiffness_;
    if (!is_analysed_) solver_.analyzePattern(system);
    is_analysed_ = true;
    solver_.factorize(system);
    if (solver_.info() != Eigen::Success) return false;
    Positions next = solver_.solve(mass * x.transpose()).transpose();
    restore_extents(next);
    const double motion = (next - x).colwise().norm().maxCoeff();
    x = std::move(next);
    return !(motion < options_.least_motion * unit_);
  }

 private:
  Extents extents(const Positions& x) const {
    Extents result{std::vector<double>(components_.count(), 0), std::vector<Vec3>(components_.count(), Vec3::Zero())};
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Triangle& corners = triangles_[t];
      const Index c = components_.component_of_triangle[t];
      const double area = triangle_area(x, corners);
      result.areas[c] += area;
      result.centres[c] += area / 3 * (x.col(corners[0]) + x.col(corners[1]) + x.col(corners[2]));
    }
    for (Index c = 0; c < components_.count(); ++c)
      if (result.areas[c] > 0) result.centres[c] /= result.areas[c];
    return result;
  }

  void restore_extents(Positions& x) const {
    const Extents now = extents(x);
    for (Index v = 0; v < x.cols(); ++v) {
      const Index c = components_.component_of_vertex[v];
      if (c < 0 || !(now.areas[c] > 0)) continue;
      const double factor = std::sqrt(at_rest_.areas[c] / now.areas[c]);
      x.col(v) = at_rest_.centres[c] + factor * (x.col(v) - now.centres[c]);
    }
  }

  ConformalisedFlowOptions options_;
  std::span<const Triangle> triangles_;
  Components components_;
  Extents at_rest_;
  double unit_ = 0;         // square root of the area, a length
  SparseMatrix stiffness_;  // times the time step
  SparseMatrix unused_;     // holds vertices of no triangle where they are
  Eigen::SimplicialLDLT<SparseMatrix> solver_;
  bool is_analysed_ = false;
};

}  // namespace

std::unique_ptr<Peer> make_conformalised_flow(const Start& start) {
  return std::make_unique<ConformalisedFlow>(start, ConformalisedFlowOptions{});
}

}  // namespace unsnarl::peers
