// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/live_stream.hpp"

#include <algorithm>

namespace muro::stream {

LiveStream::LiveStream(const std::string& name, Address& address, const Framing& framing, const Limits& limits,
                       Host& host, LockstepStream* lockstep)
    : address_(address),
      limits_(limits),
      lockstep_(lockstep),
      io_(IoThread::shared()),
      exchange_(limits, address.clients, lockstep),
      connections_(
          *io_, exchange_, framing, address.clients,
          address.certificate.empty() ? nullptr : std::make_unique<TlsServer>(address.certificate, address.key)),
      endpoint_(make_endpoint({*io_, connections_, address, name, host})),
      input_(std::max(address.baud, 1u)),
      output_(std::max(address.baud, 1u)) {
  endpoint_->open();
  io_->call([this] { endpoint_->start(); });
}

LiveStream::~LiveStream() {
  io_->call([this] {
    endpoint_->close();
    connections_.close();
  });
  io_->call([] {});  // waits until the running work has ended, too
}

bool LiveStream::begin(std::int64_t time, bool waits) {
  if (time < time_) {  // the simulation was reset
    input_.restart(time);
    output_.restart(time);
    std::fill(due_.begin(), due_.end(), time);
  }
  time_ = time;
  has_handed_out_message_ = false;
  if (address_.is_timed) send_what_has_passed();
  collect();
  bool is_in_time = true;
  if (waits && lockstep_ && !has_message()) {
    is_in_time = lockstep_->wait(time) != LockstepStream::Outcome::timed_out;
    collect();
  }
  if (address_.is_timed) set_due();
  return is_in_time;
}

/// Appends received events to those that were not handed out yet.
void LiveStream::collect() {
  if (!exchange_.has_arrived()) return;
  const std::size_t left = inbox_.entries.size() - next_;
  const bool is_wanted = left == 0 || (lockstep_ ? !has_message() : address_.is_timed && left < limits_.input_messages);
  if (!is_wanted) return;
  inbox_.forget(next_);
  due_.erase(due_.begin(), due_.begin() + std::ptrdiff_t(std::min(next_, due_.size())));
  next_ = 0;
  if (exchange_.collect(inbox_)) io_->signal(connections_);
}

bool LiveStream::has_message() const {
  return std::any_of(inbox_.entries.begin() + std::ptrdiff_t(next_), inbox_.entries.end(),
                     [](const Inbox::Entry& e) { return e.kind == Event::Kind::message; });
}

/// Puts received events on the line. In lockstep this is the next message only: the others follow after its answer.
void LiveStream::set_due() {
  input_.advance(time_);
  while (due_.size() < inbox_.entries.size()) {
    if (lockstep_ && std::any_of(inbox_.entries.begin() + std::ptrdiff_t(next_),
                                 inbox_.entries.begin() + std::ptrdiff_t(due_.size()),
                                 [](const Inbox::Entry& e) { return e.kind == Event::Kind::message; }))
      return;
    const Inbox::Entry& entry = inbox_.entries[due_.size()];
    due_.push_back(entry.size > 0 ? input_.put(time_, entry.size) : std::max(time_, input_.end()));
  }
}

const Event* LiveStream::next() {
  if (is_read_through() || (lockstep_ && has_handed_out_message_)) return nullptr;
  if (address_.is_timed && (next_ >= due_.size() || due_[next_] > time_)) return nullptr;
  const Inbox::Entry& entry = inbox_.entries[next_++];
  has_handed_out_message_ |= entry.kind == Event::Kind::message;
  event_ = {entry.kind, entry.client, std::string_view(inbox_.bytes).substr(entry.begin, entry.size)};
  if (entry.kind == Event::Kind::disconnected) {
    if (!limits_.has_late_replies) disconnect(entry.client);
  } else if (entry.kind == Event::Kind::connected) {
    if (is_ending_ && exchange_.end(listener_)) io_->signal(connections_);  // the earlier client
    output_.clear();
    listener_ = entry.client;
    is_ending_ = false;
  }
  return &event_;
}

void LiveStream::send_what_has_passed() {
  const std::string_view passed = output_.advance(time_);
  if (!passed.empty()) wake(exchange_.send(listener_, passed));
  for (std::size_t i = output_.take_answers(); lockstep_ && i > 0; --i) lockstep_->message_answered();
  if (is_ending_ && output_.waiting() == 0 && exchange_.end(listener_)) io_->signal(connections_);
}

bool LiveStream::send(std::uint32_t client, std::string_view bytes, std::size_t most) {
  if (address_.is_timed) return client != listener_ || send_timed(bytes, most);
  return wake(exchange_.send(client, bytes, most));
}

void LiveStream::send_to_all(std::string_view bytes) {
  if (address_.is_timed)
    send_timed(bytes, limits_.output_bytes);
  else
    wake(exchange_.send_to_all(bytes));
}

bool LiveStream::send_timed(std::string_view bytes, std::size_t most) {
  if (output_.waiting() > 0 && output_.waiting() + bytes.size() > most) {
    exchange_.count_dropped();
    return false;
  }
  output_.put(time_, bytes);
  return true;
}

void LiveStream::answered() {
  if (!lockstep_) return;
  if (address_.is_timed && output_.waiting() > 0)
    output_.put_answer();
  else
    lockstep_->message_answered();
}

void LiveStream::disconnect(std::uint32_t client) {
  if (address_.is_timed && client == listener_ && output_.waiting() > 0)
    is_ending_ = true;
  else if (exchange_.end(client))
    io_->signal(connections_);
}

void LiveStream::set_baud(std::uint32_t baud) {
  endpoint_->set_baud(baud);
  if (!address_.is_timed) return;
  const std::uint32_t rate = baud == 0 ? address_.baud : baud;
  input_.set_baud(time_, rate);
  output_.set_baud(time_, rate);
}

bool LiveStream::wake(Exchange::Sent sent) {
  if (sent == Exchange::Sent::queued) io_->signal(connections_);
  return sent != Exchange::Sent::dropped;
}

}  // namespace muro::stream
