// SPDX-License-Identifier: MIT
#include "plugins/controller/common/wire_protocol/group_text.hpp"

#include <algorithm>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::wire {

namespace {

constexpr std::size_t most_groups = 255;  // the place of a group is one byte in the binary protocol
constexpr std::size_t longest_name = 64;

GroupText read_group(std::string_view text) {
  std::string context = "`groups`: " + quote(text);
  const std::size_t equals = text.find('=');
  if (equals == text.npos) throw Error(context + " must be \"name=member,member,...\", such as \"arm=shoulder,elbow\"");
  GroupText group{std::string(text.substr(0, equals)), {}};
  if (!is_name(group.name)) throw Error(context.append(" must begin with a name of ") + name_rule);
  for (std::string_view rest = text.substr(equals + 1);;) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string_view member = rest.substr(0, comma);
    while (!member.empty() && member.front() == ' ') member.remove_prefix(1);
    while (!member.empty() && member.back() == ' ') member.remove_suffix(1);
    if (member.empty()) throw Error(context + " has an empty name behind `=` or `,`");
    group.members.emplace_back(member);
    if (comma == rest.size()) return group;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace

bool is_name(std::string_view text) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  return !text.empty() && text.size() <= longest_name && std::all_of(text.begin(), text.end(), fits);
}

std::vector<GroupText> read_groups(std::span<const std::string_view> texts) {
  std::vector<GroupText> groups;
  for (const std::string_view text : texts) {
    GroupText group = read_group(text);
    for (const GroupText& other : groups)
      if (other.name == group.name) throw Error("`groups`: two groups have the name " + quote(group.name));
    groups.push_back(std::move(group));
  }
  if (groups.size() > most_groups)
    throw Error("`groups` has " + std::to_string(groups.size()) + " groups; allowed are " +
                std::to_string(most_groups));
  return groups;
}

}  // namespace muro::wire
