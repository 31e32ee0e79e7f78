// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/schedule/rate.hpp"
#include "muro/connector.hpp"

namespace muro {

/// A parameter as the user gives it; numbers are taken for real and integer parameters alike.
using ParameterInput =
    std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

/// One use of an algorithm, as a scenario or set-up code asks for it.
struct AlgorithmSetup {
  std::string name;        ///< "rovers.motion": used in messages and reports
  std::string use;         ///< "motion.point"
  Rate rate;               ///< on demand when zero
  std::int64_t phase = 0;  ///< ns
  std::map<std::string, ParameterInput> parameters;
  std::vector<Item> items;  ///< none: the world
  /// What one item of a world (Capability::world) has of its own.
  struct ItemSetup {
    std::string name, place;  ///< as those of the setup
    std::map<std::string, ParameterInput> parameters;
    std::map<std::string, std::string> parameter_places;
  };
  std::vector<ItemSetup> item_setups;  ///< one an item; none: all have `parameters`
  std::string subsystem;               ///< "motion": with the robot's name, keys the random numbers
  std::string folder;                  ///< relative paths in parameters start here; "": the working directory
  bool is_optional = false;            ///< where it cannot be connected it is left out, with a warning
  std::string place;                   ///< "file:line:column" of the scenario, put before messages; may be empty
  /// Of parameters that are written elsewhere: in another file, or on the command line.
  std::map<std::string, std::string> parameter_places;
};

/// What stands before a message about something at `place`, a place in a file.
inline std::string prefix_of(const std::string& place) { return place.empty() ? "" : place + ": "; }

}  // namespace muro
