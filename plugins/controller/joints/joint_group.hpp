// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "axis.hpp"

namespace muro::joints {

/// Axes that are read and set together.
class JointGroup final : public wire::Group {
 public:
  JointGroup(std::string name, std::vector<Axis*> axes) : Group(std::move(name)), axes_(std::move(axes)) {}

  std::size_t size() const override { return axes_.size(); }
  void describe(Quantity quantity, std::string& out) const override;
  void read(Quantity quantity, std::vector<double>& out) const override;
  void set(Quantity quantity, std::span<const double> values, wire::Origin origin) override;
  void stop() override;

 private:
  std::vector<Axis*> axes_;
};

}  // namespace muro::joints
