#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "energy/hessian.h"
#include "geometry/parallel_sums.h"
#include "geometry/types.h"

namespace unsnarl {

/// The one form of the energies that Newton's method minimises: a sum over elements (vertices, triangles, hinges,
/// contacts).
///
///   size()                  number of elements
///   vertices(element)       the vertices it depends on; -1: none
///   value(x, element)       its energy
///   linearise(x, element, weight, gradient, hessian)
///                           returns weight * its energy, adds weight * its gradient, and appends terms whose sum is
///                           weight times a positive semidefinite approximation of its Hessian
template <class E>
concept ElementEnergy = requires(const E& energy, const Positions& x, Index element, double weight, Positions& gradient,
                                 HessianTerms& hessian) {
  { energy.size() } -> std::same_as<Index>;
  { *energy.vertices(element).begin() } -> std::convertible_to<Index>;
  { energy.value(x, element) } -> std::same_as<double>;
  { energy.linearise(x, element, weight, gradient, hessian) } -> std::same_as<double>;
};

/// sum_k weight_k E_k over the chosen elements of several energies. Parallel; the same bytes at any number of threads.
template <ElementEnergy... Energies>
class EnergySum {
 public:
  template <class E>
  struct Part {
    E energy;
    double weight = 1;
    std::vector<Index> elements = {};  ///< the sum runs over these; none at first

    void take_all() {
      elements.resize(static_cast<std::size_t>(energy.size()));
      for (std::size_t k = 0; k < elements.size(); ++k) elements[k] = static_cast<Index>(k);
    }
    /// Takes the elements with a vertex that moves.
    void restrict_to(std::span<const std::uint8_t> moves) {
      elements.clear();
      for (Index e = 0; e < energy.size(); ++e) {
        const auto& vertices = energy.vertices(e);
        if (std::any_of(vertices.begin(), vertices.end(), [&](Index v) { return v >= 0 && moves[v]; }))
          elements.push_back(e);
      }
    }
  };

  EnergySum() = default;
  explicit EnergySum(Part<Energies>... parts) : parts_(std::move(parts)...) {}

  template <class E>
  Part<E>& part() {
    return std::get<Part<E>>(parts_);
  }
  template <class E>
  const Part<E>& part() const {
    return std::get<Part<E>>(parts_);
  }

  double value(const Positions& x) const {
    const auto of = [&](const auto& part) {
      return part.weight * sum_in_chunks(size_of(part), chunk, [&](Index begin, Index end) {
               double sum = 0;
               for (Index k = begin; k < end; ++k) sum += part.energy.value(x, part.elements[k]);
               return sum;
             });
    };
    return std::apply([&](const auto&... parts) { return (0.0 + ... + of(parts)); }, parts_);
  }

  /// The value. Replaces the gradient (all vertices; the caller drops what does not move) and the Hessian over the
  /// vertices with a slot.
  double linearise(const Positions& x, std::span<const Index> slot, Index unknowns, Positions& gradient,
                   Hessian& hessian) {
    gradient.setZero();
    sums_ = {};
    const std::span<HessianTerms> terms = hessian.begin(most_parts);
    std::apply([&](const auto&... parts) { linearise_parts(x, gradient, terms, parts...); }, parts_);
    hessian.assemble(slot, unknowns);
    double total = 0;
    for (std::size_t k = 0; k < count; ++k) total += sum_of(k);
    return total;
  }

  /// The weighted value of one energy where the sum was linearised last.
  template <class E>
  double last() const {
    std::size_t k = 0, found = 0;
    ((std::same_as<E, Energies> ? found = k++ : k++), ...);
    return sum_of(found);
  }

 private:
  /// A task of a parallel loop has this many elements (unit: elements)
  static constexpr Index chunk = 1024;
  static constexpr std::size_t count = sizeof...(Energies);
  static constexpr std::size_t most_parts = ScatteredSum::most_parts;

  template <class E>
  static Index size_of(const Part<E>& part) {
    return static_cast<Index>(part.elements.size());
  }

  double sum_of(std::size_t energy) const {
    double sum = 0;
    for (const auto& sums : sums_) sum += sums[energy];
    return sum;
  }

  /// All elements are numbered one after the other, so that one scattered sum does for all.
  void linearise_parts(const Positions& x, Positions& gradient, std::span<HessianTerms> terms, const auto&... parts) {
    const Index total = (Index{0} + ... + size_of(parts));
    scattered_(total, chunk, gradient, [&](Index begin, Index end, Positions& sums, Index task) {
      Index offset = 0;
      std::size_t k = 0;
      const auto add = [&](const auto& part) {
        const Index first = std::max(begin - offset, Index{0}), last = std::min(end - offset, size_of(part));
        for (Index i = first; i < last; ++i)
          sums_[task][k] += part.energy.linearise(x, part.elements[i], part.weight, sums, terms[task]);
        offset += size_of(part);
        ++k;
      };
      (add(parts), ...);
    });
  }

  std::tuple<Part<Energies>...> parts_;
  std::array<std::array<double, count>, most_parts> sums_ = {};  // of each task
  ScatteredSum scattered_;
};

}  // namespace unsnarl
