// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/tools/identify/identification.hpp"

namespace muro::host {

namespace {

/// A figure of the motor as in the scenario, with what the search found about it.
struct ReportLine {
  std::string name, unit, value, range, remark;
};

std::string digits(double x) { return fmt::format("{:.5g}", x); }

std::string range_of(const FitParameter& p) { return p.deviation > 0 ? fmt::format("{:.2g}", p.deviation) : ""; }

std::string bound_remark(const FitParameter& p) {
  if (p.is_at_low) return p.may_be_low && p.low == 0 ? "none is found" : "at the lower bound of the search";
  return p.is_at_high ? "at the upper bound of the search" : "";
}

std::vector<ReportLine> report_lines(const Identification& id) {
  std::vector<ReportLine> lines;
  for (const FitParameter& p : id.fit.parameters) {
    if (p.name != "torque_by_voltage") {
      lines.push_back({p.name, p.unit, digits(p.value), range_of(p), bound_remark(p)});
      continue;
    }
    FitParameter r = p;  // R = kt / (torque for each volt)
    r.value = id.fit.estimate.motor.resistance;
    r.deviation = r.value * (id.fit.parameters[0].deviation / id.fit.parameters[0].value + p.deviation / p.value);
    r.is_at_low = p.is_at_high, r.is_at_high = p.is_at_low;
    lines.push_back({"resistance", "Ohm", digits(r.value), range_of(r), bound_remark(r)});
  }
  return lines;
}

std::string short_name(const MotorRecord& r) { return std::filesystem::path(r.name).filename().string(); }

/// Returns rows of cells; the first row is the header.
std::string table_of(const std::vector<std::vector<std::string>>& rows, bool markdown) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::string line = markdown ? "|" : "";
    for (std::size_t i = 0; i < rows[k].size(); ++i)
      line += markdown ? fmt::format(" {} |", rows[k][i]) : fmt::format("  {:<{}}", rows[k][i], widths[i]);
    while (!line.empty() && line.back() == ' ') line.pop_back();
    text += line + "\n";
    if (markdown && k == 0) {
      text += "|";
      for (std::size_t i = 0; i < widths.size(); ++i) text += "---|";
      text += "\n";
    }
  }
  return text;
}

std::string heading(const std::string& title, bool markdown) {
  return markdown ? "\n## " + title + "\n\n" : "\n" + title + "\n";
}

double middle_voltage(const Identification& id) {
  std::vector<double> volts;
  for (const PredictedRecord& r : id.records)
    for (const RecordSample& s : r.record.samples) volts.push_back(s.supply_voltage);
  std::nth_element(volts.begin(), volts.begin() + std::ptrdiff_t(volts.size() / 2), volts.end());
  return volts[volts.size() / 2];
}

/// Returns the word for programs.
const char* word_of(UnseenData data) {
  switch (data) {
    case UnseenData::named_records:
      return "named_records";
    case UnseenData::each_record:
      return "each_record_in_turn";
    case UnseenData::groups_of_records:
      return "groups_of_records_in_turn";
    case UnseenData::last_quarter:
      break;
  }
  return "last_quarter";
}

/// Describes the unseen data; empty when the user has named them.
std::string unseen_line(const Validation& v) {
  if (v.data == UnseenData::named_records) return "";
  if (v.data == UnseenData::each_record)
    return "Not seen: each record in turn is left out, and predicted by a fit of the others.\n";
  if (v.data == UnseenData::groups_of_records)
    return fmt::format(
        "Not seen: each of {} groups of records in turn is left out, and predicted by a fit of the others.\n", v.fits);
  return fmt::format(
      "Not seen: the last quarter of the record, predicted by a fit of what comes before it; the fit of all has {:.4f} "
      "rad there.\n",
      v.fit_error);
}

}  // namespace

std::string scenario_fragment(const Identification& id) {
  const motor::MotorModel& m = id.fit.estimate.motor;
  std::string text = fmt::format(
      "motor: {{use: motor.servo, kt: {}, resistance: {}, armature: {},\n        supply_voltage: {}, p_gain: {}, "
      "duty_gain: {}, duty_limit: {},\n        friction: {}, viscous_friction: {}",
      digits(m.kt), digits(m.resistance), digits(m.armature), digits(middle_voltage(id)),
      digits(id.records.front().record.p_gain), fmt::format("{:.7g}", m.gain), digits(m.duty_limit),
      digits(m.friction.coulomb), digits(m.friction.viscous));
  const FrictionKind kind = id.settings.friction;
  const bool stribeck = kind == FrictionKind::m2 || kind == FrictionKind::m4;
  const bool load = kind == FrictionKind::m3 || kind == FrictionKind::m4;
  if (stribeck)
    text += fmt::format(",\n        stribeck_friction: {}, stribeck_velocity: {}, stribeck_exponent: {}",
                        digits(m.friction.stribeck), digits(m.friction.stribeck_velocity),
                        digits(m.friction.stribeck_exponent));
  if (load) text += fmt::format(",\n        load_friction: {}", digits(m.friction.load));
  if (load && stribeck) text += fmt::format(", load_stribeck_friction: {}", digits(m.friction.load_stribeck));
  if (id.fit.estimate.offset != 0) text += fmt::format(",\n        offset: {}", digits(id.fit.estimate.offset));
  if (id.fit.estimate.delay > 0) text += fmt::format(", delay: {}", digits(id.fit.estimate.delay));
  return text + "}\n";
}

