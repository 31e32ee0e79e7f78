// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace muro::stream {

namespace asio = boost::asio;

/// The thread in which all streams of a plugin read and write. It lives while one of them is open.
class IoThread {
 public:
  /// An object that the thread attends to after a step has signalled it.
  class Source {
   public:
    virtual ~Source() = default;
    virtual void on_signal() = 0;  ///< [I/O thread]

   private:
    friend class IoThread;
    std::atomic<bool> is_signalled_{false};
  };

  static std::shared_ptr<IoThread> shared();
  IoThread();
  IoThread(const IoThread&) = delete;
  IoThread& operator=(const IoThread&) = delete;
  ~IoThread();

  asio::io_context& context() { return context_; }

  /// Makes the thread call source.on_signal() soon, once for all signals until then. Allocates nothing. [any thread]
  void signal(Source& source) noexcept;

  /// Runs `work` in the thread, after all earlier signals, and waits for its end. Not called in the thread itself.
  template <class Work>
  void call(Work work) {
    std::packaged_task<void()> task([&] {
      take_signals();
      work();
    });
    asio::post(context_, [&task] { task(); });
    task.get_future().get();
  }

 private:
  void wait_for_signals();
  void take_signals();

  asio::io_context context_{1};
  asio::posix::stream_descriptor wake_;
  std::mutex mutex_;
  std::vector<Source*> signalled_;  ///< guarded
  std::vector<Source*> taken_;      ///< [I/O thread]
  std::thread thread_;
};

}  // namespace muro::stream
