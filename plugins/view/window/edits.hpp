// SPDX-License-Identifier: MIT
// Values that the user enters for properties.
#pragma once

#include <string>
#include <vector>

#include "muro/ext/inspection.hpp"
#include "muro/ext/run_control.hpp"

namespace muro::view {

/// Asks the host for changes of state. The host makes them between steps, informs all parts that keep something of the
/// state, and records the changes. A pose or a velocity is changed by placing.
class Edits final : public RequestDone {
 public:
  void connect(RunControl& control) { control_ = &control; }
  /// Requests `value` for scalar `i` of a property of `object`.
  void enter(Inspection& simulation, ObjectId object, const LiveProperty& property, std::uint32_t i, double value);
  /// Returns why the last request was refused; empty when it was not.
  const std::string& problem() const { return problem_; }
  void forget_problem() { problem_.clear(); }

 private:
  void done(std::uint64_t ticket, std::string_view problem) noexcept override;
  void place(Inspection& simulation, ObjectId object, const LiveProperty& changed);

  RunControl* control_ = nullptr;
  std::string problem_;
};

}  // namespace muro::view
