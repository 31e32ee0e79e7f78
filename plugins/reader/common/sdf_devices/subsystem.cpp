// SPDX-License-Identifier: MIT
#include "subsystem.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "muro/vocabulary/model.hpp"
#include "plugins/common/model_file/message.hpp"

namespace muro::sdf_devices {

namespace {

bool is_plain(std::string_view text) {
  constexpr std::array<std::string_view, 10> other = {"y",  "n",    "on",    "off",  "yes",
                                                      "no", "true", "false", "null", "none"};
  const auto is_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; };
  std::string lower(text);
  for (char& c : lower) c = char(std::tolower(static_cast<unsigned char>(c)));
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), is_name) && std::find(other.begin(), other.end(), lower) == other.end();
}

/// Returns a YAML scalar, quoted if necessary.
std::string scalar(std::string_view text) {
  if (is_plain(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + "\"";
}

template <class Values, class TextOf>
std::string list_of(const Values& values, TextOf text_of) {
  std::string list = "[";
  for (const auto& value : values) list += (list.size() > 1 ? ", " : "") + text_of(value);
  return list + "]";
}

}  // namespace

Subsystem::Subsystem(std::string name, std::string_view use, model_file::FileLocation location)
    : name_(std::move(name)), use_(use), location_(std::move(location)) {}

void Subsystem::add_raw(std::string_view key, std::string_view value) {
  body_ += (body_.empty() ? "" : ", ") + std::string(key) + ": " + std::string(value);
}

void Subsystem::add(std::string_view key, double value) { add_raw(key, model_file::shortest(value)); }

void Subsystem::add(std::string_view key, std::string_view value) { add_raw(key, scalar(value)); }

void Subsystem::add(std::string_view key, const std::vector<double>& values) {
  add_raw(key, list_of(values, [](double v) { return model_file::shortest(v); }));
}

void Subsystem::add(std::string_view key, const std::vector<std::string>& values) {
  add_raw(key, list_of(values, [](const std::string& v) { return scalar(v); }));
}

std::string Subsystem::text() const {
  std::string all;
  if (!use_.empty()) all += "use: " + scalar(use_);
  if (!on_.empty()) all += ", on: " + scalar(on_);
  if (!body_.empty()) all += (all.empty() ? "" : ", ") + body_;
  return scalar(name_) + ": {" + all + "}";
}

void Device::place(const std::string& prefix, const std::string& part, PartNames& names) {
  std::map<std::string, std::string> sensors;  // new names by old names
  for (Subsystem& s : subsystems) {
    const auto sensor = sensors.find(s.mounted_on());
    s.mount_on(sensor != sensors.end() ? sensor->second : part);
    const std::string name = names.unique(prefix + s.name());
    sensors.emplace(s.name(), name);
    s.rename(name);
  }
}

void Device::tell(model_file::Problems& problems) const {
  if (subsystems.empty()) return;
  std::string texts;
  for (const Subsystem& s : subsystems) texts += (texts.empty() ? "`" : ", `") + s.text() + "`";
  problems.note(location, owner + " becomes " + texts + "; the scenario goes before, and `" +
                              subsystems.front().name() + ": off` leaves it out" +
                              (unused.empty() ? "" : ". Not used: " + unused));
}

void give(const std::vector<Subsystem>& subsystems, RobotBuilder& builder) {
  std::vector<TextId> texts;
  std::vector<std::int32_t> places;
  for (const Subsystem& s : subsystems) {
    texts.push_back(builder.intern(s.text()));
    const bool is_here = s.location().file.empty();
    places.insert(places.end(), {is_here ? s.location().line : 0, is_here ? s.location().column : 0});
  }
  if (texts.empty()) return;
  builder.set_array<TextId>(keys::model_subsystems, texts);
  builder.set_array<std::int32_t>(keys::model_subsystem_places, places);
}

}  // namespace muro::sdf_devices
