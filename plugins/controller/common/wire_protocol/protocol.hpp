// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "plugins/controller/common/stream/stream.hpp"
#include "plugins/controller/common/wire_protocol/fault.hpp"
#include "plugins/controller/common/wire_protocol/request.hpp"

namespace muro::wire {

/// Numbers of a group at one instant.
struct State {
  std::int64_t time = 0;  ///< ns
  std::uint32_t group = 0;
  Quantity quantity = Quantity::standard;
  std::span<const double> values;
};

/// Converts requests and replies from and to bytes. Has no state. [step]
class Protocol {
 public:
  virtual ~Protocol() = default;

  virtual stream::Framing framing() const = 0;
  /// Returns the largest number of values that a reply can hold.
  virtual std::size_t most_values() const = 0;
  /// Reads one message. Returns false when it is no request: it gets no reply. Throws Fault after request.tag was read.
  virtual bool read(std::string_view bytes, std::span<const std::string> groups, Request& request) const = 0;

  // Each of these functions adds one reply.
  virtual void add_ok(std::string& out, Tag tag, std::int64_t time) const = 0;
  virtual void add_time(std::string& out, Tag tag, std::int64_t time) const = 0;
  virtual void add_info(std::string& out, Tag tag, std::string_view text) const = 0;
  virtual void add_state(std::string& out, Tag tag, const State& state) const = 0;
  /// Adds a state that belongs to a running report, not to a single request.
  virtual void add_report(std::string& out, Tag tag, const State& state, std::string_view group) const = 0;
  virtual void add_fault(std::string& out, Tag tag, std::int64_t time, const Fault& fault) const = 0;
};

// These objects live as long as the program.
const Protocol& text_protocol();
const Protocol& binary_protocol();
/// Returns the protocol of a name, "text" or "binary".
const Protocol& protocol_of(std::string_view name);
inline constexpr std::string_view protocol_names[] = {"text", "binary"};

}  // namespace muro::wire
