#include <benchmark/benchmark.h>

#include "contact/intersection_finder.h"
#include "crossing_sheets.h"
#include "energy/arap.h"
#include "energy/gaussian_contact.h"
#include "energy/minkowski_penalty.h"

namespace unsnarl {
namespace {

template <class Energy>
void evaluate(benchmark::State& state, Energy& energy, const Positions& x, std::size_t items, const char* per_item) {
  Positions gradient = Positions::Zero(3, x.cols());
  for (auto _ : state) benchmark::DoNotOptimize(energy.value_and_gradient(x, gradient));
  state.counters[per_item] = benchmark::Counter(
      static_cast<double>(items), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void minkowski(benchmark::State& state) {
  const CrossingSheets sheets = make_crossing_sheets(static_cast<Index>(state.range(0)));
  MinkowskiOptions options;
  options.margin = 0.03 / std::sqrt(static_cast<double>(state.range(0)));
  MinkowskiPenalty energy(sheets.triangles, options);
  for (const IntersectingPair& pair : IntersectionFinder(sheets.triangles).find(sheets.x))
    energy.pairs.push_back({pair.a, pair.b});
  evaluate(state, energy, sheets.x, energy.pairs.size(), "s/pair");
}

void arap(benchmark::State& state) {
  const CrossingSheets sheets = make_crossing_sheets(static_cast<Index>(state.range(0)));
  Positions x = sheets.x;
  x.row(2) *= 1.7;
  Arap energy(sheets.triangles, sheets.x, static_cast<Index>(x.cols()));
  evaluate(state, energy, x, static_cast<std::size_t>(x.cols()), "s/vertex");
}

void gaussian(benchmark::State& state) {
  const CrossingSheets sheets = make_crossing_sheets(static_cast<Index>(state.range(0)));
  const double bandwidth = 2 / std::sqrt(static_cast<double>(state.range(0)));
  GaussianContact<3> energy;
  energy.squared_bandwidth.assign(static_cast<std::size_t>(sheets.x.cols()), bandwidth * bandwidth);
  for (const auto& [i, j] : pairs_within<3>(sheets.x, 2.2 * bandwidth)) energy.pairs.push_back({i, j, 1.0});
  evaluate(state, energy, sheets.x, energy.pairs.size(), "s/pair");
}

BENCHMARK(minkowski)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(arap)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(gaussian)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace
}  // namespace unsnarl
