#include "recover/shape_energy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/parallel_sums.h"

namespace unsnarl {
namespace {

constexpr Index chunk = 1024;  // vertices, triangles or hinges a task

}  // namespace

ShapeEnergy::ShapeEnergy(const Patch& patch, const EdgeTable& edges, const IndexLists& triangles_of_vertex,
                         const RecoverOptions& options, double h)
    : patch_(patch),
      triangles_of_vertex_(triangles_of_vertex),
      options_(options),
      arap_scale_(options.arap_length * options.arap_length * h * h),
      bending_scale_(std::pow(options.bending_length * h, 4)),
      neighbours_(vertex_neighbours(edges.edges, static_cast<Index>(patch.rest.cols()))) {
  const std::span<const Triangle> active(patch.triangles.data(), static_cast<std::size_t>(patch.active_count));
  arap_ = ArapTriangle(patch.rest, active);
  std::vector<Hinge> hinges = hinges_of(patch.triangles, edges);
  std::erase_if(hinges, [&](const Hinge& hinge) {
    return std::all_of(hinge.begin(), hinge.end(), [&](Index v) { return v >= patch.free_count; });
  });
  Bending::Options bending;
  bending.edge_length = h;
  bending_ = Bending(patch.rest, patch.x, hinges, bending);

  pull_.mass = vertex_areas(patch.rest, patch.triangles);
  pull_.rest = patch.rest;
  double mass = 0;
  for (Index v = 0; v < patch.free_count; ++v) mass += pull_.mass[v];
  mass /= std::max<Index>(patch.free_count, 1);
  contact_force_ = options.contact_force * mass * h;
  OrientationPenalty::Options orientation;
  orientation.scale = options.turn_weight * options.contact_force * mass * h;
  orientation.activation = options.turn_activation;
  orientation_ = OrientationPenalty(patch.rest, active, orientation);
}

void ShapeEnergy::restrict_to(const MovingVertices& moving) {
  moving_ = &moving;
  const auto& moves = moving.moves;
  triangles_.clear();
  for (Index t = 0; t < arap_.size(); ++t) {
    const Triangle& f = arap_.triangle(t);
    if (moves[f[0]] || moves[f[1]] || moves[f[2]]) triangles_.push_back(t);
  }
  hinges_.clear();
  for (Index e = 0; e < bending_.size(); ++e) {
    const Hinge& f = bending_.hinge(e);
    if (moves[f[0]] || moves[f[1]] || moves[f[2]] || moves[f[3]]) hinges_.push_back(e);
  }
}

void ShapeEnergy::build_matrix(StepOperator& step_operator) const {
  const std::vector<Index>& slot = moving_->slot;
  const Index n = static_cast<Index>(moving_->vertices.size());
  const double arap = options_.rotation_damping * arap_scale_ * arap_.weight();
  step_operator.mass.resize(n);
  step_operator.row_begin.assign(n + 1, 0);
  step_operator.column.clear();
  step_operator.entry.clear();
  for (Index i = 0; i < n; ++i) {
    const Index v = moving_->vertices[i];
    step_operator.mass[i] = pull_.mass[v];
    double diagonal = options_.pull * pull_.mass[v];
    const Index begin = static_cast<Index>(step_operator.column.size());
    for (Index w : neighbours_[v]) {
      if (slot[w] < 0) continue;
      step_operator.column.push_back(slot[w]);
      step_operator.entry.push_back(0);
    }
    for (Index t : triangles_of_vertex_[v]) {
      if (t >= arap_.size()) continue;
      for (Index w : arap_.triangle(t)) {
        if (w == v) continue;
        diagonal += arap;
        if (slot[w] < 0) continue;
        for (Index k = begin; k < static_cast<Index>(step_operator.column.size()); ++k) {
          if (step_operator.column[k] == slot[w]) step_operator.entry[k] -= arap;
        }
      }
    }
    step_operator.column.push_back(i);
    step_operator.entry.push_back(diagonal);
    step_operator.row_begin[i + 1] = static_cast<Index>(step_operator.column.size());
  }
  step_operator.shift = options_.time_step > 0 ? 1 / options_.time_step : 0;
}

double ShapeEnergy::value(const Positions& x) const {
  const std::vector<Index>& moving = moving_->vertices;
  const double pull = sum_in_chunks(static_cast<Index>(moving.size()), chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) {
      const Index v = moving[i];
      sum += pull_.mass[v] * (x.col(v) - patch_.rest.col(v)).squaredNorm();
    }
    return sum;
  });
  const double arap = sum_in_chunks(static_cast<Index>(triangles_.size()), chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) sum += arap_.triangle_energy(x, triangles_[i]);
    return sum;
  });
  const double orientation = sum_in_chunks(static_cast<Index>(triangles_.size()), chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) sum += orientation_.value(x, triangles_[i]);
    return sum;
  });
  const double bending = sum_in_chunks(static_cast<Index>(hinges_.size()), chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index i = begin; i < end; ++i) {
      const double r = bending_.residual(x, hinges_[i], nullptr);
      sum += bending_.weight(hinges_[i]) * r * r;
    }
    return sum;
  });
  return 0.5 * options_.pull * pull + arap_scale_ * arap + 0.5 * bending_scale_ * bending + orientation;
}

