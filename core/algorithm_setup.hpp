// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/schedule/rate.hpp"
#include "muro/connector.hpp"

namespace muro {

/// A parameter as the user gives it; a number is accepted for a real and for an integer parameter.
using ParameterInput =
    std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

/// One use of an algorithm, as a scenario or set-up code asks for it.
struct AlgorithmSetup {
  std::string name;        ///< "rovers.motion": used in messages and reports
  std::string use;         ///< "motion.point"
  Rate rate;               ///< on demand when zero
  std::int64_t phase = 0;  ///< ns
  std::map<std::string, ParameterInput> parameters;
  std::vector<Item> items;  ///< empty: the world
  /// The values that belong to one item of a world (Capability::world).
  struct ItemSetup {
    std::string name, place;  ///< as in AlgorithmSetup
    std::map<std::string, ParameterInput> parameters;
    std::map<std::string, std::string> parameter_places;
  };
  std::vector<ItemSetup> item_setups;  ///< one for each item; empty: all items use `parameters`
  std::string subsystem;               ///< "motion"; with the robot's name, it keys the random numbers
  std::string folder;                  ///< relative paths in parameters start here; "": the working directory
  bool is_optional = false;            ///< left out, with a warning, when it cannot be connected
  std::string place;                   ///< "file:line:column" of the scenario, put before messages; may be empty
  /// Places of parameters that are written elsewhere: in another file, or on the command line.
  std::map<std::string, std::string> parameter_places;
};

/// The beginning of a message about something at `place`, a place in a file.
inline std::string prefix_of(const std::string& place) { return place.empty() ? "" : place + ": "; }

}  // namespace muro
