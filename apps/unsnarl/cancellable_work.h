#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <type_traits>

#include "interruption.h"
#include "progress.h"
#include "standard_streams.h"
#include "unsnarl/errors.h"
#include "unsnarl/repair.h"

namespace unsnarl::app {

/// While it lives, an interruption cancels the work instead of ending the program.
class CancelledByInterruption {
 public:
  CancelledByInterruption(Interruption& interruption, Context& context, bool quiet) : interruption_(interruption) {
    interruption_.set_handler([&context, quiet] {
      context.cancel();
      if (!quiet) tell("\nstopping; press Control-C again to end at once\n");
    });
  }
  ~CancelledByInterruption() { interruption_.set_handler(nullptr); }
  CancelledByInterruption(const CancelledByInterruption&) = delete;
  CancelledByInterruption& operator=(const CancelledByInterruption&) = delete;

 private:
  Interruption& interruption_;
};

/// Returns work(context), whose progress `display` shows and which an interruption cancels. `input`: the files that the
/// work is about; what makes no sense in them (std::invalid_argument) becomes a FileError that names them.
template <class Work>
std::invoke_result_t<Work, Context*> cancellable(ProgressDisplay& display, bool quiet, Interruption& interruption,
                                                 const std::string& input, const Work& work) {
  Context context;
  context.on_progress = [&](const Context::Progress& progress) { display.show(progress); };
  const CancelledByInterruption cancelled(interruption, context, quiet);
  try {
    return work(&context);
  } catch (const std::invalid_argument& error) {
    throw FileError(fmt::format("{}: {}", input, error.what()));
  }
}

/// The same with a display of its own, which is gone when the work has ended.
template <class Work>
std::invoke_result_t<Work, Context*> cancellable(const std::string& progress, bool quiet, Interruption& interruption,
                                                 const std::string& input, const Work& work) {
  ProgressDisplay display(progress, quiet);
  return cancellable(display, quiet, interruption, input, work);
}

}  // namespace unsnarl::app
