// SPDX-License-Identifier: MIT
// A frame of bytes for each request and each reply; see plugins/controller/joints/README.md.
#include <cmath>
#include <cstring>

#include "plugins/controller/common/wire_protocol/frame.hpp"
#include "plugins/controller/common/wire_protocol/protocol.hpp"

namespace muro::wire {

namespace {

// Types of replies; types of requests are the numbers of Verb.
constexpr std::uint8_t ok_type = 0x80, info_type = 0x81, state_type = 0x82, report_type = 0x83, fault_type = 0x84,
                       time_type = 0x87;

/// The payload of a request, read from front to back.
class Payload {
 public:
  explicit Payload(std::string_view bytes) : rest_(bytes) {}
  bool empty() const { return rest_.empty(); }
  std::size_t size() const { return rest_.size(); }

  template <class T>
  T take() {
    if (rest_.size() < sizeof(T)) throw Fault{FaultCode::wrong_fields, "the payload is too short"};
    T number{};
    std::memcpy(&number, rest_.data(), sizeof number);
    rest_.remove_prefix(sizeof number);
    return number;
  }
  void require_end() const {
    if (!empty()) throw Fault{FaultCode::wrong_fields, "the payload is too long"};
  }

 private:
  std::string_view rest_;
};

std::uint32_t take_group(Payload& payload, std::size_t groups) {
  const auto group = payload.take<std::uint8_t>();
  if (group >= groups)
    throw Fault{FaultCode::unknown_group,
                "no group " + std::to_string(group) + "; there are " + std::to_string(groups) + ", from 0"};
  return group;
}

Quantity take_quantity(Payload& payload) {
  const auto quantity = payload.take<std::uint8_t>();
  if (quantity >= quantity_count)
    throw Fault{FaultCode::unknown_quantity, "no quantity " + std::to_string(quantity) + "; allowed are 0 to 5"};
  return Quantity(quantity);
}

/// Reads "[group [quantity]]" up to the end.
void take_place(Payload& payload, std::size_t groups, Request& out) {
  if ((out.names_group = !payload.empty())) out.group = take_group(payload, groups);
  if (!payload.empty()) out.quantity = take_quantity(payload);
  payload.require_end();
}

std::int64_t take_time(Payload& payload) {
  const auto time = payload.take<std::int64_t>();
  if (time < 0 || time > longest_duration)
    throw Fault{FaultCode::out_of_range, "a time must be from 0 to 1000000000000000000 ns"};
  return time;
}

template <class T>
void take_numbers(Payload& payload, std::vector<double>& out) {
  if (payload.size() % sizeof(T) != 0) throw Fault{FaultCode::wrong_fields, "the payload ends within a number"};
  while (!payload.empty()) {
    out.push_back(double(payload.take<T>()));
    if (!std::isfinite(out.back()))
      throw Fault{FaultCode::not_a_number, "number " + std::to_string(out.size() - 1) + " is not finite"};
  }
}

Verb verb_of(std::uint8_t type) {
  if (type < std::uint8_t(Verb::info) || type > std::uint8_t(Verb::time))
    throw Fault{FaultCode::unknown_request, "no request " + std::to_string(type) + "; allowed are 1 to 7"};
  return Verb(type);
}

void add_reply(std::string& out, std::uint8_t type, Tag tag, std::string_view payload) {
  add_frame(out, {type, tag.sequence, std::uint8_t(tag.is_wide ? 1 : 0), payload});
}

class BinaryProtocol final : public Protocol {
 public:
  stream::Framing framing() const override { return {.size_of_first = frame_size, .longest = 65536}; }
  std::size_t most_values() const override { return (longest_payload - state_header) / sizeof(double); }

  bool read(std::string_view bytes, std::span<const std::string> groups, Request& r) const override {
    const std::optional<Frame> frame = read_frame(bytes);
    if (!frame || frame->payload.size() > longest_request) return false;
    r.tag = {frame->sequence, frame->format == 1};
    if (frame->format > 1) throw Fault{FaultCode::wrong_fields, "the format of numbers must be 0 or 1"};
    r.verb = verb_of(frame->type);
    Payload payload(frame->payload);
    switch (r.verb) {
      case Verb::info:
      case Verb::get:
        take_place(payload, groups.size(), r);
        break;
      case Verb::set:
        r.group = take_group(payload, groups.size());
        r.quantity = take_quantity(payload);
        r.tag.is_wide ? take_numbers<double>(payload, r.values) : take_numbers<float>(payload, r.values);
        break;
      case Verb::stop:
        if ((r.names_group = !payload.empty())) r.group = take_group(payload, groups.size());
        payload.require_end();
        break;
      case Verb::wait:
        if (!payload.empty()) r.duration = take_time(payload);
        take_place(payload, groups.size(), r);
        break;
      case Verb::report:
        r.period = double(take_time(payload));
        take_place(payload, groups.size(), r);
        break;
      case Verb::time:
        payload.require_end();
        break;
    }
    return true;
  }

  void add_ok(std::string& out, Tag tag, std::int64_t time) const override { add_timed(out, ok_type, tag, time); }
  void add_time(std::string& out, Tag tag, std::int64_t time) const override { add_timed(out, time_type, tag, time); }
  void add_info(std::string& out, Tag tag, std::string_view text) const override {
    add_reply(out, info_type, tag, text);
  }
  void add_state(std::string& out, Tag tag, const State& s) const override { add_state_of(out, state_type, tag, s); }
  void add_report(std::string& out, Tag tag, const State& s, std::string_view) const override {
    add_state_of(out, report_type, tag, s);
  }
  void add_fault(std::string& out, Tag tag, std::int64_t time, const Fault& f) const override {
    std::string payload;
    add_bytes(payload, time);
    add_bytes(payload, std::uint8_t(f.code));
    add_reply(out, fault_type, tag, payload + f.text);
  }

 private:
  static constexpr std::size_t state_header = 12;

  static void add_timed(std::string& out, std::uint8_t type, Tag tag, std::int64_t time) {
    std::string payload;
    add_bytes(payload, time);
    add_reply(out, type, tag, payload);
  }
  static void add_state_of(std::string& out, std::uint8_t type, Tag tag, const State& s) {
    std::string payload;
    add_bytes(payload, s.time);
    add_bytes(payload, std::uint8_t(s.group));
    add_bytes(payload, std::uint8_t(s.quantity));
    add_bytes(payload, std::uint16_t(s.values.size()));
    for (const double v : s.values) tag.is_wide ? add_bytes(payload, v) : add_bytes(payload, float(v));
    add_reply(out, type, tag, payload);
  }
};

}  // namespace

const Protocol& binary_protocol() {
  static const BinaryProtocol protocol;
  return protocol;
}

const Protocol& protocol_of(std::string_view name) { return name == "binary" ? binary_protocol() : text_protocol(); }

}  // namespace muro::wire
