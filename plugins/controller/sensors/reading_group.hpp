// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "plugins/controller/common/wire_protocol/group.hpp"
#include "reading.hpp"

namespace muro::sensors {

/// Readings that clients get together.
class ReadingGroup final : public wire::Group {
 public:
  ReadingGroup(std::string name, std::vector<Reading> readings)
      : Group(std::move(name)), readings_(std::move(readings)) {}

  std::size_t size() const override;
  void describe(wire::Quantity quantity, std::string& out) const override;
  void read(wire::Quantity quantity, std::vector<double>& out) const override;
  void set(wire::Quantity quantity, std::span<const double> values, wire::Origin origin) override;
  void stop() override;

 private:
  std::vector<Reading> readings_;
};

}  // namespace muro::sensors
