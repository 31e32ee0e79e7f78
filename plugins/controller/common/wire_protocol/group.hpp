// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plugins/controller/common/wire_protocol/request.hpp"

namespace muro::wire {

/// The client that sets numbers, and the instant.
struct Origin {
  std::uint32_t client = 0;
  std::int64_t time = 0;  ///< ns
};

/// Numbers that clients read and set together. All functions throw Fault when the group does not allow the call. [step]
class Group {
 public:
  explicit Group(std::string name) : name_(std::move(name)) {}
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;
  virtual ~Group() = default;

  const std::string& name() const { return name_; }
  virtual std::size_t size() const = 0;  ///< number of values; known from start() on
  /// Adds the group's fields of an `info` reply, without the name, each after a blank.
  virtual void describe(Quantity quantity, std::string& out) const = 0;
  /// Fills in the present values.
  virtual void read(Quantity quantity, std::vector<double>& out) const = 0;
  /// Sets all values, or throws and sets none. The values are finite.
  virtual void set(Quantity quantity, std::span<const double> values, Origin origin) = 0;
  /// Withdraws the values that were set.
  virtual void stop() = 0;

 private:
  std::string name_;
};

}  // namespace muro::wire
