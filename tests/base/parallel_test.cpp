#include "base/parallel.h"

#include <atomic>
#include <cerrno>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <dlfcn.h>
#include <pthread.h>

#include <gtest/gtest.h>

namespace {
// How many more threads this program can start; -1: as many as the machine allows.
std::atomic<int> threads_left = -1;
}  // namespace

// What Clang's address sanitizer has in its place, inside of the program.
extern "C" int __attribute__((weak))
__interceptor_pthread_create(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

// Stands before the C library's own function, which it calls unless no more threads may start.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*routine)(void*), void* argument) {
  if (threads_left == 0) return EAGAIN;
  if (threads_left > 0) --threads_left;
  static const auto next =
      reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
  static const auto real = __interceptor_pthread_create ? &__interceptor_pthread_create : next;
  return real(thread, attributes, routine, argument);
}

namespace panache {
namespace {

// How often each of `count` items was worked on.
std::vector<int> times_done(int count, int threads) {
  std::vector<std::atomic<int>> done(static_cast<size_t>(count));
  parallel_for(
      count, [&](int i) { ++done[static_cast<size_t>(i)]; }, threads);
  return {done.begin(), done.end()};
}

TEST(Parallel, each_item_is_worked_on_once_whatever_the_number_of_threads) {
  for (const int threads : {0, 1, 2, 7}) {
    for (const int count : {0, 1, 2, 100}) {
      EXPECT_EQ(times_done(count, threads), std::vector<int>(static_cast<size_t>(count), 1))
          << threads << " threads, " << count << " items";
    }
  }
}

TEST(Parallel, one_thread_is_the_callers_own) {
  threads_left = 0;
  std::vector<std::thread::id> ids;
  parallel_for(
      3, [&](int) { ids.push_back(std::this_thread::get_id()); }, 1);
  threads_left = -1;
  EXPECT_EQ(ids, std::vector(3, std::this_thread::get_id()));
}

TEST(Parallel, threads_that_cannot_start_leave_the_work_to_those_that_could) {
  for (const int can_start : {0, 1, 2}) {
    threads_left = can_start;
    const std::vector<int> done = times_done(100, 4);
    threads_left = -1;
    EXPECT_EQ(done, std::vector<int>(100, 1)) << can_start;
  }
}

TEST(Parallel, an_exception_of_any_item_reaches_the_caller) {
  for (const int threads : {1, 2, 4}) {
    for (const int bad : {0, 1, 50, 99}) {
      try {
        parallel_for(
            100,
            [&](int i) {
              if (i == bad) throw std::runtime_error("item " + std::to_string(i));
            },
            threads);
        FAIL() << "no exception came of item " << bad << " on " << threads << " threads";
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), "item " + std::to_string(bad));
      }
    }
  }
}

TEST(Parallel, exceptions_on_all_threads_give_the_caller_one) {
  EXPECT_THROW(parallel_for(
                   100, [](int) { throw std::bad_alloc(); }, 4),
               std::bad_alloc);
}

TEST(Parallel, no_item_begins_after_an_exception) {
  int begun = 0;
  EXPECT_THROW(parallel_for(
                   100,
                   [&](int i) {
                     ++begun;
                     if (i == 9) throw std::runtime_error("the tenth");
                   },
                   1),
               std::runtime_error);
  EXPECT_EQ(begun, 10);
}

}  // namespace
}  // namespace panache
