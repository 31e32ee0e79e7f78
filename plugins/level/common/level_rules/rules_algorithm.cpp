// SPDX-License-Identifier: MIT
#include "rules_algorithm.hpp"

#include <algorithm>

#include "plugins/common/text/quote.hpp"

namespace muro::level {

namespace {

constexpr Key<std::int64_t> switch_time{"level.switch_time", "ns", "when the robot was handed over last"};
constexpr Key<std::int32_t> known_level{"level.known", "1", "which motion moved the robot at the last look; -1: none"};
constexpr Key<std::int64_t> contact_time{"level.contact_time", "ns",
                                         "when the robot was in contact with another one last; -1: never"};

}  // namespace

void RulesAlgorithm::connect(Connector& c) {
  for (const Item& item : c.items()) {
    if (!item.robot) throw Error("it chooses motions of robots, but no robot is named");
    connect_robot(c, *item.robot);
  }
  dwell_ = std::int64_t(c.parameters().real("dwell") * 1e9);
}

RulesAlgorithm::Condition RulesAlgorithm::read_condition(Connector& c, const RobotView& view, std::string_view text,
                                                         std::span<const std::string> levels) const {
  Condition condition{parse_rule(text, levels), {}};
  const Rule& rule = condition.rule;
  if (rule.by_run_speed() && !run_speed_is_known_)
    throw Error("the rule " + quote(text) +
                " goes by the speed of the run, which only the machine's clock tells; use level.budget, which reads "
                "the clock and so is not deterministic");
  if (rule.by_distance()) condition.landmark = Landmark(c, view, rule.what, text);
  if (rule.by_place()) condition.landmark = Landmark::place(c, rule.what, text);
  return condition;
}

void RulesAlgorithm::connect_robot(Connector& c, const RobotView& view) {
  Robot r;
  std::vector<std::string> levels;
  for (const TextId id : c.constant_array(view.base(), keys::motion_level_names)) levels.emplace_back(c.text(id));
  if (levels.empty()) throw Error(quote(view.name) + " has only one motion; list several under `levels` of its motion");
  for (const std::string_view text : c.parameters().texts("rules")) {
    r.conditions.push_back(read_condition(c, view, text, levels));
    r.by_contact = r.by_contact || r.conditions.back().rule.by_contact();
  }
  r.id = view.id;
  r.pose = c.read(view.base(), keys::pose);
  r.level = c.read(view.base(), keys::motion_level);
  r.choice = c.optional_output(view.base(), keys::motion_level_rule);
  r.switch_time = c.variable(view.base(), switch_time, std::int64_t{0});
  r.known_level = c.variable(view.base(), known_level, std::int32_t{-1});
  if (r.by_contact) {
    r.contacts = c.read_list(view.base(), keys::contacts);
    r.contact_time = c.variable(view.base(), contact_time, std::int64_t{-1});
    for (std::uint32_t i = 0; i < c.object_count(); ++i) r.robot_of.push_back(c.robot_of(ObjectId{i}));
  }
  robots_.push_back(std::move(r));
}

void RulesAlgorithm::choose(const Step& step, Range range, std::optional<double> run_speed) const {
  for (std::uint32_t i = range.begin; i < range.end; ++i) choose(robots_[i], step, run_speed);
}

void RulesAlgorithm::choose(const Robot& r, const Step& step, std::optional<double> run_speed) const {
  if (r.by_contact && is_in_contact(r)) *r.contact_time = step.time;
  const auto level = std::int32_t(*r.level);
  if (*r.known_level >= 0 && level != *r.known_level && level != *r.choice) *r.switch_time = step.time;
  *r.known_level = level;
  const bool dwells = *r.switch_time > 0 && step.time - *r.switch_time < dwell_;
  *r.choice = dwells ? level : -1;
  if (dwells) return;
  for (const Condition& c : r.conditions) {
    if (!holds(r, c, step, run_speed)) continue;
    if (c.rule.level != *r.level) *r.switch_time = step.time;
    *r.choice = std::int32_t(c.rule.level);
    return;
  }
}

bool RulesAlgorithm::is_in_contact(const Robot& r) {
  for (const Contact& contact : *r.contacts)
    if (const RobotId other = r.robot_of[index_of(contact.other)]; other != no_robot && other != r.id) return true;
  return false;
}

bool RulesAlgorithm::holds(const Robot& r, const Condition& c, const Step& step, std::optional<double> run_speed) {
  const double now = step.seconds(), number = c.rule.number;
  switch (c.rule.when) {
    case Rule::When::at:
      return now >= number && now < number + step.dt;
    case Rule::When::nearer:
      return c.landmark.distance(r.pose->position) < number;
    case Rule::When::farther:
      return c.landmark.distance(r.pose->position) > number;
    case Rule::When::inside:
      return c.landmark.distance(r.pose->position) == 0;
    case Rule::When::outside:
      return c.landmark.distance(r.pose->position) > 0;
    case Rule::When::in_contact:
      return *r.contact_time == step.time;
    case Rule::When::out_of_contact:
      return step.time - std::max(*r.contact_time, std::int64_t{0}) >= std::int64_t(number * 1e9);
    case Rule::When::slower:
      return run_speed && *run_speed < number;
    case Rule::When::faster:
      return run_speed && *run_speed > number;
  }
  return false;
}

}  // namespace muro::level
