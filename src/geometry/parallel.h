#pragma once

#include <string>
#include <utility>

#include "unsnarl/threads.h"

// OneTBB or threads of the standard library run loops in parallel. Only these files know which of them does.
#ifndef UNSNARL_TBB
#error "UNSNARL_TBB says whether oneTBB runs the loops: link with the target unsnarl_compile_options"
#elif UNSNARL_TBB
#include "geometry/parallel_by_tbb.h"
#else
#include "geometry/parallel_by_threads.h"
#endif

namespace unsnarl {

/// Calls work(k) for every k in [0, count), several at a time and in any order. Ends when all have ended. One of the
/// exceptions that they throw, if any, is thrown then; the rest need not be called.
template <class Count, class Work>
void parallel_for(Count count, Work&& work) {
  loops::run(count, std::forward<Work>(work));
}

/// Calls work(k) for each k in [0, count), each by a thread of its own where there are so many.
template <class Work>
void run_on_threads(int count, Work&& work) {
  loops::run_on_threads(count, std::forward<Work>(work));
}

/// Calls work() so that this thread takes part in no other call of the loop around it while an inner loop is waited
/// for.
template <class Work>
void run_isolated(Work&& work) {
  loops::run_isolated(std::forward<Work>(work));
}

/// A value for each thread that asks for one in a loop: PerThread(make), local(). It is made when the thread first
/// asks.
template <class Value>
using PerThread = loops::PerThread<Value>;

/// Returns the version of oneTBB; empty where the standard library runs the loops.
inline std::string version_of_tbb() {
  return loops::version_of_tbb();
}

}  // namespace unsnarl
