// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

#include "host/scenario/node.hpp"

namespace muro::host {

/// Collects the mistakes of a scenario, so that all of them can be reported together; each problem once. Of very many
/// problems only the first ones are reported, with the total number.
class Problems {
 public:
  void add(const Location& at, const std::string& text) { add(at.text() + ": " + text); }
  /// `line` is shown as one line, whatever it contains.
  void add(std::string line);
  /// Runs `work`; lines of its exception become problems, each after `prefix`. Returns whether there was no exception.
  bool collect(const std::string& prefix, const std::function<void()>& work);
  /// Throws SetupError if there are any.
  void check() const;

 private:
  static constexpr std::size_t most_shown = 200;
  std::vector<std::string> lines_;         ///< those that are shown
  std::unordered_set<std::string> known_;  ///< all
};

/// Checks that a name can be part of "robot/object:property" and of a file name: not empty, at most 255 bytes, no `/`,
/// `:`, control characters or white space. `what` is named in the message: "a robot".
bool check_name(const std::string& name, const Location& at, const std::string& what, Problems& problems);

/// A mistake that may turn out to be none: the model may have a subsystem of this name.
struct UnknownSubsystem {
  std::string name;
  Location location;
  std::string problem;
};

using TakeUnknown = std::function<void(UnknownSubsystem)>;

/// Returns each `off` in `map` that check_switched_off would refuse.
std::vector<UnknownSubsystem> unknown_switched_off(const Node& map, const std::vector<std::string>& names,
                                                   const std::string& what);

/// Checks each `off` in `map`: it must switch off one of `names`, or replace an earlier value (as an include, a variant
/// or an override does). `what` names the map in the message.
void check_switched_off(const Node& map, const std::vector<std::string>& names, const std::string& what,
                        Problems& problems);

}  // namespace muro::host
