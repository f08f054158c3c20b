#include <benchmark/benchmark.h>

#include "contact/intersection_finder.h"
#include "crossing_sheets.h"

namespace unsnarl {
namespace {

void report_faces(benchmark::State& state, const CrossingSheets& sheets, std::size_t pairs) {
  state.counters["pairs"] = static_cast<double>(pairs);
  state.counters["faces/s"] =
      benchmark::Counter(static_cast<double>(sheets.triangles.size()), benchmark::Counter::kIsIterationInvariantRate);
}

/// Tree and pairs from nothing, as for a file just read.
void find_from_scratch(benchmark::State& state) {
  const CrossingSheets sheets = make_crossing_sheets(static_cast<Index>(state.range(0)));
  std::size_t pairs = 0;
  for (auto _ : state) pairs = IntersectionFinder(sheets.triangles).find(sheets.x).size();
  report_faces(state, sheets, pairs);
}

/// The tree is refitted, as inside an optimisation.
void find_again_after_motion(benchmark::State& state) {
  CrossingSheets sheets = make_crossing_sheets(static_cast<Index>(state.range(0)));
  IntersectionFinder finder(sheets.triangles);
  std::size_t pairs = finder.find(sheets.x).size();
  const double step = 1e-5 / static_cast<double>(state.range(0));
  for (auto _ : state) {
    sheets.x.array() += step;
    pairs = finder.find(sheets.x).size();
  }
  report_faces(state, sheets, pairs);
}

BENCHMARK(find_from_scratch)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(find_again_after_motion)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace unsnarl
