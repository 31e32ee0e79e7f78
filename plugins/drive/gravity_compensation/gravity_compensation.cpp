// SPDX-License-Identifier: MIT
// Takes weight off links, as `gravcomp` of MuJoCo (XML reference, body) and `<gravity>` of SDFormat do.
#include <algorithm>
#include <map>

#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/text/quote.hpp"

namespace {

using namespace muro;

constexpr Parameter parameters[] = {
    texts("links", "bodies of the robot that are lifted; default: all that have mass"),
    real("fraction", "1", 1, "lift by weight: 1: none of it is felt; more: the link rises").between(-100, 100),
};
constexpr PropertyUse reads[] = {
    {"pose", "of every link that is lifted"},
    {"inertial", "of every link that is lifted"},
    {"gravity", "on the world object; 0 0 -9.81 when absent"},
};
constexpr PropertyUse writes[] = {{"wrench.external", "of links where the motion reads it, else of what carries them"}};

constexpr Description description{
    .id = "drive.gravity_compensation",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Takes the weight off links, for all motions that forces move",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Data of one robot: its lifted links, ordered by the links on which their forces act.
struct Robot {
  struct Pushed {
    Sum<Wrench> wrench;
    In<Pose> pose;
    Range links;
  };
  struct Lifted {
    In<Pose> pose;
    Vec3 center_of_mass = Vec3::Zero();  ///< in the frame of the link
    Vec3 force = Vec3::Zero();           ///< N, world axes
  };
  Range pushed;
};

class GravityCompensation final : public PerRobotAlgorithm<Robot> {
 public:
  void step(const Step&, Range range) override {
    for (const Robot& r : robots(range))
      for (Robot::Pushed& body : pushed_[r.pushed]) {
        Wrench sum;
        for (const Robot::Lifted& link : lifted_[body.links])
          sum.add_force(link.force, *link.pose * link.center_of_mass - body.pose->position);
        *body.wrench = sum;
      }
  }

 private:
  void read_parameters(const Parameters& p) override { fraction_ = p.real("fraction"); }

  Robot connect_robot(Connector& c, const Item& item) override {
    const RobotView& view = *item.robot;
    const Vec3 gravity = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    Robot robot;
    if (!c.is_used(view.base(), keys::external_wrench, usage::read_sum)) return robot;  // no force moves it
    std::map<std::uint32_t, std::vector<Robot::Lifted>> by_pushed;
    for (const std::uint32_t link : links_of(c, view)) {
      const auto inertia = c.constant(view.links[link].object, keys::inertial);
      if (!inertia || inertia->mass == 0) continue;
      by_pushed[pushed_by(c, view, link)].push_back(
          {c.read(view.links[link].object, keys::pose), inertia->com, -fraction_ * inertia->mass * gravity});
    }
    std::vector<Robot::Pushed> pushed;
    for (const auto& [link, lifted] : by_pushed) {
      const ObjectId object = view.links[link].object;
      pushed.push_back({c.accumulate(object, keys::external_wrench), c.read(object, keys::pose), lifted_.add(lifted)});
    }
    robot.pushed = pushed_.add(pushed);
    return robot;
  }

  static std::vector<std::uint32_t> links_of(Connector& c, const RobotView& view) {
    const std::span<const std::string_view> names = c.parameters().texts("links");
    std::vector<std::uint32_t> links;
    for (std::uint32_t i = 0; i < view.links.size(); ++i) links.push_back(i);
    if (names.empty()) return links;
    std::vector<std::string> known;
    for (const std::uint32_t i : links) known.emplace_back(local_name(c, view, i));
    for (const std::string_view name : names)
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error(quote(name) + " of `links` is no body of " + quote(view.name) + "; it has " + quoted_list(known));
    std::erase_if(links,
                  [&](std::uint32_t i) { return std::find(names.begin(), names.end(), known[i]) == names.end(); });
    return links;
  }

  /// Returns "arm" of "robot/arm".
  static std::string_view local_name(const Connector& c, const RobotView& view, std::uint32_t link) {
    const std::string_view full = c.object_name(view.links[link].object);
    return full.substr(std::min(full.size(), view.name.size() + 1));
  }

  /// Returns the link, or the nearest link that carries it, on which the motion lets wrenches act.
  static std::uint32_t pushed_by(const Connector& c, const RobotView& view, std::uint32_t link) {
    while (link > 0 && !c.is_used(view.links[link].object, keys::external_wrench, usage::read_sum))
      link = std::uint32_t(view.links[link].parent);
    return link;
  }

  double fraction_ = 1;
  PackedLists<Robot::Pushed> pushed_;
  PackedLists<Robot::Lifted> lifted_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<GravityCompensation>(description)};

}  // namespace

MURO_PLUGIN(.name = "drive_gravity_compensation", .version = description.version, .licence = "MIT",
            .summary = "Weight that is taken off links", .algorithms = algorithms)
