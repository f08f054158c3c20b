// Repairs in a thread of its own, shows how far it is, and stops it when asked to.
#include <unsnarl/repair.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "crossing_sheets.h"

int main() {
  const unsnarl::Surface surface = crossing_sheets();

  // What the repair tells is called in its thread; another one, a window's say, looks at it when it likes.
  std::atomic<double> fraction = 0;
  std::atomic<bool> done = false;
  unsnarl::Context context;
  context.on_progress = [&](const unsnarl::Context::Progress& progress) { fraction = progress.fraction; };

  unsnarl::RepairResult result;
  std::thread worker([&] {
    result = unsnarl::repair(surface, {}, &context);
    done = true;
  });
  while (!done) {
    std::printf("%3.0f %%\n", 100 * fraction);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  worker.join();
  std::printf("%s\n", std::string(to_string(result.status)).c_str());

  // Cancelled, here before it begins: the positions are those of the input, or better ones.
  context.cancel();
  const unsnarl::RepairResult stopped = unsnarl::repair(surface, {}, &context);
  std::printf("%s\n", std::string(to_string(stopped.status)).c_str());
  return result.status == unsnarl::Status::embedded && stopped.status == unsnarl::Status::cancelled ? 0 : 1;
}
