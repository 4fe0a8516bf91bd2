// SPDX-License-Identifier: BSD-3-Clause
// Jobs that run on several threads, with results in the order in which the jobs were begun.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace meniscus {

/// A queue of jobs. One thread owns it, begins all jobs and takes all results.
template <typename Input, typename Result>
class OrderedJobs {
 public:
  using Worker = std::function<Result(Input)>;

  /// Starts one thread for each worker, which does one job after another. A single worker has no thread: it does the
  /// jobs in take(), on the caller's thread. There must be at least one worker.
  explicit OrderedJobs(std::vector<Worker> workers) : workers_(std::move(workers)) {
    if (workers_.size() < 2) return;
    for (const Worker& worker : workers_) threads_.emplace_back([this, &worker] { work(worker); });
  }

  /// Waits for the running jobs. Jobs that have not begun are dropped.
  ~OrderedJobs() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
  }

  OrderedJobs(const OrderedJobs&) = delete;
  OrderedJobs& operator=(const OrderedJobs&) = delete;

  /// Adds a job, which the next free worker does.
  void begin(Input input) {
    std::packaged_task<Result(const Worker&)> task(
        [input = std::move(input)](const Worker& worker) mutable { return worker(std::move(input)); });
    results_.push_back(task.get_future());
    {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(std::move(task));
    }
    changed_.notify_one();
  }

  /// Returns how many jobs were begun whose results have not been taken.
  std::size_t pending() const { return results_.size(); }

  /// Waits for the earliest pending job and returns its result. Throws what the job threw.
  Result take() {
    if (threads_.empty()) do_next(workers_.front());
    std::future<Result> first = std::move(results_.front());
    results_.pop_front();
    return first.get();
  }

 private:
  void do_next(const Worker& worker) {
    auto task = std::move(waiting_.front());
    waiting_.pop_front();
    task(worker);
  }

  void work(const Worker& worker) {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return stop_ || !waiting_.empty(); });
      if (stop_) return;
      auto task = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      task(worker);
      task = {};  // frees the job's data now, on this thread
      lock.lock();
    }
  }

  std::vector<Worker> workers_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::packaged_task<Result(const Worker&)>> waiting_;
  std::deque<std::future<Result>> results_;
  bool stop_ = false;
  std::vector<std::jthread> threads_;  ///< last member: the threads end before what they use
};

}  // namespace meniscus
