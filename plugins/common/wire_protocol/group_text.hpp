// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace muro::wire {

/// What a scenario says about a group: "arm=shoulder,elbow".
struct GroupText {
  std::string name;
  std::vector<std::string> members;  ///< as given
};

/// Reads the parameter `groups`; names differ. Throws muro::Error. [setup]
std::vector<GroupText> read_groups(std::span<const std::string_view> texts);

}  // namespace muro::wire
