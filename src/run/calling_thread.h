#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

#include "unsnarl/repair.h"

namespace unsnarl {

/// Threads of the pipeline look again after this time even if nobody wakes them. A wait without end needs a symbol of
/// libstdc++ that GCC 12 introduced and distributions with glibc 2.34 lack (unit: h)
inline constexpr std::chrono::hours longest_wait{1};

/// Work that calls back from any of its threads, and a caller who is to be called in its own thread alone: the work
/// runs in another one, and the caller's waits for what is to be called.
class CallingThread {
 public:
  CallingThread() = default;
  CallingThread(const CallingThread&) = delete;
  CallingThread& operator=(const CallingThread&) = delete;

  /// Returns when the work has ended; throws what it throws. Where no other thread can be had, it runs in this one.
  void run(const std::function<void()>& work);

  /// For the work, from any thread: has `function` called in the thread that called run(), and waits for its end.
  /// Throws what it throws. Without another thread, what other threads want called is left out.
  void call(const std::function<void()>& function);

 private:
  void serve();

  const std::thread::id id_ = std::this_thread::get_id();
  std::mutex turn_;   // held by who has something called
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  const std::function<void()>* wanted_ = nullptr;
  std::exception_ptr thrown_;
  bool is_serving_ = false, has_ended_ = false;
};

/// Returns work(context), with a context of its own where `context` is null. The work may report progress from any of
/// its threads; the caller is told in the thread that called this.
template <class Work>
std::invoke_result_t<Work, Context&> work_reporting_here(Context* context, const Work& work) {
  Context nobody;
  if (context == nullptr) return work(nobody);
  if (!context->on_progress) return work(*context);
  struct Restored {
    Context& context;
    const std::function<void(const Context::Progress&)> tell = std::exchange(context.on_progress, {});
    ~Restored() { context.on_progress = tell; }
  } callers{*context};
  CallingThread here;
  context->on_progress = [&](const Context::Progress& progress) { here.call([&] { callers.tell(progress); }); };
  std::invoke_result_t<Work, Context&> result;
  here.run([&] { result = work(*context); });
  return result;
}

}  // namespace unsnarl
