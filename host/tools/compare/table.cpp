// SPDX-License-Identifier: MIT
#include "host/tools/compare/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/names.hpp"
#include "host/tools/compare/chart.hpp"

namespace muro::host {

namespace {

/// Returns three significant digits, without an exponent below 1e9.
std::string rounded(double x) { return x >= 1000 && x < 1e9 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x); }

std::string names_of(const std::vector<Factor>& factors) {
  std::vector<std::string> names;
  for (const Factor& f : factors) names.push_back(f.name);
  return fmt::format("{}", fmt::join(names, " + "));
}

using Row = std::vector<std::string>;

/// A deviation that only some robots have: two columns, for the root mean square and the largest.
struct Part {
  const char *subject, *unit;
  std::optional<Differences> Deviation::*differences;
};
constexpr Part deviation_parts[] = {{"link", "m", &Deviation::links},
                                    {"joint", "rad", &Deviation::revolute_joints},
                                    {"joint", "m", &Deviation::prismatic_joints}};

/// Returns the parts that any of the robots has; empty when no variation ran.
std::vector<Part> parts_of(const Compared& all) {
  std::vector<Part> some;
  for (const Part& p : deviation_parts)
    if (std::any_of(all.results.begin(), all.results.end(), [&](const VariationResult& r) {
          const std::optional<Deviation> d = deviation_of(r, r);
          return d && *d.*p.differences;
        }))
      some.push_back(p);
  return some;
}

/// Aligns columns to the right, the first one to the left.
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

Row row_of(const Compared& all, const std::vector<Part>& some, const VariationResult& result) {
  const VariationResult& reference = all.results[all.reference];
  const std::optional<Deviation> d = deviation_of(result, reference);
  const auto ms = [](double seconds) { return rounded(1e3 * seconds); };
  Row row = {result.label + (&result == &reference ? " *" : ""), ms(result.cost.total), ms(result.cost.varied),
             ms(result.cost.contact), rounded(std::floor(real_time_robots(all.comparison, result)))};
  for (const double x : {d ? d->position_rms : 0, d ? d->position_largest : 0, d ? d->heading_largest : 0})
    row.push_back(d ? rounded(x) : "-");
  for (const Part& p : some) {
    const std::optional<Differences> differences = d ? *d.*p.differences : std::nullopt;
    row.push_back(differences ? rounded(differences->rms) : "-");
    row.push_back(differences ? rounded(differences->largest) : "-");
  }
  row.push_back(result.first_contact ? fmt::format("{:.2f}", *result.first_contact) : "-");
  row.push_back(result.first_contact && reference.first_contact
                    ? fmt::format("{:+.2f}", *result.first_contact - *reference.first_contact)
                    : "-");
  row.push_back(result.contacts ? std::to_string(*result.contacts) : "-");
  row.push_back(fmt::format("{:.2f}", result.trajectory->distance()));
  return row;
}

std::string indented(const std::string& text) {
  std::string out = "  ";
  for (const char c : text) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return out;
}

std::string csv_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : c == '\n' ? " " : std::string(1, c);
  return out + "\"";
}

std::string head(const Compared& all) {
  const Comparison& c = all.comparison;
  return fmt::format("{}: {}, {:g} s, seed {}; reference *: {}\n", c.scenario.name, plural(c.robots.size(), "robot"),
                     c.duration, c.seed.value_or(c.scenario.seed), all.results[all.reference].label);
}

/// Whether only links show the motion of the robots, as in arms that are fixed to the world.
bool has_still_bases(const Compared& all) {
  return std::all_of(all.results.begin(), all.results.end(), [&](const VariationResult& r) {
    const std::optional<Deviation> d = deviation_of(r, all.results[all.reference]);
    return !d || (d->links && d->position_largest == 0);
  });
}

}  // namespace

double real_time_robots(const Comparison& comparison, const VariationResult& result) {
  return result.cost.total > 0 ? double(comparison.robots.size()) / result.cost.total : 0;
}

std::optional<Deviation> deviation_of(const VariationResult& result, const VariationResult& reference) {
  if (!result.failure.empty() || !reference.failure.empty()) return std::nullopt;
  return deviation_of(*result.trajectory, *reference.trajectory);
}

