#pragma once
// The threads that answer requests of the page.

#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include <httplib.h>

namespace panache::cli {

// Up to `wanted` threads, as many as can be started. httplib's own would end the program where one
// of them cannot, or where a request finds no memory; here that request gets no answer.
class ViewThreads final : public httplib::TaskQueue {
 public:
  // Throws std::system_error where no thread can be started.
  explicit ViewThreads(size_t wanted);
  ~ViewThreads() override;
  ViewThreads(const ViewThreads&) = delete;
  ViewThreads& operator=(const ViewThreads&) = delete;

  // Newer releases want to hear that there was room.
  using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue(nullptr));
  Enqueued enqueue(std::function<void()> job) override;
  void shutdown() override;

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::function<void()>> jobs_;  // Guarded by the mutex, and so is:
  bool over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace panache::cli
