#include <emscripten.h>

#include "unsnarl/unsnarl.h"

// Whoever calls from JavaScript sets Module.onProgress.
EM_JS(int, unsnarl_tell_progress, (double fraction, const char* phase, double pairs_left, double displacement_rel),
      { return Module["onProgress"](fraction, UTF8ToString(phase), pairs_left, displacement_rel) ? 1 : 0; });

/// A context that tells Module.onProgress how far it has come, and is cancelled where that returns true: so that no
/// function of JavaScript has to become one of C.
extern "C" EMSCRIPTEN_KEEPALIVE unsnarl_context* unsnarl_context_of_javascript() {
  return unsnarl_context_new(
      [](const unsnarl_progress* progress, void*) {
        return unsnarl_tell_progress(progress->fraction, progress->phase, static_cast<double>(progress->pairs_left),
                                     progress->displacement_rel);
      },
      nullptr);
}