std::string table(const Compared& all) {
  const std::vector<Part> some = parts_of(all);
  Row titles = {"", "cost, ms/s", "", "", "robots in", "position, m", "", "heading"};
  Row names = {names_of(all.comparison.factors), "total", "varied", "contact", "real time", "rms", "largest", "rad"};
  for (const Part& p : some) {
    titles.insert(titles.end(), {fmt::format("{}s, {}", p.subject, p.unit), ""});
    names.insert(names.end(), {"rms", "largest"});
  }
  titles.insert(titles.end(), {"first contact", "", "contacts", "distance"});
  names.insert(names.end(), {"s", "later", "begun", "m"});
  std::vector<Row> rows = {titles, names};
  std::string remarks;
  for (const VariationResult& r : all.results) {
    if (r.failure.empty())
      rows.push_back(row_of(all, some, r));
    else
      remarks += fmt::format("{} did not run:\n{}\n", r.label, indented(r.failure));
    if (!r.repeatable) remarks += r.label + " did not end twice in the same state: its figures hold for one run\n";
    if (!r.no_monitor.empty())
      remarks += fmt::format("{}: contacts are not monitored:\n{}\n", r.label, indented(r.no_monitor));
    for (const UnsupportedFeatures& u : r.unsupported)
      remarks += fmt::format("{}: {}\n", r.label, text_of(u, Detail::brief));
  }
  std::string out = head(all) + aligned(rows) + remarks;
  if (!all.results[all.reference].failure.empty()) out += "the reference did not run: name another with --reference\n";
  return out +
         "cost: on this machine now, one thread, per simulated second; all other columns are the same on every "
         "machine\n";
}

std::string csv(const Compared& all) {
  std::string out =
      "variation,robots,total_ms_per_s,varied_ms_per_s,contact_ms_per_s,real_time_robots,position_rms_m,position_"
      "largest_m,heading_largest_rad,";
  for (const Part& p : deviation_parts)
    for (const char* const which : {"rms", "largest"}) out += fmt::format("{}_{}_{},", p.subject, which, p.unit);
  out += "first_contact_s,first_contact_later_s,contacts,distance_m,failure\n";
  const auto number = [](const auto& x) { return x ? fmt::format("{}", *x) : std::string(); };
  const VariationResult& reference = all.results[all.reference];
  for (const VariationResult& r : all.results) {
    out += fmt::format("{},{},", csv_text(r.label), all.comparison.robots.size());
    if (!r.failure.empty()) {
      out += std::string(11 + 2 * std::size(deviation_parts), ',') + csv_text(r.failure) + "\n";
      continue;
    }
    const std::optional<Deviation> d = deviation_of(r, reference);
    std::optional<double> later;
    if (r.first_contact && reference.first_contact) later = *r.first_contact - *reference.first_contact;
    out += fmt::format("{},{},{},{},", 1e3 * r.cost.total, 1e3 * r.cost.varied, 1e3 * r.cost.contact,
                       real_time_robots(all.comparison, r));
    out += d ? fmt::format("{},{},{},", d->position_rms, d->position_largest, d->heading_largest) : ",,,";
    for (const Part& p : deviation_parts) {
      const std::optional<Differences> differences = d ? *d.*p.differences : std::nullopt;
      out += differences ? fmt::format("{},{},", differences->rms, differences->largest) : ",,";
    }
    out += fmt::format("{},{},{},{},\n", number(r.first_contact), number(later), number(r.contacts),
                       r.trajectory->distance());
  }
  return out;
}

std::string picture(const Compared& all) {
  const Comparison& c = all.comparison;
  Chart chart;
  chart.title = fmt::format("{}: {}, {:g} s", c.scenario.name, plural(c.robots.size(), "robot"), c.duration);
  chart.subtitle = "distance from where " + all.results[all.reference].label + " puts the robots";
  chart.x = {fmt::format("cost of {} with collision and contact", names_of(c.factors)), "ms per simulated second"};
  const bool by_links = has_still_bases(all);
  if (by_links) chart.subtitle = "distance of links from where " + all.results[all.reference].label + " puts them";
  chart.y = {by_links ? "position, RMS over time and links" : "position, RMS over time and robots", "m"};
  chart.marks = {{1000, "real time"}};
  const std::size_t per_group = c.factors.size() > 1 ? all.results.size() / c.factors.front().choices.size() : 0;
  if (per_group > 0)
    for (const Choice& choice : c.factors.front().choices) chart.groups.push_back(choice.label);
  for (std::size_t i = 0; i < all.results.size(); ++i) {
    const VariationResult& r = all.results[i];
    const std::optional<Deviation> d = deviation_of(r, all.results[all.reference]);
    if (!d) continue;
    std::string label = r.label;
    if (per_group > 0) label.erase(0, chart.groups[i / per_group].size() + 3);  // the colour shows the group
    chart.points.push_back({label + (i == all.reference ? " (reference)" : ""), 1e3 * (r.cost.varied + r.cost.contact),
                            by_links ? d->links->rms : d->position_rms, per_group > 0 ? i / per_group : 0,
                            i == all.reference});
  }
  return svg(chart);
}

}  // namespace muro::host