std::string report_text(const Identification& id, bool markdown) {
  std::size_t fitted = 0;
  for (const PredictedRecord& r : id.records) fitted += r.is_validation ? 0 : 1;
  std::string text = markdown ? "# Motor identified from records\n\n" : "";
  text += fmt::format("Model {} from {} record{}: mean |error| {:.4f} rad", name_of(id.settings.friction), fitted,
                      fitted == 1 ? "" : "s", mean_error(id.records, false));
  if (fitted < id.records.size())
    text += fmt::format(", {:.4f} rad on the {} left out", mean_error(id.records, true), id.records.size() - fitted);
  else
    text += fmt::format(" of the fit, {:.4f} rad on what it has not seen", id.validation.unseen_error);
  text +=
      fmt::format(".\nOpen simulation of each record from its first sample on; {} simulations, {:.0f} s, seed {}.\n",
                  id.fit.evaluations, id.seconds, id.settings.seed);
  text += (markdown && fitted == id.records.size() ? "\n" : "") + unseen_line(id.validation);

  text += heading("Parameters, at the output", markdown);
  std::vector<std::vector<std::string>> rows{{"parameter", "value", "unit", "+-", "remark"}};
  for (const ReportLine& l : report_lines(id)) rows.push_back({l.name, l.value, l.unit, l.range, l.remark});
  text += table_of(rows, markdown);
  text += (markdown ? "\n" : "");
  text += "+-: how far it may go, with all others adapted, until the RMS error is 1 % larger.\n";

  text += heading("Error by record", markdown);
  rows = {{"record", "P gain", "use", "mean |error|, rad", "RMS, rad", "largest, rad"}};
  const bool has_unseen = fitted == id.records.size();
  if (has_unseen) rows.front().push_back("not seen: mean |error|, rad");
  for (const PredictedRecord& r : id.records) {
    rows.push_back({short_name(r.record), fmt::format("{:g}", r.record.p_gain), r.is_validation ? "left out" : "fit",
                    fmt::format("{:.4f}", r.error.mean), fmt::format("{:.4f}", r.error.rms),
                    fmt::format("{:.4f}", r.error.largest)});
    if (has_unseen) rows.back().push_back(r.unseen_error ? fmt::format("{:.4f}", *r.unseen_error) : "");
  }
  text += table_of(rows, markdown);

  if (!id.left_out.empty()) {
    text += heading("One P gain left out in turn", markdown);
    rows = {{"left out", "error on it, rad", "of the fit, rad", "ratio", "on it with all records, rad", "ratio"}};
    for (const CrossValidation& c : id.left_out)
      rows.push_back({fmt::format("{:g}", c.p_gain), fmt::format("{:.4f}", c.left_out_error),
                      fmt::format("{:.4f}", c.fit_error), fmt::format("{:.2f}", c.left_out_error / c.fit_error),
                      fmt::format("{:.4f}", c.full_fit_error),
                      fmt::format("{:.2f}", c.left_out_error / c.full_fit_error)});
    text += table_of(rows, markdown);
  }
  std::vector<std::string> remarks = id.fit.warnings;
  remarks.insert(remarks.end(), id.notes.begin(), id.notes.end());
  if (!remarks.empty()) text += heading("Remarks", markdown);
  for (const std::string& r : remarks) text += (markdown ? "- " : "  ") + r + "\n";
  text += heading("For a scenario", markdown);
  return text + (markdown ? "```yaml\n" : "") + scenario_fragment(id) + (markdown ? "```\n" : "");
}

std::string report_json(const Identification& id) {
  using nlohmann::json;
  json parameters = json::object(), bounds = json::array(), records = json::array(), left_out = json::array();
  const auto put = [&](const FitParameter& p, double value) {
    parameters[p.name] = {{"value", value}, {"unit", p.unit}, {"range", p.deviation}, {"low", p.low}, {"high", p.high}};
    if (p.is_at_low || p.is_at_high) bounds.push_back(p.name);
  };
  for (const FitParameter& p : id.fit.parameters) put(p, p.value);
  parameters["resistance"] = {{"value", id.fit.estimate.motor.resistance}, {"unit", "Ohm"}};
  for (const PredictedRecord& r : id.records)
    records.push_back({{"file", r.record.name},
                       {"p_gain", r.record.p_gain},
                       {"left_out", r.is_validation},
                       {"mean_error", r.error.mean},
                       {"rms_error", r.error.rms},
                       {"largest_error", r.error.largest},
                       {"unseen_mean_error", r.unseen_error ? json(*r.unseen_error) : json()}});
  for (const CrossValidation& c : id.left_out)
    left_out.push_back({{"p_gain", c.p_gain},
                        {"fit_error", c.fit_error},
                        {"left_out_error", c.left_out_error},
                        {"full_fit_error", c.full_fit_error}});
  const json all = {{"model", name_of(id.settings.friction)},
                    {"seed", id.settings.seed},
                    {"duty_gain", id.fit.estimate.motor.gain},
                    {"duty_limit", id.fit.estimate.motor.duty_limit},
                    {"mean_error", mean_error(id.records, false)},
                    {"mean_error_left_out", mean_error(id.records, true)},
                    {"validation",
                     {{"unseen", word_of(id.validation.data)},
                      {"fits", id.validation.fits},
                      {"mean_error", id.validation.unseen_error},
                      {"fit_mean_error", id.validation.fit_error}}},
                    {"parameters", parameters},
                    {"at_bounds", bounds},
                    {"records", records},
                    {"one_gain_left_out", left_out},
                    {"warnings", id.fit.warnings},
                    {"notes", id.notes},
                    {"scenario", scenario_fragment(id)}};
  return all.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace muro::host
