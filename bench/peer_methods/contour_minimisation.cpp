// Volino, Magnenat-Thalmann: "Resolving Surface Collisions through Intersection Contour Minimization" (2006): each edge
// that pierces a face is moved along the gradient G of the length of the intersection curve, and the face the other
// way, by the vector H = h0 G / sqrt(|G|^2 + g0^2) relative to each other, the lengths of the motions in proportion to
// the weights of the vertices in the point of contact. G is the product's own (untangle/contours.h: the same formula).
// On the scale of a contour, the sum of G over all of it takes the place of each crossing's own.
//
// The method is a part of a cloth simulator; a sheet of springs stands for it. It ends where no contour is left. The
// paper leaves h0 and g0 to the simulator; they were chosen here for the most of ten samples resolved.
#include <algorithm>
#include <array>
#include <cmath>

#include "cloth.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"
#include "peer.h"
#include "untangle/local/contours.h"

namespace unsnarl::peers {
namespace {

struct ContourMinimisationOptions {
  bool by_contour = false;  // one direction for all crossings of a contour
  double longest = 0.4;     // h0, in mean edges: relative motion of the two sheets in an iteration
  double softening = 0.1;   // g0, of the dimensionless gradient of a crossing
  int sweeps = 2;           // of the springs, an iteration
  int most_iterations = 1000;
};

class ContourMinimisation : public Peer {
 public:
  ContourMinimisation(const Start& start, const ContourMinimisationOptions& options)
      : options_(options),
        triangles_(start.triangles),
        edges_(build_edges(start.triangles)),
        cloth_(start.rest, start.triangles, edges_),
        edge_length_(mean_edge_length(start.rest, start.triangles)) {}

  /// Faces that touch flat have no contour.
  bool sees(PairClass kind) const override { return kind == PairClass::disjoint || kind == PairClass::one_vertex; }
  int most_iterations() const override { return options_.most_iterations; }

  bool step(const std::vector<IntersectingPair>& pairs, Positions& x) override {
    Contours contours = trace_contours(x, triangles_, edges_, pairs);
    if (options_.by_contour) average(contours);
    Positions motion = Positions::Zero(3, x.cols());
    Eigen::VectorXd contacts = Eigen::VectorXd::Zero(x.cols());
    for (const Crossing& crossing : contours.crossings) {
      const Vec3& gradient = crossing.direction;
      const Vec3 between = options_.longest * edge_length_ /
                           std::sqrt(gradient.squaredNorm() + options_.softening * options_.softening) * gradient;
      const Edge& edge = edges_.edges[crossing.edge];
      const Triangle& face = triangles_[crossing.face];
      const double along = crossing.along;
      const std::array<Index, 5> vertices = {edge[0], edge[1], face[0], face[1], face[2]};
      const std::array<double, 5> weights = {1 - along, along, -crossing.weights[0], -crossing.weights[1],
                                             -crossing.weights[2]};
      double sum = 0;
      for (double weight : weights) sum += weight * weight;
      for (int k = 0; k < 5; ++k) {
        motion.col(vertices[k]) += weights[k] / sum * between;
        contacts[vertices[k]] += std::abs(weights[k]);
      }
    }
    // A vertex of several crossings takes the weighted mean of what they ask for.
    for (Index v = 0; v < x.cols(); ++v)
      if (contacts[v] > 0) x.col(v) += motion.col(v) / std::max(1.0, contacts[v]);
    cloth_.relax(x, options_.sweeps);
    return !contours.crossings.empty();
  }

 private:
  static void average(Contours& contours) {
    std::vector<Vec3> mean(contours.count, Vec3::Zero());
    std::vector<int> crossings(contours.count, 0);
    for (const Crossing& crossing : contours.crossings) {
      mean[crossing.contour] += crossing.side * crossing.direction;
      ++crossings[crossing.contour];
    }
    for (Crossing& crossing : contours.crossings)
      crossing.direction = crossing.side / double(crossings[crossing.contour]) * mean[crossing.contour];
  }

  ContourMinimisationOptions options_;
  std::span<const Triangle> triangles_;
  EdgeTable edges_;
  Cloth cloth_;
  double edge_length_;
};

}  // namespace

std::unique_ptr<Peer> make_contour_minimisation(const Start& start) {
  return std::make_unique<ContourMinimisation>(start, ContourMinimisationOptions{});
}

std::unique_ptr<Peer> make_contour_scale_minimisation(const Start& start) {
  ContourMinimisationOptions options;
  options.by_contour = true;
  return std::make_unique<ContourMinimisation>(start, options);
}

}  // namespace unsnarl::peers
