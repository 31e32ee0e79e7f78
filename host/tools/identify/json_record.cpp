// SPDX-License-Identifier: MIT
// Recordings of Rhoban/bam.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/tools/identify/known_motors.hpp"
#include "host/tools/identify/record_text.hpp"

namespace muro::host {

namespace {

using nlohmann::json;

/// Returns where the elements of the array `entries` of the outermost object begin. The text was parsed before.
std::vector<TextPlace> places_of_entries(const std::string& text) {
  std::vector<TextPlace> places;
  std::string key, last;
  TextPlace at;
  int depth = 0;
  bool in_text = false, in_entries = false, first = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++at.line, at.column = 0;
    if (in_text) {
      if (c == '\\') {
        ++i, ++at.column;
      } else if (c == '"') {
        in_text = false, last = key;
      } else {
        key += c;
      }
    } else if (c == '"') {
      if (in_entries && depth == 2 && first) places.push_back(at), first = false;
      in_text = true, key.clear();
    } else if (c == '{' || c == '[') {
      if (in_entries && depth == 2 && first) places.push_back(at), first = false;
      ++depth;
      if (c == '[' && depth == 2 && last == "entries") in_entries = true;
    } else if (c == '}' || c == ']') {
      --depth;
      if (depth == 1) in_entries = false;
    } else if (c == ',') {
      if (in_entries && depth == 2) first = true;
    } else if (in_entries && depth == 2 && first && c > ' ') {
      places.push_back(at), first = false;
    }
    ++at.column;
  }
  return places;
}

double number_of(const json& object, const char* key, double otherwise, const std::string& name) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return otherwise;
  if (!found->is_number())
    throw SetupError(fmt::format("{}: `{}` is {}, which is no number", name, key, found->dump().substr(0, 60)));
  return found->get<double>();
}

/// One element of `entries`.
class EntryReader {
 public:
  EntryReader(const json& entry, const std::string& name, TextPlace place) : entry_(entry), name_(name), place_(place) {
    if (!entry.is_object()) throw record_error(name, place, "this entry is no object with `timestamp` and `position`");
  }
  bool has(const char* key) const { return entry_.contains(key) && !entry_[key].is_null(); }
  double number(const char* key) const {
    const auto found = entry_.find(key);
    if (found == entry_.end()) throw record_error(name_, place_, fmt::format("this entry has no `{}`", key));
    if (!found->is_number() || !std::isfinite(found->get<double>()) || std::abs(found->get<double>()) > 1e9)
      throw record_error(name_, place_,
                         fmt::format("`{}` of this entry is {}, which is no number that it can have", key,
                                     found->dump().substr(0, 60)));
    return found->get<double>();
  }
  bool truth(const char* key) const {
    const json& value = entry_[key];
    if (value.is_boolean()) return value.get<bool>();
    return number(key) != 0;
  }

 private:
  const json& entry_;
  const std::string& name_;
  TextPlace place_;
};

}  // namespace

MotorRecord parse_json_record(const std::string& text, const std::string& name, const RecordDefaults& defaults) {
  json document;
  try {
    document = json::parse(text);
  } catch (const json::parse_error& e) {
    std::string why = e.what();
    if (const std::size_t colon = why.rfind("; last read"); colon != std::string::npos) why.resize(colon);
    if (const std::size_t begin = why.find("syntax error"); begin != std::string::npos) why.erase(0, begin);
    throw record_error(name, place_in(text, e.byte == 0 ? 0 : e.byte - 1), why);
  } catch (const json::exception& e) {
    throw SetupError(name + ": " + e.what());
  }
  MotorRecord r;
  r.name = name;
  const auto entries = document.find("entries");
  if (entries == document.end() || !entries->is_array())
    throw SetupError(name + ": a record in JSON has an array `entries`, one object a sample");
  const auto word = [&](const char* key) {
    return document.contains(key) && document[key].is_string() ? document[key].get<std::string>() : std::string();
  };
  r.motor = word("motor");
  r.trajectory = word("trajectory");
  r.p_gain = number_of(document, "kp", 0, name);
  r.load = {.mass = number_of(document, "mass", 0, name),
            .length = number_of(document, "length", 0, name),
            .arm_mass = number_of(document, "arm_mass", 0, name)};
  r.duty_gain = number_of(document, "duty_gain", 0, name);
  r.duty_limit = number_of(document, "duty_limit", 0, name);
  const double supply = number_of(document, "vin", 0, name);
  const KnownMotor* const known = known_motor(r.motor);
  const double full_load = known ? known->full_load : 0;
  std::vector<TextPlace> places = places_of_entries(text);
  places.resize(entries->size());
  r.samples.reserve(entries->size());
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const EntryReader entry((*entries)[i], name, places[i]);
    RecordSample s;
    s.time = entry.number("timestamp");
    s.position = entry.number("position");
    s.goal = entry.number("goal_position");
    s.supply_voltage = entry.has("input_volts") ? entry.number("input_volts") : supply;
    s.torque_enable = !entry.has("torque_enable") || entry.truth("torque_enable");
    if (full_load > 0 && entry.has("load")) {
      const double counts = entry.number("load");
      s.duty = (counts > 32767 ? counts - 65536 : counts) / full_load;  // 16 bits without sign
      r.has_duty = true;
    }
    r.has_temperature = entry.has("temp") && (i == 0 || r.has_temperature);
    if (r.has_temperature) s.temperature = entry.number("temp");
    r.samples.push_back(s);
  }
  complete_record(r, defaults, std::move(places));
  return r;
}

}  // namespace muro::host
