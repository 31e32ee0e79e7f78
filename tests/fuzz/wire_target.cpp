// SPDX-License-Identifier: MIT
// Bytes of clients of controller.joints and controller.sensors, in both protocols.
#include "plugins/controller/common/wire_protocol/frame.hpp"
#include "plugins/controller/common/wire_protocol/service_testing.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

/// A client whose bytes come one after the other, while time passes.
class Conversation {
 public:
  explicit Conversation(const wire::Protocol& protocol) : framing_(protocol.framing()), bench_(protocol) {}

  void say(std::string_view bytes) {
    while (!bytes.empty()) {
      const std::size_t size = framing_.size_of_first(bytes, is_first_);
      require(size <= bytes.size(), "a message is longer than what has come");
      if (size == 0) return;
      is_first_ = false;
      heard_ += bench_.ask(bytes.substr(0, size));
      if (bench_.messages % 4 == 0) heard_ += bench_.run();
      bytes.remove_prefix(size);
    }
  }
  /// Ends the conversation and returns all that was sent to the client.
  std::string end() {
    heard_ += bench_.run(8);
    bench_.service.disconnected(1);
    require(bench_.answers == bench_.messages, "a message is not through once");
    return heard_;
  }

 private:
  stream::Framing framing_;
  wire::Bench bench_;
  std::string heard_;
  bool is_first_ = true;
};

/// Returns whole frames made from the input, which has pieces "type, sequence, format, length, payload".
std::string as_frames(std::string_view bytes) {
  std::string frames;
  while (bytes.size() >= 4) {
    const auto at = [&](std::size_t i) { return std::uint8_t(bytes[i]); };
    wire::add_frame(frames, {at(0), at(1), at(2), bytes.substr(4, at(3))});
    bytes.remove_prefix(std::min(bytes.size(), std::size_t(4) + at(3)));
  }
  return frames;
}

}  // namespace

void read_as_lines(Bytes bytes) {
  Conversation conversation(wire::text_protocol());
  conversation.say(text_of(bytes));
  const std::string heard = conversation.end();
  require(heard.empty() || heard.back() == '\n', "a reply does not end");
  for (std::size_t begin = 0, end = 0; begin < heard.size(); begin = end + 1) {
    end = heard.find('\n', begin);
    for (const char c : heard.substr(begin, end - begin))
      require(std::uint8_t(c) >= ' ', "a reply has a control character");
    outcome(heard.substr(begin, end - begin));
  }
}

void read_as_frames(Bytes bytes) {
  const std::string raw = text_of(bytes);
  for (const std::string& said : {raw, as_frames(raw)}) {
    Conversation conversation(wire::binary_protocol());
    conversation.say(said);
    const std::string heard = conversation.end();
    for (std::string_view rest = heard; !rest.empty();) {
      const std::size_t size = wire::frame_size(rest, false);
      const auto reply = wire::read_frame(rest.substr(0, size));
      require(size > 0 && reply && reply->type >= 0x80, "a reply is no frame");
      outcome(std::to_string(reply->type) + (reply->type == 0x84 ? std::string(reply->payload.substr(9)) : ""));
      rest.remove_prefix(size);
    }
  }
}

}  // namespace muro::fuzz
