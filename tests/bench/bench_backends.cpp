// SPDX-License-Identifier: MIT
// Errors of every motion in the cases of known answers (tests/conformance/motion): backend x case x error.
//   --docs FOLDER   also writes the table to FOLDER/backends.md
#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "core/error.hpp"
#include "tests/bench/report.hpp"
#include "tests/conformance/motion/case.hpp"
#include "tests/conformance/motion/tunnelling.hpp"

namespace {

using namespace muro;
using namespace muro::bench;
using conformance::Bound, conformance::Case, conformance::Outcome;

/// Returns the motions that at least one case applies to.
std::vector<std::string> columns() {
  std::vector<std::string> all;
  for (const std::string& id : conformance::motions())
    if ((conformance::description_of(id).features & feature_forces) != 0) all.push_back(id);
  return all;
}

/// Returns the error in few digits, marked where its bound is not that of the case; "" where the case does not apply.
std::string cell(const std::string& motion, const Case& c) {
  if (!conformance::why_left_out(motion, c).empty()) return "";
  try {
    const Outcome seen = c.run(motion);
    const Bound bound = conformance::bound_of(motion, c);
    const std::string error = seen.error < 1e-12 ? "0" : fmt::format("{:.1e}", seen.error);
    if (seen.error > bound.error) return error + " (!)";
    return bound.why.empty() ? error : error + " *";
  } catch (const SetupError&) {
    return "refused";
  }
}

/// Returns the rows of the speeds from which a ball passes through walls.
std::vector<std::vector<std::string>> tunnelling_rows(std::vector<std::string> motions) {
  motions.emplace_back("motion.point");
  const auto text = [](double speed) { return std::isfinite(speed) ? fmt::format("{:.0f}", speed) : "never"; };
  std::vector<std::vector<std::string>> rows;
  for (const std::string& m : motions) {
    std::vector<std::string> row{m};
    for (const double thickness : {0.01, 0.1, 0.5, 0.0})
      row.push_back(text(conformance::tunnelling_speed(m, thickness)));
    rows.push_back(std::move(row));
  }
  return rows;
}
const std::vector<std::string> tunnelling_header{"motion", "wall of 1 cm", "of 10 cm", "of 50 cm", "ground plane"};

std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  std::string out;
  const auto add = [&](const std::vector<std::string>& row) {
    out += "|";
    for (const std::string& cell : row) out += " " + cell + " |";
    out += "\n";
  };
  add(header);
  out += "|";
  for (std::size_t i = 0; i < header.size(); ++i) out += "---|";
  out += "\n";
  for (const auto& row : rows) add(row);
  return out;
}

/// Returns the text of the page. `tunnelling`: see tunnelling_rows().
std::string page(const std::vector<std::string>& motions, const std::vector<std::vector<std::string>>& rows,
                 const std::vector<std::vector<std::string>>& tunnelling) {
  std::string out =
      "# Backends and what they do\n\n"
      "For users who choose a motion: every backend in every case with a known answer, and how far it is\n"
      "from it. Made by `./dev bench backends`.\n\n"
      "Each case has an answer from outside (a closed form, a published figure);\n"
      "`tests/conformance/motion` holds every motion that offers what a case needs to the bound. All at\n"
      "1000 Hz with default parameters; the top at 4000, loads also at 250, gains of energy at 250, 500,\n"
      "1000 and 4000, of which the worst stands here. `*`: the motion has a bound of its own, for the\n"
      "reason below the table. Empty: it does not offer what the case needs.\n\n| case | unit | bound |";
  for (const std::string& m : motions) out += " " + m + " |";
  out += "\n|---|---|---|";
  for (std::size_t i = 0; i < motions.size(); ++i) out += "---|";
  for (const auto& row : rows) {
    out += "\n|";
    for (const std::string& c : row) out += " " + c + " |";
  }
  out += "\n\n| motion | case | its bound | reason |\n|---|---|---|---|\n";
  for (const std::string& m : motions)
    for (const Case& c : conformance::all_cases())
      if (const Bound b = conformance::bound_of(m, c); !b.why.empty() && conformance::why_left_out(m, c).empty())
        out += fmt::format("| {} | {} | {:g} | {} |\n", m, c.name, b.error, b.why);
  out +=
      "\n## Tunnelling\n\n"
      "Motions look for contacts at the instants of their steps, so what moves far in one passes through\n"
      "what is thin. The table has the speed, in m/s, up to which a ball of 10 cm never passes through a\n"
      "wall, wherever in a step the impact is, at 1000 Hz. The rule behind: a body is pushed back as long\n"
      "as its middle has not passed the middle of the wall, so it may move half its own thickness and half\n"
      "of the wall's in a step. The speeds grow in proportion to the rate, and for engines to the rate\n"
      "times `substeps`. Planes and heightmaps are solid below. Meshes with `meshes: exact` are shells\n"
      "without thickness. Motions that no force moves pass through everything unless `on_contact: stop`:\n"
      "then `motion.point` is as in the table, and motions on wheels are as `motion.point`.\n\n" +
      table(tunnelling_header, tunnelling);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  Report report("backends", "Motions against cases of known answers", argc, argv);
  const std::vector<std::string> motions = columns();
  std::vector<std::string> header{"case", "unit", "bound"};
  header.insert(header.end(), motions.begin(), motions.end());
  report.table("Errors; * has a bound of its own, (!) is above it", header);
  std::vector<std::vector<std::string>> rows;
  for (const Case& c : conformance::all_cases()) {
    std::vector<std::string> row{std::string(c.name), std::string(c.unit), fmt::format("{:g}", c.bound)};
    bool any = false;
    for (const std::string& m : motions) {
      row.push_back(cell(m, c));
      any = any || !row.back().empty();
    }
    if (!any) continue;
    report.row(std::vector<Cell>(row.begin(), row.end()));
    rows.push_back(std::move(row));
  }
  const std::vector<std::vector<std::string>> tunnelling = tunnelling_rows(motions);
  report.table("Tunnelling: up to so many m/s a ball of 10 cm does not pass", tunnelling_header);
  for (const auto& row : tunnelling) report.row(std::vector<Cell>(row.begin(), row.end()));
  report.finish();
  if (const std::string folder = report.argument("docs", ""); !folder.empty()) {
    const std::string file = folder + "/backends.md";
    std::ofstream out(file);
    out << page(motions, rows, tunnelling);
    if (!out) {
      fmt::print(stderr, "{} cannot be written\n", file);
      return 2;
    }
  }
  return 0;
}
