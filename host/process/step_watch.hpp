// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace muro::host {

/// Ends the process, with exit code 1, when a step takes too long: one line names algorithm, robot, library and
/// simulated time, and the stack of calls is printed. Steps of algorithms that run alone, such as a window that pauses,
/// may take any time.
class StepWatch {
 public:
  /// `timeout`: s of wall-clock time; 0 or less: no watch.
  explicit StepWatch(double timeout);
  ~StepWatch();
  StepWatch(const StepWatch&) = delete;
  StepWatch& operator=(const StepWatch&) = delete;

 private:
  void watch();

  double timeout_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace muro::host
