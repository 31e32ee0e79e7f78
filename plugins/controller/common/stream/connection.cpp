// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/connection.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

namespace muro::stream {

namespace {

constexpr std::size_t chunk = 16384;  // most bytes that one read takes; then other clients get their turn
constexpr auto time_to_take_the_rest = std::chrono::seconds(5);  // then a client that does not read is cut off

}  // namespace

Connection::Connection(IoThread& io, Exchange& exchange, const Framing& framing, std::shared_ptr<Client> client,
                       int descriptor, Descriptor kind, std::unique_ptr<TlsSession> tls,
                       std::function<void(Connection&)> closed)
    : exchange_(exchange),
      framing_(framing),
      client_(std::move(client)),
      stream_(io.context(), descriptor),
      deadline_(io.context()),
      kind_(kind),
      tls_(std::move(tls)),
      encrypted_(tls_ ? new char[chunk] : nullptr),
      closed_(std::move(closed)),
      capacity_(framing.longest + chunk),
      input_(new char[capacity_]) {
  boost::system::error_code ignored;
  stream_.non_blocking(true, ignored);
}

void Connection::attend() {
  if (is_closed_) return;
  if (!is_ending_ && exchange_.is_ending(*client_)) {
    is_ending_ = true;
    end_input();
    deadline_.expires_after(time_to_take_the_rest);
    deadline_.async_wait([self = shared_from_this()](const boost::system::error_code& error) {
      if (!error) self->fail();
    });
  }
  if (is_full_ && !is_silent_) {
    is_full_ = false;
    if (take_messages() && (!tls_ || decrypt())) read();
  }
  if (!is_closed_) write();
}

void Connection::read() {
  if (is_reading_ || is_closed_) return;
  make_room();
  is_reading_ = true;
  stream_.async_read_some(
      tls_ ? asio::buffer(encrypted_.get(), chunk) : asio::buffer(input_.get() + end_, capacity_ - end_),
      [self = shared_from_this()](const boost::system::error_code& error, std::size_t bytes) {
        self->is_reading_ = false;
        if (self->is_closed_) return;
        if (!error)
          self->take_in(bytes);
        else if (error == asio::error::eof && self->kind_ == Descriptor::socket)
          self->take_end();
        else
          self->break_off();
      });
}

void Connection::make_room() {
  if (begin_ == end_ || is_silent_) begin_ = end_ = 0;
  if (capacity_ - end_ >= chunk) return;
  std::memmove(input_.get(), input_.get() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
}

void Connection::take_encrypted(std::size_t bytes) {
  if (!is_output_ended_) tls_->take_in({encrypted_.get(), bytes});
  const bool reads_on = is_output_ended_ || (!is_silent_ && decrypt());
  if (is_closed_) return;
  write();
  if (reads_on) read();
}

/// Decrypts and passes on the received bytes. Returns false when reading must stop.
bool Connection::decrypt() {
  for (;;) {
    make_room();
    const std::size_t size = tls_->read(input_.get() + end_, capacity_ - end_);
    end_ += size;
    if (size > 0 && !take_messages()) return false;
    if (size == 0) break;
  }
  if (tls_->has_failed()) {
    exchange_.count_ended();
    fail();
  } else if (tls_->has_ended()) {
    take_end();
  }
  return !tls_->has_failed() && !tls_->has_ended();
}

void Connection::take_in(std::size_t bytes) {
  exchange_.received(bytes);
  if (tls_) {
    take_encrypted(bytes);
    return;
  }
  end_ += bytes;
  if (is_output_ended_ || (!is_silent_ && take_messages())) read();
}

void Connection::take_end() {
  has_ended_ = true;
  if (!is_silent_ && begin_ < end_) exchange_.count_lost();
  end_input();
  if (is_output_ended_) fail();
}

/// Passes on all complete messages. Returns false when reading must stop.
bool Connection::take_messages() {
  while (begin_ < end_) {
    if (skipped_ != 0 && input_[begin_] == skipped_) ++begin_;
    skipped_ = 0;
    if (begin_ == end_) break;
    if (!exchange_.has_room(*client_)) {
      is_full_ = true;
      return false;
    }
    const std::size_t size = next_message();
    if (size == 0) break;
    if (size == Framing::invalid) {
      exchange_.count_ended();
      end_input();
      return false;
    }
    std::string_view message(input_.get() + begin_, size);
    if (framing_.size_of_first == line_size) {  // same bytes whether CR LF arrives in one piece or in two
      if (message.ends_with("\r\n"))
        message.remove_suffix(1);
      else
        skipped_ = message.back() == '\r' ? '\n' : message.back() == '\n' ? '\r' : '\0';
    }
    exchange_.message(*client_, message);
    begin_ += size;
    is_first_ = false;
  }
  return true;
}

/// Returns the size of the next message; 0 when it is not complete.
std::size_t Connection::next_message() {
  const std::string_view bytes(input_.get() + begin_, end_ - begin_);
  if (!framing_.size_of_first) return std::min(bytes.size(), framing_.longest);
  const std::size_t size = framing_.size_of_first(bytes, is_first_);
  if (size == Framing::invalid) return size;
  const bool is_complete = size > 0 && size <= bytes.size();
  if (is_complete && size <= framing_.longest) return size;
  if (!is_complete && bytes.size() < framing_.longest) return 0;
  return framing_.keeps_too_long ? framing_.longest : Framing::invalid;
}

void Connection::write() {
  if (is_writing_ || is_closed_) return;
  if (output_sent_ == output_.size()) {
    if (!take_output()) {
      if (is_ending_) end_output();
      return;
    }
  }
  is_writing_ = true;  // the handler writes, so that close() knows how much has gone out
  stream_.async_wait(asio::posix::stream_descriptor::wait_write,
                     [self = shared_from_this()](boost::system::error_code error) {
                       self->is_writing_ = false;
                       if (self->is_closed_) return;
                       const auto rest = asio::buffer(self->output_) + self->output_sent_;
                       if (!error) self->count_sent(self->stream_.write_some(rest, error));
                       if (error && error != asio::error::would_block)
                         self->break_off();
                       else
                         self->write();
                     });
}

/// Gets the next bytes to send, after all earlier ones are sent. Returns false when there are none.
bool Connection::take_output() {
  output_.clear();
  output_sent_ = 0;
  if (!tls_) return exchange_.take_output(*client_, output_);
  if (tls_->is_ready() && exchange_.take_output(*client_, plain_)) tls_->write(plain_);
  output_ = tls_->take_output();
  return !output_.empty();
}

/// Counts sent bytes. With TLS, the plain bytes count as sent when all their encrypted bytes are.
void Connection::count_sent(std::size_t bytes) {
  output_sent_ += bytes;
  if (!tls_) {
    exchange_.sent(*client_, bytes);
  } else if (output_sent_ == output_.size()) {
    exchange_.sent(*client_, plain_.size());
    plain_.clear();
  }
}

/// Ends the input: the client sends nothing more, or its input is ignored. Answers to earlier messages may follow.
void Connection::end_input() {
  if (is_silent_) return;
  is_silent_ = true;
  exchange_.disconnected(*client_);
}

/// Ends the output after all is sent. Further input is still read until the client closes, too. If the socket were
/// closed with unread bytes, TCP would discard the bytes on their way to the client.
void Connection::end_output() {
  if (is_output_ended_) return;
  if (tls_ && tls_->end()) {
    write();
    return;
  }
  is_output_ended_ = true;
  if (has_ended_ || kind_ == Descriptor::terminal) {
    fail();
    return;
  }
  ::shutdown(stream_.native_handle(), SHUT_WR);
  read();
}

/// Handles an error: a reset, or the end of a terminal.
void Connection::break_off() {
  if (!is_silent_ && (kind_ == Descriptor::socket || begin_ < end_)) exchange_.count_lost();
  fail();
}

void Connection::fail() {
  if (is_closed_) return;
  end_input();
  release();
  closed_(*this);
}

void Connection::close() {
  if (is_closed_) return;
  send_now();
  while (take_output()) send_now();
  if (kind_ == Descriptor::socket) {
    ::shutdown(stream_.native_handle(), SHUT_WR);
    while (::recv(stream_.native_handle(), input_.get(), capacity_, MSG_DONTWAIT) > 0) continue;
  }
  release();
}

/// Writes the bytes that fit into the buffers of the system, without waiting.
void Connection::send_now() {
  const char* const data = output_.data() + output_sent_;
  const std::size_t size = output_.size() - output_sent_;
  const ssize_t done = kind_ == Descriptor::socket
                           ? ::send(stream_.native_handle(), data, size, MSG_NOSIGNAL | MSG_DONTWAIT)
                           : ::write(stream_.native_handle(), data, size);
  count_sent(done > 0 ? std::size_t(done) : 0);
  plain_.clear();
  output_.clear();
  output_sent_ = 0;
}

void Connection::release() {
  is_closed_ = true;
  deadline_.cancel();
  exchange_.remove(*client_);
  boost::system::error_code ignored;
  stream_.close(ignored);
}

}  // namespace muro::stream
