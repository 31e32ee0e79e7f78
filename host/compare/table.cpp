// SPDX-License-Identifier: MIT
#include "host/compare/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/compare/chart.hpp"

namespace muro::host {

namespace {

/// Three digits, and no exponent where none is needed.
std::string shown(double x) { return x >= 1000 && x < 1e9 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x); }

std::string plural(std::size_t n, const std::string& what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string names_of(const std::vector<Variety>& varieties) {
  std::string all;
  for (const Variety& v : varieties) all += (all.empty() ? "" : " + ") + v.name;
  return all;
}

using Row = std::vector<std::string>;

/// Columns flush right, but the first.
std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> width;
  for (const Row& r : rows)
    if (r.size() > 1)
      for (std::size_t i = 0; i < r.size(); ++i) {
        if (i == width.size()) width.push_back(0);
        width[i] = std::max(width[i], r[i].size());
      }
  std::string out;
  for (const Row& r : rows) {
    std::string line;
    for (std::size_t i = 0; i < r.size(); ++i)
      line += i == 0 ? (r.size() > 1 ? fmt::format("{:<{}}", r[i], width[i]) : r[i])
                     : fmt::format("  {:>{}}", r[i], width[i]);
    out += line + "\n";
  }
  return out;
}

Row row_of(const Compared& all, const Level& level) {
  const Level& reference = all.levels[all.reference];
  const std::optional<Deviation> d = deviation_of(level, reference);
  const auto ms = [](double seconds) { return shown(1e3 * seconds); };
  Row row = {level.label + (&level == &reference ? " *" : ""), ms(level.cost.whole), ms(level.cost.varied),
             ms(level.cost.contact), shown(std::floor(real_time_robots(all.comparison, level)))};
  for (const double x : {d ? d->position_rms : 0, d ? d->position_largest : 0, d ? d->heading_largest : 0})
    row.push_back(d ? shown(x) : "-");
  row.push_back(level.first_contact ? fmt::format("{:.2f}", *level.first_contact) : "-");
  row.push_back(level.first_contact && reference.first_contact
                    ? fmt::format("{:+.2f}", *level.first_contact - *reference.first_contact)
                    : "-");
  row.push_back(level.contacts ? std::to_string(*level.contacts) : "-");
  row.push_back(fmt::format("{:.2f}", level.track->distance()));
  return row;
}

std::string indented(const std::string& text) {
  std::string out = "  ";
  for (const char c : text) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return out;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : c == '\n' ? " " : std::string(1, c);
  return out + "\"";
}

std::string head(const Compared& all) {
  const Comparison& c = all.comparison;
  return fmt::format("{}: {}, {:g} s, seed {}; reference *: {}\n", c.scenario.name, plural(c.robots.size(), "robot"),
                     c.duration, c.seed.value_or(c.scenario.seed), all.levels[all.reference].label);
}

}  // namespace

double real_time_robots(const Comparison& comparison, const Level& level) {
  return level.cost.whole > 0 ? double(comparison.robots.size()) / level.cost.whole : 0;
}

std::optional<Deviation> deviation_of(const Level& level, const Level& reference) {
  if (!level.failure.empty() || !reference.failure.empty()) return std::nullopt;
  return deviation_of(*level.track, *reference.track);
}

std::string table(const Compared& all) {
  std::vector<Row> rows = {
      {"", "cost, ms/s", "", "", "robots in", "position, m", "", "heading", "first contact", "", "contacts", "way"},
      {names_of(all.comparison.varieties), "whole", "varied", "contact", "real time", "rms", "largest", "rad", "s",
       "later", "begun", "m"}};
  std::string below;
  for (const Level& l : all.levels) {
    if (l.failure.empty())
      rows.push_back(row_of(all, l));
    else
      below += l.label + " did not run:\n" + indented(l.failure) + "\n";
    if (!l.repeatable) below += l.label + " did not end twice in the same state: its figures hold for one run\n";
    if (!l.blind.empty()) below += l.label + ": contacts are not looked at:\n" + indented(l.blind) + "\n";
    for (const Losses& x : l.losses) below += l.label + ": " + text_of(x, Length::shortly) + "\n";
  }
  std::string out = head(all) + aligned(rows) + below;
  if (!all.levels[all.reference].failure.empty()) out += "the reference did not run: name another with --reference\n";
  return out + "cost: of this machine now, one thread, per simulated second; all else is the same on every machine\n";
}

std::string csv(const Compared& all) {
  std::string out =
      "level,robots,whole_ms_per_s,varied_ms_per_s,contact_ms_per_s,real_time_robots,position_rms_m,position_largest_m,"
      "heading_largest_rad,first_contact_s,first_contact_later_s,contacts,distance_m,failure\n";
  const auto number = [](const auto& x) { return x ? fmt::format("{}", *x) : std::string(); };
  const Level& reference = all.levels[all.reference];
  for (const Level& l : all.levels) {
    out += fmt::format("{},{},", quoted(l.label), all.comparison.robots.size());
    if (!l.failure.empty()) {
      out += std::string(11, ',') + quoted(l.failure) + "\n";
      continue;
    }
    const std::optional<Deviation> d = deviation_of(l, reference);
    std::optional<double> later;
    if (l.first_contact && reference.first_contact) later = *l.first_contact - *reference.first_contact;
    out += fmt::format("{},{},{},{},", 1e3 * l.cost.whole, 1e3 * l.cost.varied, 1e3 * l.cost.contact,
                       real_time_robots(all.comparison, l));
    out += d ? fmt::format("{},{},{},", d->position_rms, d->position_largest, d->heading_largest) : ",,,";
    out +=
        fmt::format("{},{},{},{},\n", number(l.first_contact), number(later), number(l.contacts), l.track->distance());
  }
  return out;
}

std::string picture(const Compared& all) {
  const Comparison& c = all.comparison;
  Chart chart;
  chart.title = fmt::format("{}: {}, {:g} s", c.scenario.name, plural(c.robots.size(), "robot"), c.duration);
  chart.subtitle = "distance from where " + all.levels[all.reference].label + " puts the robots";
  chart.x = {fmt::format("cost of {} with collision and contact", names_of(c.varieties)), "ms per simulated second"};
  chart.y = {"position, RMS over time and robots", "m"};
  chart.marks = {{1000, "real time"}};
  const std::size_t per_group = c.varieties.size() > 1 ? all.levels.size() / c.varieties.front().choices.size() : 0;
  if (per_group > 0)
    for (const Choice& choice : c.varieties.front().choices) chart.groups.push_back(choice.label);
  for (std::size_t i = 0; i < all.levels.size(); ++i) {
    const Level& l = all.levels[i];
    const std::optional<Deviation> d = deviation_of(l, all.levels[all.reference]);
    if (!d) continue;
    std::string label = l.label;
    if (per_group > 0) label.erase(0, chart.groups[i / per_group].size() + 3);  // the colour says it
    chart.points.push_back({label + (i == all.reference ? " (reference)" : ""), 1e3 * (l.cost.varied + l.cost.contact),
                            d->position_rms, per_group > 0 ? i / per_group : 0, i == all.reference});
  }
  return svg(chart);
}

}  // namespace muro::host
