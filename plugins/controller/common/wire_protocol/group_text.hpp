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

/// Whether it is made of letters, digits, `_`, `-` and `.`, at most 64 of them.
bool is_name(std::string_view text);
inline constexpr char name_rule[] = "letters, digits, `_`, `-` and `.`, at most 64 of them";

/// Reads the parameter `groups`; names differ. Throws muro::Error. [setup]
std::vector<GroupText> read_groups(std::span<const std::string_view> texts);

}  // namespace muro::wire
