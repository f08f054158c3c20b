#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace unsnarl {

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

}  // namespace unsnarl