double ShapeEnergy::linearise(const Positions& x, Positions& gradient, StepOperator& step_operator) {
  const std::vector<Index>& slot = moving_->slot;
  gradient.setZero();
  double pull = 0;
  for (Index v : moving_->vertices) {
    const Vec3 d = x.col(v) - patch_.rest.col(v);
    pull += pull_.mass[v] * d.squaredNorm();
    gradient.col(v) += options_.pull * pull_.mass[v] * d;
  }
  const double stiffness = (1 - options_.rotation_damping) * arap_scale_ * arap_.weight();
  const Index triangle_count = static_cast<Index>(triangles_.size());
  const Index hinge_count = static_cast<Index>(hinges_.size());
  step_operator.strains.resize(options_.rotation_damping < 1 ? triangles_.size() : 0);
  step_operator.terms.resize(hinges_.size());
  energies_.resize(triangles_.size() + hinges_.size());
  scattered_(triangle_count + hinge_count, chunk, gradient, [&](Index begin, Index end, Positions& sums) {
    Eigen::Matrix3d forces;
    for (Index i = begin; i < std::min(end, triangle_count); ++i) {
      const Index t = triangles_[i];
      StepOperator::Strained strained;
      energies_[i] = arap_scale_ * arap_.linearise(x, t, forces, strained.strain);
      strained.stiffness = stiffness;
      for (int k = 0; k < 3; ++k) {
        const Index v = arap_.triangle(t)[k];
        strained.slot[k] = slot[v];
        sums.col(v) += arap_scale_ * forces.col(k);
      }
      if (!step_operator.strains.empty()) step_operator.strains[i] = strained;
    }
    for (Index i = std::max(begin, triangle_count); i < end; ++i) {
      const Index e = hinges_[i - triangle_count];
      StepOperator::RankOne& term = step_operator.terms[i - triangle_count];
      const double r = bending_.residual(x, e, &term.g);
      term.stiffness = bending_scale_ * bending_.weight(e);
      energies_[i] = 0.5 * term.stiffness * r * r;
      for (int k = 0; k < 4; ++k) {
        const Index v = bending_.hinge(e)[k];
        sums.col(v) += term.stiffness * r * term.g.col(k);
        term.slot[k] = slot[v];
      }
    }
  });
  double elastic = 0;
  for (const double e : energies_) elastic += e;
  double orientation = 0;
  OrientationPenalty::Term kept;
  StepOperator::RankOne term;
  for (Index t : triangles_) {
    if (!orientation_.evaluate(x, t, kept)) continue;
    orientation += kept.value;
    term.slot[3] = -1;
    term.g.col(3).setZero();
    for (int k = 0; k < 3; ++k) {
      const Index v = arap_.triangle(t)[k];
      gradient.col(v) += kept.force * kept.gradient.col(k);
      term.slot[k] = slot[v];
      term.g.col(k) = kept.gradient.col(k);
    }
    term.stiffness = kept.stiffness;
    step_operator.terms.push_back(term);
  }
  pull_energy_ = 0.5 * options_.pull * pull;
  orientation_energy_ = orientation;
  return pull_energy_ + elastic + orientation;
}

IterationRecord ShapeEnergy::terms() const {
  IterationRecord record;
  const auto hinges = energies_.begin() + static_cast<std::ptrdiff_t>(triangles_.size());
  record[EnergyTerm::pull] = pull_energy_;
  record[EnergyTerm::arap] = std::accumulate(energies_.begin(), hinges, 0.0);
  record[EnergyTerm::bending] = std::accumulate(hinges, energies_.end(), 0.0);
  record[EnergyTerm::orientation] = orientation_energy_;
  return record;
}

}  // namespace unsnarl
