// SPDX-License-Identifier: MIT
#include "settings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::scip2 {

namespace {

void replace(const Parameters& p, std::string_view name, std::int32_t& entry) {
  if (p.given(name)) entry = std::int32_t(p.integer(name));
}

/// Replaces an entry by a parameter. Texts go into lines of at most 64 characters; a semicolon ends them.
void replace(const Parameters& p, std::string_view name, std::string& entry) {
  const std::string_view text = p.text(name);
  if (text.empty()) return;
  const auto is_sent = [](char c) { return c >= ' ' && c <= '~' && c != ';'; };
  constexpr std::size_t longest = 56;
  if (text.size() > longest || !std::all_of(text.begin(), text.end(), is_sent))
    throw Error(std::string(name) + " is " + quote(text) + "; it must be at most " + std::to_string(longest) +
                " printable ASCII characters without a semicolon");
  entry = text;
}

void require(bool is_right, const std::string& what) {
  if (!is_right) throw Error(what);
}

void check(const Model& m) {
  const auto entry = [](const char* name, std::int32_t value) {
    return std::string(name) + " (" + std::to_string(value) + ")";
  };
  require(m.min_distance < m.max_distance,
          entry("dmin", m.min_distance) + " must be less than " + entry("dmax", m.max_distance));
  require(m.first_step <= m.last_step,
          entry("amin", m.first_step) + " must not be greater than " + entry("amax", m.last_step));
  require(m.step_count() <= std::uint32_t(m.steps_per_turn),
          "there are " + std::to_string(m.step_count()) + " steps from " + entry("amin", m.first_step) + " to " +
              entry("amax", m.last_step) + ", more than in a turn, " + entry("ares", m.steps_per_turn));
}

}  // namespace

Model read_model(const Parameters& p) {
  const std::string_view name = p.text("model");
  Model m = model_of(name);
  replace(p, "dmin", m.min_distance);
  replace(p, "dmax", m.max_distance);
  replace(p, "ares", m.steps_per_turn);
  replace(p, "amin", m.first_step);
  replace(p, "amax", m.last_step);
  replace(p, "afrt", m.front_step);
  replace(p, "scan", m.scan_rpm);
  replace(p, "modl", m.name);
  replace(p, "product", m.product);
  replace(p, "serial", m.serial);
  if (!p.text("firmware").empty()) {
    replace(p, "firmware", m.firmware);
    m.firmware_of_scip1 = m.firmware.substr(0, m.firmware.find('('));
    if (name == "urg-04lx") apply_firmware(m);
  }
  const std::string_view start = p.text("start");
  if (start != "model") m.start = start == "either" ? Start::either : start == "scip1.1" ? Start::scip1 : Start::scip2;
  if (p.given("reply_grid")) {
    m.reply_interval = std::llround(1e9 * p.real("reply_grid"));
    m.reply_time = m.reply_interval > 0 ? ReplyTime::at_interval : ReplyTime::at_once;
  }
  if (p.given("intensity")) m.has_intensity = p.boolean("intensity");
  if (p.given("multiecho")) m.has_multiecho = p.boolean("multiecho");
  check(m);
  return m;
}

}  // namespace muro::scip2
