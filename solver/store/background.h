#pragma once
#include <future>
#include <utility>

namespace lamella {

/// Does one task beside the caller: files are written while the simulation goes on.
class Background {
public:
  /// Waits for the task before, see wait(), and starts this one.
  template <class Task>
  void start(Task&& task) {
    wait();
    pending_ = std::async(std::launch::async, std::forward<Task>(task));
  }

  /// Until the task is done; throws what it threw. The destructor waits too.
  void wait() {
    if (pending_.valid()) pending_.get();
  }

private:
  std::future<void> pending_;
};

} // namespace lamella
