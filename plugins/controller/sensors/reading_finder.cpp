// SPDX-License-Identifier: MIT
#include "reading_finder.hpp"

#include <algorithm>

#include "muro/algorithm.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/text/glob.hpp"
#include "plugins/common/text/quote.hpp"
#include "reading.hpp"

namespace muro::sensors {

namespace {

using Found = ReadingFinder::Found;

bool is_pattern(std::string_view text) { return text.find_first_of("*?") != text.npos; }

/// Those that match and are read; `skipped`: one that matches and is not, with the reason.
std::vector<Found> select(const std::vector<Found>& from, std::string_view pattern, std::string& skipped) {
  std::vector<Found> found;
  for (const Found& f : from) {
    if (!matches(pattern, f.first)) continue;
    std::string why = Reading::why_unreadable(f.second);
    if (why.empty() && is_pattern(pattern) && (f.second.is_constant || f.second.key->name.starts_with("state.")))
      why = "does not change, or only its owner understands it, and a pattern leaves it out; name it to read it";
    if (why.empty())
      found.push_back(f);
    else
      skipped = quote(f.first).append(1, ' ').append(why);
  }
  return found;
}

}  // namespace

ReadingFinder::ReadingFinder(const Connector& connector, const Item& item) : connector_(connector), item_(item) {
  for (std::uint32_t i = 0; i < connector.object_count(); ++i) {
    const ObjectId object{i};
    const bool is_own = item.robot && connector.robot_of(object) == std::int32_t(item.robot->number);
    if (!is_own && is_shadow(object)) continue;
    for (const FoundProperty& p : connector.properties(object)) {
      const std::string property = ":" + std::string(p.key->name);
      if (is_own) own_.emplace_back(local_name(object) + property, p);
      all_.emplace_back(std::string(connector.object_name(object)) + property, p);
    }
  }
}

std::string ReadingFinder::local_name(ObjectId object) const {
  return std::string(connector_.object_name(object).substr(item_.robot->name.size() + 1));
}

bool ReadingFinder::is_shadow(ObjectId object) const {
  const std::int32_t robot = connector_.robot_of(object);
  return robot >= 0 && connector_.constant(connector_.robots()[std::size_t(robot)]->base(), keys::shadow_of);
}

std::vector<Found> ReadingFinder::find_measured(std::string_view property) const {
  std::string skipped;
  std::vector<Found> found = select(own_, std::string("*:").append(property), skipped);
  for (Found& f : found) {
    const std::string measured = f.first + ".measured";
    const auto better = std::find_if(own_.begin(), own_.end(), [&](const Found& o) { return o.first == measured; });
    if (better != own_.end()) f = *better;
  }
  return found;
}

std::vector<Found> ReadingFinder::find(std::string_view member) const {
  std::string skipped;
  std::vector<Found> found;
  const bool names_object = member.find(':') != member.npos;
  if (!names_object && item_.robot) found = find_measured(member);
  if (names_object) found = select(own_, member, skipped);
  if (found.empty() && names_object) found = select(all_, member, skipped);
  if (!found.empty()) return found;
  if (!skipped.empty()) throw Error(quote(member) + " gives nothing to read: " + skipped);
  std::vector<std::string> known;
  for (const Found& f : own_) known.push_back(names_object ? f.first : std::string(f.second.key->name));
  if (names_object)
    for (const Found& f : all_) known.push_back(f.first);
  throw Error("no property matches " + quote(member) + did_you_mean(member, known) +
              "; write \"object:property\", such as \"laser:ranges\", or \"property\"; `muro describe` lists all");
}

}  // namespace muro::sensors
