// SPDX-License-Identifier: MIT
// Chooses which of its motions moves a robot: by time, by distance to other robots, by contact, by the speed of the
// run.
#include <chrono>
#include <limits>
#include <optional>

#include "muro/plugin.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "rule.hpp"

namespace {

using namespace muro;
using level::Rule;

constexpr Parameter parameters[] = {
    texts("rules", "which motion moves the robot, and when; the first rule that holds decides"),
    real("dwell", "s", 0.1, "a motion moves the robot for so long at least").between(0, 1e6),
};
constexpr PropertyUse reads[] = {
    {"motion.level", "of the robot"},
    {"motion.level.names", "of the robot"},
    {"pose", "of bases of robots, for rules by distance"},
    {"contacts", "of the robot, for rules by contact"},
};
constexpr PropertyUse writes[] = {{"motion.level.target", "of the robot"}};
constexpr Description description{
    .id = "level.rules",
    .kind = Kind::level,
    .version = "1.0.0",
    .summary = "Hands a robot over between its motions by time, distance, contact and the speed of the run",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | allocation_free | restorable,
};

constexpr Key<std::int64_t> last_switch{"level.since", "ns", "when the robot was handed over last"};
constexpr Key<std::int64_t> last_touch{"level.touched", "ns", "when the robot touched another one last; -1: never"};

class Rules final : public Algorithm {
 public:
  void connect(Connector& c) override {
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it chooses motions of robots, but no robot is named");
      connect_robot(c, *item.robot);
    }
    dwell_ = std::int64_t(c.parameters().real("dwell") * 1e9);
    if (by_speed_)
      c.host().log(LogLevel::warning,
                   "level.rules: rules by the speed of the run make the result depend on the machine");
  }

  void start() override {
    begin_ = {};
    speed_.reset();
  }

  void step(const Step& step, Range range) override {
    if (by_speed_) measure(step.time);
    for (std::uint32_t i = range.begin; i < range.end; ++i) choose(robots_[i], step);
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Condition {
    Rule rule;
    std::vector<In<Pose>> others;
  };
  struct Robot {
    std::vector<Condition> conditions;
    bool by_touch = false;
    In<Pose> pose;
    In<std::uint32_t> level;
    Out<std::int32_t> target;
    ListIn<Contact> contacts;
    Out<std::int64_t> since, touched;
    std::vector<std::int32_t> robot_of;  ///< by object, for rules by contact
    std::int32_t number = 0;
  };

  void connect_robot(Connector& c, const RobotView& view) {
    Robot r;
    std::vector<std::string> names;
    for (const TextId id : c.constant_array(view.base(), keys::motion_level_names)) names.emplace_back(c.text(id));
    if (names.empty())
      throw Error("`" + std::string(view.name) + "` has only one motion; list several under `levels` of its motion");
    for (const std::string_view text : c.parameters().texts("rules")) {
      Condition condition{level::parse_rule(text, names), {}};
      const Rule& rule = condition.rule;
      const bool by_distance = rule.when == Rule::When::nearer || rule.when == Rule::When::farther;
      bool found = rule.robot.empty();
      for (const RobotView* other : c.robots()) {
        if (!by_distance || other == &view || c.constant(other->base(), keys::shadow_of)) continue;
        if (!rule.robot.empty() && rule.robot != other->name) continue;
        found = true;
        condition.others.push_back(c.read(other->base(), keys::pose));
      }
      if (by_distance && !found) {
        std::vector<std::string> known;
        for (const RobotView* other : c.robots())
          if (other != &view) known.emplace_back(other->name);
        throw Error("the rule `" + std::string(text) + "` names `" + rule.robot +
                    "`, but no other robot has this name" + did_you_mean(rule.robot, known));
      }
      r.by_touch = r.by_touch || rule.when == Rule::When::touched || rule.when == Rule::When::untouched;
      by_speed_ = by_speed_ || rule.when == Rule::When::slower || rule.when == Rule::When::faster;
      r.conditions.push_back(std::move(condition));
    }
    r.number = std::int32_t(view.number);
    r.pose = c.read(view.base(), keys::pose);
    r.level = c.read(view.base(), keys::motion_level);
    r.target = c.optional_output(view.base(), keys::motion_level_target);
    r.since = c.variable(view.base(), last_switch, std::int64_t{0});
    if (r.by_touch) {
      r.contacts = c.read_list(view.base(), keys::contacts);
      r.touched = c.variable(view.base(), last_touch, std::int64_t{-1});
      for (std::uint32_t i = 0; i < c.object_count(); ++i) r.robot_of.push_back(c.robot_of(ObjectId{i}));
    }
    robots_.push_back(std::move(r));
  }

  void choose(const Robot& r, const Step& step) const {
    if (r.by_touch && touches(r)) *r.touched = step.time;
    *r.target = std::int32_t(*r.level);
    if (*r.since > 0 && step.time - *r.since < dwell_) return;
    for (const Condition& c : r.conditions) {
      if (!holds(r, c, step)) continue;
      if (c.rule.level != *r.level) *r.since = step.time;
      *r.target = std::int32_t(c.rule.level);
      return;
    }
  }

  static bool touches(const Robot& r) {
    for (const Contact& contact : *r.contacts)
      if (const std::int32_t other = r.robot_of[index_of(contact.other)]; other >= 0 && other != r.number) return true;
    return false;
  }

  bool holds(const Robot& r, const Condition& c, const Step& step) const {
    const double now = step.seconds(), number = c.rule.number;
    switch (c.rule.when) {
      case Rule::When::at:
        return now >= number && now < number + step.dt;
      case Rule::When::nearer:
        return distance(r, c) < number;
      case Rule::When::farther:
        return distance(r, c) > number;
      case Rule::When::touched:
        return *r.touched == step.time;
      case Rule::When::untouched:
        return step.time - std::max(*r.touched, std::int64_t{0}) >= std::int64_t(number * 1e9);
      case Rule::When::slower:
        return speed_ && *speed_ < number;
      case Rule::When::faster:
        return speed_ && *speed_ > number;
    }
    return false;
  }

  /// To the nearest of those that the rule means, m.
  static double distance(const Robot& r, const Condition& c) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const In<Pose>& other : c.others) nearest = std::min(nearest, (other->position - r.pose->position).norm());
    return nearest;
  }

  /// How fast the run is, over a quarter of a second of the wall clock each time.
  void measure(std::int64_t time) {
    const Clock::time_point now = Clock::now();
    const double wall = std::chrono::duration<double>(now - begin_).count();
    if (begin_ != Clock::time_point{} && wall < 0.25) return;
    if (begin_ != Clock::time_point{}) speed_ = 1e-9 * double(time - begin_time_) / wall;
    begin_ = now;
    begin_time_ = time;
  }

  std::int64_t dwell_ = 0;
  bool by_speed_ = false;
  Clock::time_point begin_{};    ///< of what is measured
  std::optional<double> speed_;  ///< in units of real time
  std::int64_t begin_time_ = 0;
  std::vector<Robot> robots_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Rules>(description)};

}  // namespace

MURO_PLUGIN(.name = "level_rules", .version = "1.0.0", .licence = "MIT",
            .summary = "Rules by which robots change between their motions", .algorithms = algorithms)
