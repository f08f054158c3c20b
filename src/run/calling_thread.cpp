#include "run/calling_thread.h"

#include <new>
#include <system_error>
#include <utility>

namespace unsnarl {

void CallingThread::run(const std::function<void()>& work) {
  std::exception_ptr failure;
  std::thread worker;
  has_ended_ = false;
  try {
    is_serving_ = true;
    worker = std::thread([&] {
      try {
        work();
      } catch (...) {
        failure = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      has_ended_ = true;
      changed_.notify_all();
    });
  } catch (const std::system_error&) {
    is_serving_ = false;
  } catch (const std::bad_alloc&) {
    is_serving_ = false;
  }
  if (!is_serving_) return work();
  serve();
  worker.join();
  if (failure) std::rethrow_exception(failure);
}

void CallingThread::serve() {
  std::unique_lock lock(mutex_);
  for (;;) {
    while (wanted_ == nullptr && !has_ended_) changed_.wait_for(lock, longest_wait);
    if (wanted_ == nullptr) return;
    lock.unlock();
    try {
      (*wanted_)();
    } catch (...) {
      thrown_ = std::current_exception();
    }
    lock.lock();
    wanted_ = nullptr;
    changed_.notify_all();
  }
}

void CallingThread::call(const std::function<void()>& function) {
  if (!is_serving_) {
    if (std::this_thread::get_id() == id_) function();
    return;
  }
  const std::lock_guard turn(turn_);
  std::unique_lock lock(mutex_);
  wanted_ = &function;
  changed_.notify_all();
  while (wanted_ != nullptr) changed_.wait_for(lock, longest_wait);
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

}  // namespace unsnarl
