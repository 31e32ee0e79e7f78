// SPDX-License-Identifier: MIT
// What the user enters for a property.
#pragma once

#include <string>
#include <vector>

#include "muro/ext/inspection.hpp"
#include "muro/ext/run_control.hpp"

namespace muro::view {

/// Asks the host for changes of state: it carries them out between steps, tells all that keep something of the state,
/// and records them. A pose or a velocity is changed by placing.
class Edits final : public RequestDone {
 public:
  void connect(RunControl& control) { control_ = &control; }
  /// Scalar `i` of a property of `object` is to be `value`.
  void enter(Inspection& simulation, ObjectId object, const LiveProperty& property, std::uint32_t i, double value);
  /// Why the last one was refused; empty where it was not.
  const std::string& problem() const { return problem_; }
  void forget_problem() { problem_.clear(); }

 private:
  void done(std::uint64_t ticket, std::string_view problem) noexcept override;
  void place(Inspection& simulation, ObjectId object, const LiveProperty& changed);

  RunControl* control_ = nullptr;
  std::string problem_;
};

}  // namespace muro::view
