// SPDX-License-Identifier: MIT
#include "plugins/common/stream/pty_watch.hpp"

namespace muro::stream {

std::shared_ptr<PtyWatch> PtyWatch::shared(IoThread& io) {
  static std::mutex mutex;
  static std::weak_ptr<PtyWatch> of_all;
  const std::lock_guard lock(mutex);
  std::shared_ptr<PtyWatch> watch = of_all.lock();
  if (!watch) of_all = watch = std::make_shared<PtyWatch>(io);
  return watch;
}

bool has_client(int master) {
  pollfd state{master, 0, 0};
  return ::poll(&state, 1, 0) == 0;  // POLLHUP tells that nobody has it open
}

void PtyWatch::wait(int master, std::function<void()> opened) {
  opened_[master] = std::move(opened);
  if (!is_waiting_) look_later();
}

void PtyWatch::forget(int master) { opened_.erase(master); }

void PtyWatch::look_later() {
  is_waiting_ = true;
  timer_.expires_after(std::chrono::milliseconds(20));
  timer_.async_wait([this](const boost::system::error_code& cancelled) {
    if (!cancelled) look();
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
  is_waiting_ = !opened_.empty();
  if (is_waiting_) look_later();
}

}  // namespace muro::stream
