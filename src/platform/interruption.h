#pragma once

#include <functional>

namespace unsnarl::platform {

/// Calls take() in a thread of its own, which may do what a signal handler must not, for each Ctrl-C and polite request
/// to end (SIGINT, SIGTERM, SIGHUP; on Windows Ctrl-Break and the closing of the window too) from now on. Those that
/// are ignored at the start (nohup) stay ignored. To be called before any other thread starts.
///
/// From then on a call of the system fails, and the process goes on, where a signal would end it without a word: a
/// reader of the output has gone away, or a file is beyond the limit that the shell sets.
void take_requests_to_end(std::function<void()> take);

/// To be called now and then by work that can be cancelled: in WebAssembly, where no thread could wait for them,
/// requests are taken here, in the thread that calls. Elsewhere it does nothing.
void look_for_requests_to_end();

}  // namespace unsnarl::platform
