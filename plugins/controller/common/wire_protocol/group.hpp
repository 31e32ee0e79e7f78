// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plugins/controller/common/wire_protocol/request.hpp"

namespace muro::wire {

/// Who sets something, and when.
struct Origin {
  std::uint32_t client = 0;
  std::int64_t time = 0;  ///< ns
};

/// Numbers that clients read, and set, together. All throw Fault where the group is not read or set in this way. [step]
class Group {
 public:
  explicit Group(std::string name) : name_(std::move(name)) {}
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;
  virtual ~Group() = default;

  const std::string& name() const { return name_; }
  virtual std::size_t size() const = 0;  ///< numbers; known from start() on
  /// Adds what `info` says of the group, in fields behind its name, each after a blank.
  virtual void describe(Quantity quantity, std::string& out) const = 0;
  /// Fills in the numbers as they are now.
  virtual void read(Quantity quantity, std::vector<double>& out) const = 0;
  /// Sets all of them, or throws and sets none. They are finite.
  virtual void set(Quantity quantity, std::span<const double> values, Origin origin) = 0;
  /// Takes back what was set.
  virtual void stop() = 0;

 private:
  std::string name_;
};

}  // namespace muro::wire
