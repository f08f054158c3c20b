#include "run/calling_thread.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace unsnarl {
namespace {

TEST(CallingThread, calls_of_any_thread_are_made_in_the_one_that_runs_the_work) {
  const std::thread::id here = std::this_thread::get_id();
  CallingThread calling;
  std::thread::id of_work;
  int calls = 0, elsewhere = 0;  // written by the calls alone, one after the other
  calling.run([&] {
    of_work = std::this_thread::get_id();
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k)
      threads.emplace_back([&] {
        for (int i = 0; i < 100; ++i)
          calling.call([&] {
            ++calls;
            elsewhere += std::this_thread::get_id() != here;
          });
      });
    for (std::thread& thread : threads) thread.join();
  });
  EXPECT_NE(of_work, here);
  EXPECT_EQ(calls, 400);
  EXPECT_EQ(elsewhere, 0);
}

TEST(CallingThread, the_work_waits_for_the_end_of_a_call) {
  CallingThread calling;
  calling.run([&] {
    bool has_ended = false;
    calling.call([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      has_ended = true;
    });
    EXPECT_TRUE(has_ended);
  });
}

TEST(CallingThread, what_the_work_throws_comes_out) {
  CallingThread calling;
  EXPECT_THROW(calling.run([] { throw std::out_of_range("work"); }), std::out_of_range);
}

TEST(CallingThread, what_a_call_throws_goes_to_where_it_was_asked_for) {
  CallingThread calling;
  bool was_seen = false;
  calling.run([&] {
    try {
      calling.call([] { throw std::out_of_range("call"); });
    } catch (const std::out_of_range& error) {
      was_seen = error.what() == std::string("call");
    }
    calling.call([] {});  // and is forgotten then
  });
  EXPECT_TRUE(was_seen);
  EXPECT_THROW(calling.run([&] { calling.call([] { throw std::out_of_range("call"); }); }), std::out_of_range);
}

}  // namespace
}  // namespace unsnarl
