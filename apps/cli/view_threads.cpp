#include "view_threads.h"

#include <system_error>

namespace panache::cli {

ViewThreads::ViewThreads(size_t wanted) {
  threads_.reserve(wanted);
  while (threads_.size() < wanted) {
    try {
      threads_.emplace_back([this] { work(); });
    } catch (...) {
      if (threads_.empty()) throw;
      break;
    }
  }
}

ViewThreads::~ViewThreads() { shutdown(); }

ViewThreads::Enqueued ViewThreads::enqueue(std::function<void()> job) {
  {
    const std::scoped_lock lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  changed_.notify_one();
  return Enqueued(true);
}

void ViewThreads::shutdown() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

void ViewThreads::work() {
  for (;;) {
    std::function<void()> job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return over_ || !jobs_.empty(); });
      if (jobs_.empty()) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    try {
      job();
    } catch (...) {  // Without memory: the request gets no answer.
    }
  }
}

}  // namespace panache::cli
