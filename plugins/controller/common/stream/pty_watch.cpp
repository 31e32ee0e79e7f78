// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/pty_watch.hpp"

#include <sys/inotify.h>
#include <unistd.h>

namespace muro::stream {

std::shared_ptr<PtyWatch> PtyWatch::shared(IoThread& io) {
  static std::mutex mutex;
  static std::weak_ptr<PtyWatch> of_all;
  const std::lock_guard lock(mutex);
  std::shared_ptr<PtyWatch> watch = of_all.lock();
  if (!watch) of_all = watch = std::make_shared<PtyWatch>(io);
  return watch;
}

PtyWatch::PtyWatch(IoThread& io) : timer_(io.context()), folder_(io.context()) {
  const int folder = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (folder < 0) return;
  if (::inotify_add_watch(folder, "/dev/pts", IN_OPEN) >= 0)
    folder_.assign(folder);
  else
    ::close(folder);
}

bool has_client(int master) {
  pollfd state{master, 0, 0};
  return ::poll(&state, 1, 0) == 0;  // POLLHUP means that no client has it open
}

void PtyWatch::wait(int master, std::function<void()> opened) {
  opened_[master] = std::move(opened);
  look_later();
  look_when_told();
}

void PtyWatch::forget(int master) { opened_.erase(master); }

void PtyWatch::look_later() {
  if (std::exchange(has_timer_, true)) return;
  timer_.expires_after(std::chrono::milliseconds(folder_.is_open() ? 1000 : 20));
  timer_.async_wait([weak = weak_from_this()](const boost::system::error_code& cancelled) {
    const std::shared_ptr<PtyWatch> self = weak.lock();
    if (cancelled || !self) return;
    self->has_timer_ = false;
    self->look();
  });
}

void PtyWatch::look_when_told() {
  if (!folder_.is_open() || std::exchange(is_told_, true)) return;
  folder_.async_wait(asio::posix::descriptor_base::wait_read,
                     [weak = weak_from_this()](const boost::system::error_code& cancelled) {
                       const std::shared_ptr<PtyWatch> self = weak.lock();
                       if (cancelled || !self) return;
                       self->is_told_ = false;
                       char events[4096];
                       while (::read(self->folder_.native_handle(), events, sizeof events) > 0) continue;
                       self->look();
                     });
}

void PtyWatch::look() {
  masters_.clear();
  for (const auto& [master, opened] : opened_) masters_.push_back({master, POLLIN, 0});
  ::poll(masters_.data(), nfds_t(masters_.size()), 0);
  for (const pollfd& state : masters_) {
    const bool is_left = (state.revents & POLLHUP) != 0 && (state.revents & POLLIN) == 0;
    if (is_left) continue;
    if (const auto opened = opened_.extract(state.fd)) opened.mapped()();
  }
  if (opened_.empty()) return;
  look_later();
  look_when_told();
}

}  // namespace muro::stream
