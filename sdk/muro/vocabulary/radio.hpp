// SPDX-License-Identifier: MIT
// Properties of radios: on the radio's object. Control code writes messages to send and reads received messages.
#pragma once

#include <array>

#include "muro/key.hpp"

namespace muro::radio {

/// Largest number of bytes that a message carries. Of a longer message, only the first bytes are carried.
inline constexpr std::uint32_t max_bytes = 256;
/// Receiver of a message to all robots that hear it.
inline constexpr std::int64_t broadcast = -1;

struct Payload {
  std::uint8_t bytes[max_bytes] = {};
};

/// A received message.
struct Header {
  double from = -1;     ///< number of the robot that has sent it
  double number = 0;    ///< number of the message: counts the messages of its sender
  double sent = 0;      ///< s: time at which the sender's radio got it from control code
  double received = 0;  ///< s: time at which its last bit arrived
  double rssi = 0;      ///< dBm: received power
  double size = 0;      ///< bytes
  double first = 0;     ///< number of its first byte in radio.received.bytes
};
inline constexpr std::string_view header_labels[] = {"from", "number", "sent", "received", "rssi", "size", "first"};

/// Numbers of messages so far. The receiver counts lost messages; the sender counts those lost by queue, access and
/// overrun.
struct Counters {
  std::uint64_t sent = 0;            ///< transmission has ended
  std::uint64_t received = 0;        ///< by this radio
  std::uint64_t lost_signal = 0;     ///< the signal was too weak
  std::uint64_t lost_error = 0;      ///< a bit was wrong, by noise alone
  std::uint64_t lost_collision = 0;  ///< lost to other transmissions, or this radio was sending
  std::uint64_t lost_queue = 0;      ///< own messages: the queue was full
  std::uint64_t lost_access = 0;     ///< own messages: the medium was never free
  std::uint64_t lost_overrun = 0;    ///< own messages: control code wrote the next one before the radio ran
};
inline constexpr std::string_view counter_labels[] = {"sent",           "received",   "lost_signal", "lost_error",
                                                      "lost_collision", "lost_queue", "lost_access", "lost_overrun"};

namespace detail {
/// Names of the bytes: "b0" to "b255".
struct ByteNames {
  char text[max_bytes][4] = {};
  std::uint8_t length[max_bytes] = {};
  constexpr ByteNames() {
    for (std::uint32_t i = 0; i < max_bytes; ++i) {
      char* to = text[i];
      *to++ = 'b';
      if (i >= 100) *to++ = char('0' + i / 100);
      if (i >= 10) *to++ = char('0' + i / 10 % 10);
      *to++ = char('0' + i % 10);
      length[i] = std::uint8_t(to - text[i]);
    }
  }
};
inline constexpr ByteNames byte_names;
constexpr std::array<std::string_view, max_bytes> views_of_byte_names() {
  std::array<std::string_view, max_bytes> views;
  for (std::uint32_t i = 0; i < max_bytes; ++i) views[i] = {byte_names.text[i], byte_names.length[i]};
  return views;
}
}  // namespace detail
inline constexpr std::array<std::string_view, max_bytes> byte_labels = detail::views_of_byte_names();

}  // namespace muro::radio

namespace muro {
MURO_VALUE_TYPE(radio::Payload, "muro.RadioPayload", u8, radio::byte_labels);
MURO_VALUE_TYPE(radio::Header, "muro.RadioHeader", f64, radio::header_labels);
MURO_VALUE_TYPE(radio::Counters, "muro.RadioCounters", u64, radio::counter_labels);
}  // namespace muro

namespace muro::keys {

// Message to send: write bytes, size and receiver, then a new number.
inline constexpr Key<radio::Payload> radio_send_bytes{"radio.send.bytes", "1", "of the message to send", Role::command};
inline constexpr Key<std::uint32_t> radio_send_size{"radio.send.size", "1", "bytes of the message to send",
                                                    Role::command};
inline constexpr Key<std::int64_t> radio_send_receiver{
    "radio.send.receiver", "1", "number of the robot that the message is for; -1: all that hear it", Role::command};
inline constexpr Key<std::int64_t> radio_send_number{
    "radio.send.number", "1", "of the message to send, counted up by its writer: another number is another message",
    Role::command};

// Received messages.
inline constexpr Key<radio::Header> radio_received{"radio.received", "1, s, dBm", "list: the messages that have come"};
inline constexpr Key<std::uint8_t> radio_received_bytes{"radio.received.bytes", "1",
                                                        "list: the bytes of these messages, one after the other"};
inline constexpr Key<double> radio_keep{"radio.keep", "s", "how long a message stays in radio.received, a constant"};
inline constexpr Key<radio::Header> radio_last{"radio.last", "1, s, dBm",
                                               "the last message that has come; from -1: none yet"};
inline constexpr Key<radio::Payload> radio_last_bytes{"radio.last.bytes", "1",
                                                      "bytes of the last message that has come"};
inline constexpr Key<radio::Counters> radio_counters{"radio.counters", "1",
                                                     "messages sent, received and lost so far, by cause"};

}  // namespace muro::keys
