// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace muro::wire {

/// A group as a scenario writes it: "arm=shoulder,elbow".
struct GroupText {
  std::string name;
  std::vector<std::string> members;  ///< the names as given
};

/// Whether the text consists of letters, digits, `_`, `-` and `.`, at most 64 of them.
bool is_name(std::string_view text);
inline constexpr char name_rule[] = "letters, digits, `_`, `-` and `.`, at most 64 of them";

/// Reads the parameter `groups`; all names are different. Throws muro::Error. [setup]
std::vector<GroupText> read_groups(std::span<const std::string_view> texts);

}  // namespace muro::wire
