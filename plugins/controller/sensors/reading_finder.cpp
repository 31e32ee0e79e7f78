// SPDX-License-Identifier: MIT
#include "reading_finder.hpp"

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "plugins/common/text/glob.hpp"
#include "plugins/common/text/quote.hpp"
#include "reading.hpp"

namespace muro::sensors {

namespace {

using Found = ReadingFinder::Found;

bool is_pattern(std::string_view text) { return text.find_first_of("*?") != text.npos; }

/// Returns readable properties that match. `skipped`: a matching property that is not read, with the reason.
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

ReadingFinder::ReadingFinder(const Connector& connector, const Item& item, const RobotObjects& of_robots)
    : connector_(connector), search_(connector, item, of_robots) {
  for (const ObjectId object : search_.own_objects())
    for (const FoundProperty& p : connector.properties(object))
      own_.emplace_back(search_.local_name(object) + ":" + std::string(p.key->name), p);
}

/// Returns the properties of all objects, without those of other robots' shadows.
std::vector<Found> ReadingFinder::all() const {
  std::vector<Found> found;
  for (std::uint32_t i = 0; i < connector_.object_count(); ++i) {
    const ObjectId object{i};
    if (!search_.is_own(object) && search_.is_shadow(object)) continue;
    for (const FoundProperty& p : connector_.properties(object))
      found.emplace_back(std::string(connector_.object_name(object)) + ":" + std::string(p.key->name), p);
  }
  return found;
}

std::vector<Found> ReadingFinder::find_measured(std::string_view property) const {
  std::string skipped;
  std::vector<Found> found = select(own_, std::string("*:").append(property), skipped);
  for (auto& [name, p] : found)
    if (const auto measured = search_.measured(p)) name += ".measured", p = *measured;
  return found;
}

std::vector<Found> ReadingFinder::find(std::string_view member) const {
  std::string skipped;
  std::vector<Found> found;
  const bool names_object = member.find(':') != member.npos;
  if (!names_object) found = find_measured(member);
  if (names_object) found = select(own_, member, skipped);
  if (found.empty() && names_object) found = select(all(), member, skipped);
  if (!found.empty()) return found;
  if (!skipped.empty()) throw Error(quote(member) + " gives nothing to read: " + skipped);
  std::vector<std::string> known;
  for (const Found& f : own_) known.push_back(names_object ? f.first : std::string(f.second.key->name));
  if (names_object)
    for (const Found& f : all()) known.push_back(f.first);
  throw Error("no property matches " + quote(member) + did_you_mean(member, known) +
              "; write \"object:property\", such as \"laser:ranges\", or \"property\"; `muro describe` lists all");
}

}  // namespace muro::sensors
