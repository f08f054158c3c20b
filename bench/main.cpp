// Google Benchmark with one more column: every time as a multiple of a fixed piece of arithmetic that ran just before
// and after it on the same machine. Ratios survive a busy or a different machine far better than seconds do.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace {

/// Seconds of 2^22 dependent multiply-adds, about 10 ms; the fastest of several, as the least disturbed.
double reference_s() {
  double best = 1e300;
  for (int attempt = 0; attempt < 5; ++attempt) {
    const auto start = std::chrono::steady_clock::now();
    double x = 0.5;
    for (int k = 0; k < 1 << 22; ++k) x = 0.999 * x + 1e-3;
    benchmark::DoNotOptimize(x);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

class RatioReporter : public benchmark::ConsoleReporter {
 public:
  RatioReporter() : ConsoleReporter(OO_Tabular), before_s_(reference_s()) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    const double after_s = reference_s();
    const double unit_s = std::min(before_s_, after_s);
    before_s_ = after_s;
    std::vector<Run> with_ratio = runs;
    for (Run& run : with_ratio) {
      if (run.error_occurred) continue;
      const double seconds = run.GetAdjustedRealTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
      run.counters["ratio"] = benchmark::Counter(seconds / unit_s);
    }
    ConsoleReporter::ReportRuns(with_ratio);
  }

 private:
  double before_s_;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::printf("ratio: time of one iteration / time of the reference, here %.2f ms\n", 1e3 * reference_s());
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
