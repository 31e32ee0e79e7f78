// SPDX-License-Identifier: MIT
// Control code puts a robot at a place, as a referee does with a ball; see README.md.
#include <cmath>
#include <string>
#include <vector>

#include "muro/ext/run_control.hpp"
#include "muro/plugin.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/text/quote.hpp"

namespace {

using namespace muro;

constexpr Key<Pose> place_pose{"place.pose", "m", "where the robot is to be put, in the world"};
constexpr Key<Twist> place_twist{"place.twist", "m/s, rad/s", "with this velocity, world axes"};
constexpr Key<std::int64_t> place_count{"place.count", "1", "the robot is put there whenever this number changes"};
constexpr Key<std::int64_t> place_answer{
    "place.answer", "1",
    "place.count of the last request, when it was done; below 0, -1 - place.count, where it was refused"};
constexpr Key<std::int64_t> place_seen{"place.seen", "1", "place.count of the last request that was taken"};

constexpr Parameter parameters[] = {
    boolean("force", false, "the robot is put also where it overlaps something"),
};
constexpr PropertyUse reads[] = {{place_pose.name, "where to"},
                                 {place_twist.name, "with which velocity"},
                                 {place_count.name, "a change of it is a request"}};
constexpr PropertyUse writes[] = {{place_answer.name, "what became of the last request"},
                                  {place_seen.name, "for itself"}};
constexpr Description description{
    .id = "controller.placement",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "Puts its robot where other control code asks for, between steps: for referees and tests",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | restorable,
};

class PlacedRobots final : public Algorithm, private RequestDone {
 public:
  void connect(Connector& c) override {
    control_ = RunControl::of(c.host());
    host_ = &c.host();
    if (!control_) throw Error("the program that runs this scenario cannot put robots anywhere while it runs");
    is_forced_ = c.parameters().boolean("force");
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it puts a robot; use it within one, not under `algorithms`");
      const ObjectId base = item.robot->base();
      robots_.push_back({std::string(item.robot->name), base, c.input(base, place_pose, Pose{}),
                         c.input(base, place_twist, Twist{}), c.input(base, place_count, std::int64_t(0)),
                         c.variable(base, place_answer, std::int64_t(0)),
                         c.variable(base, place_seen, std::int64_t(0))});
    }
  }

  void step(const Step&, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Robot& r = robots_[i];
      if (*r.count == *r.seen) continue;
      *r.seen = *r.count;
      Placement placement{r.base, *r.pose, *r.twist, is_forced_};
      if (const double length = placement.pose.orientation.norm(); length > 1e-6 && std::isfinite(length))
        placement.pose.orientation.coeffs() /= length;
      control_->place(placement, i, this);
    }
  }

 private:
  void done(std::uint64_t ticket, std::string_view problem) noexcept override {
    const Robot& r = robots_[ticket];
    *r.answer = problem.empty() ? *r.seen : -1 - *r.seen;
    if (!problem.empty())
      host_->log(LogLevel::warning, "robot " + quote(r.name) + " was not put elsewhere: " + std::string(problem));
  }

  struct Robot {
    std::string name;
    ObjectId base;
    In<Pose> pose;
    In<Twist> twist;
    In<std::int64_t> count;
    Out<std::int64_t> answer, seen;
  };
  std::vector<Robot> robots_;
  RunControl* control_ = nullptr;
  Host* host_ = nullptr;
  bool is_forced_ = false;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<PlacedRobots>(description)};

}  // namespace

MURO_PLUGIN(.name = "controller_placement", .version = description.version, .licence = "MIT",
            .summary = "Robots are put where control code asks for", .algorithms = algorithms)
