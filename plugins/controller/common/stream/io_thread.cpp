// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/io_thread.hpp"

#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <boost/asio/executor_work_guard.hpp>
#include <csignal>
#include <system_error>

#include "muro/algorithm.hpp"
#include "plugins/controller/common/stream/system_error.hpp"

namespace muro::stream {

namespace {

constexpr std::size_t usual_sources = 4096;

int new_event() {
  const int fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (fd < 0) throw_system_error("cannot open a stream", errno);
  return fd;
}

/// Blocks all signals that are not faults of the thread itself. So SIGINT and similar signals go to the main thread,
/// and SIGPIPE, caused by a client that has left, goes to no thread. A new thread inherits this.
class BlockedSignals {
 public:
  BlockedSignals() {
    sigset_t all;
    sigfillset(&all);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS}) sigdelset(&all, fault);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

 private:
  sigset_t before_;
};

/// Runs until the context is stopped. A handler that runs out of memory loses its client, not the others.
void run(asio::io_context& context) {
  const auto work = asio::make_work_guard(context);
  while (!context.stopped()) {
    try {
      context.run();
    } catch (const std::exception&) {
      continue;
    }
  }
}

}  // namespace

std::shared_ptr<IoThread> IoThread::shared() {
  static std::mutex mutex;
  static std::weak_ptr<IoThread> of_all;
  const std::lock_guard lock(mutex);
  std::shared_ptr<IoThread> thread = of_all.lock();
  if (!thread) of_all = thread = std::make_shared<IoThread>();
  return thread;
}

IoThread::IoThread() : wake_(context_, new_event()) {
  signalled_.reserve(usual_sources);
  taken_.reserve(usual_sources);
  wait_for_signals();
  const BlockedSignals blocked;
  try {
    thread_ = std::thread([this] { run(context_); });
  } catch (const std::system_error& e) {  // limits of users, containers and memory
    throw Error("no thread can be started for streams: " + e.code().message() +
                "; this user or container has as many as it may, or there is no memory for another");
  }
  ::pthread_setname_np(thread_.native_handle(), "muro streams");
}

IoThread::~IoThread() {
  context_.stop();
  thread_.join();
}

void IoThread::signal(Source& source) noexcept {
  if (source.is_signalled_.exchange(true)) return;
  {
    const std::lock_guard lock(mutex_);
    signalled_.push_back(&source);
    if (signalled_.size() > 1) return;
  }
  const std::uint64_t one = 1;
  static_cast<void>(!::write(wake_.native_handle(), &one, sizeof one));  // fails only when the thread is awake already
}

void IoThread::wait_for_signals() {
  wake_.async_wait(asio::posix::descriptor_base::wait_read, [this](const boost::system::error_code& error) {
    if (error) return;
    std::uint64_t count = 0;
    static_cast<void>(!::read(wake_.native_handle(), &count, sizeof count));
    wait_for_signals();
    take_signals();
  });
}

void IoThread::take_signals() {
  {
    const std::lock_guard lock(mutex_);
    taken_.swap(signalled_);
  }
  for (Source* const source : taken_) {
    source->is_signalled_ = false;
    try {
      source->on_signal();
    } catch (const std::exception&) {
      continue;  // out of memory; the other sources continue
    }
  }
  taken_.clear();
}

}  // namespace muro::stream
