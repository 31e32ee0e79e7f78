// SPDX-License-Identifier: MIT
#include "control_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::control {

namespace {

std::string text_or_none(const char* text) { return text ? text : ""; }

/// Returns the shortest text that reads back as the same number.
std::string shortest(double number) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number);
  return {text, end.ptr};
}

/// Returns the description of a tunable: "speed (m/s, 0.1 to 2, default 0.7)".
std::string listed(const ControlTable::Tunable& t) {
  std::string text = t.name + " (" + (t.unit.empty() ? "" : t.unit + ", ");
  if (t.is_bounded()) text += shortest(t.min) + " to " + shortest(t.max) + ", ";
  return text + "default " + shortest(t.default_value) + ")";
}

/// Reads the "name=number" texts of a scenario, by index in `entries`; missing ones get the entry's member `initial`.
/// `parameter`: its name for messages; `what`: kind of the entries, such as "tunable".
template <class Entry>
std::vector<double> read_numbers(std::string_view parameter, std::string_view what,
                                 std::span<const std::string_view> texts, const std::vector<Entry>& entries,
                                 double Entry::*initial, std::string_view library) {
  std::vector<std::string> names;
  std::vector<double> numbers;
  for (const Entry& e : entries) names.push_back(e.name), numbers.push_back(e.*initial);
  std::vector<bool> given(names.size());
  for (const std::string_view text : texts) {
    const std::string context = quote(parameter) + ": " + quote(text);
    const std::size_t equals = text.find('=');
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto read = equals == std::string_view::npos ? std::from_chars_result{nullptr, std::errc::invalid_argument}
                                                       : std::from_chars(text.data() + equals + 1, end, number);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(number))
      throw Error(context + " must be \"name=number\"");
    const std::string name(text.substr(0, equals));
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      std::string all;
      for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
      throw Error(context + ": library " + quote(library) + " has no " + std::string(what) + " " + quote(name) +
                  did_you_mean(name, names) + "; it has: " + (all.empty() ? "none" : all));
    }
    const auto place = std::size_t(found - names.begin());
    if (given[place]) throw Error(context + " sets " + quote(name) + " a second time");
    given[place] = true;
    numbers[place] = number;
  }
  return numbers;
}

}  // namespace

muro_controller_table complete(const muro_controller_table& table) {
  muro_controller_table all{};
  std::memcpy(&all, &table, std::min<std::size_t>(table.table_size, sizeof all));
  return all;
}

void ControlTable::add_port(std::vector<muro_port>& to, std::string_view port, const char* unit, std::uint32_t size,
                            std::uint32_t flags) {
  const char* const kept_unit = unit ? texts.emplace_back(unit).c_str() : nullptr;
  to.push_back({texts.emplace_back(port).c_str(), kept_unit, size, flags});
}

ControlTable describe(const muro_controller_table& given) {
  const muro_controller_table table = complete(given);
  ControlTable all;
  all.name = table.name;
  all.version = text_or_none(table.version);
  for (const muro_port& p : std::span(table.inputs, table.input_count))
    all.add_port(all.inputs, p.name, p.unit, p.size, p.flags);
  for (const muro_port& p : std::span(table.outputs, table.output_count))
    all.add_port(all.outputs, p.name, p.unit, p.size, p.flags);
  all.has_instances = table.instantiate != nullptr;
  all.can_save = table.save != nullptr;
  all.state_size = all.has_instances ? table.save_size : table.state_size;
  for (const muro_tunable& t : std::span(table.tunables, table.tunable_count))
    all.tunables.push_back({t.name, text_or_none(t.unit), text_or_none(t.doc), t.default_value, t.min, t.max});
  for (const muro_task& t : std::span(table.tasks, table.task_count)) all.tasks.push_back({t.name, t.rate});
  return all;
}

std::vector<double> read_tunables(std::span<const std::string_view> texts, const ControlTable& table) {
  using Tunable = ControlTable::Tunable;
  std::vector<double> values =
      read_numbers("tunables", "tunable", texts, table.tunables, &Tunable::default_value, table.name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Tunable& t = table.tunables[i];
    if (t.is_bounded() && !(values[i] >= t.min && values[i] <= t.max))
      throw Error("`tunables`: " + quote(t.name) + " of " + quote(table.name) + " is " + shortest(values[i]) +
                  "; it has: " + listed(t));
  }
  return values;
}

std::vector<double> read_rates(std::span<const std::string_view> texts, const ControlTable& table) {
  std::vector<double> rates = read_numbers("rates", "task", texts, table.tasks, &ControlTable::Task::rate, table.name);
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (!(rates[i] > 0))
      throw Error("`rates`: task " + quote(table.tasks[i].name) + " of " + quote(table.name) + " is to run at " +
                  shortest(rates[i]) + " Hz; rates are above 0");
  return rates;
}

std::string shown(const ControlTable& table, std::span<const double> values) {
  std::string all;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ControlTable::Tunable& t = table.tunables[i];
    all += (all.empty() ? "" : ", ") + t.name + "=" + shortest(values[i]) + (t.unit.empty() ? "" : " " + t.unit);
  }
  return all;
}

}  // namespace muro::control
