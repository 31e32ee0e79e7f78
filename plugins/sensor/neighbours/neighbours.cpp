// SPDX-License-Identifier: MIT
// Reads which robots are in range, in which direction and with which heading; see README.md.
#include <algorithm>
#include <cmath>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "muro/base/elementary.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/mounting.hpp"
#include "plugins/common/line_of_sight/line_of_sight.hpp"
#include "plugins/common/line_of_sight/spatial_hash.hpp"
#include "plugins/common/text/glob.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/sensor/common/neighbours/neighbour.hpp"

namespace muro::neighbours {
namespace {

constexpr double no_target[] = {0, 0, 0};
constexpr Parameter parameters[] = {
    real("range", "m", 3, "distance up to which others are seen").between(1e-6, 1e6),
    integer("max_neighbours", 32, "the nearest so many are reported").between(1, 1e6),
    boolean("line_of_sight", true, "others are hidden behind scenery and bodies of third robots"),
    texts("robots", "names of the robots that are seen, `*` for any characters and `?` for one; none: all"),
    reals("target", "m", no_target, "the point of another robot that is measured, in the frame of its base")
        .of_length(3),
    mounting_offset,
    mounting_rpy,
};
constexpr PropertyUse reads[] = {
    {"pose", "of the sensor's object, and of the bases of all robots that may be seen"},
    {"scene.index", "of the world, with line_of_sight"},
};
constexpr PropertyUse writes[] = {{"neighbours", "list: id, distance, bearing, elevation, heading of each"},
                                  mounting_writes};
constexpr Description description{
    .id = "sensor.neighbours",
    .kind = Kind::sensor,
    .version = "2.0.0",
    .summary =
        "Which robots are in range: distance, bearing, elevation, heading and number of each (range and bearing)",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Returns the angle about z, from x, of a direction; 0 along z.
double azimuth_of(const Vec3& v) { return elementary::atan2(v.y(), v.x()); }

class Neighbours final : public Algorithm {
 public:
  void connect(Connector& c) override;
  void start() override;
  std::span<const Phase> phases() const override {
    static constexpr Phase all[] = {{Phase::IndexSpace::whole}, {Phase::IndexSpace::items, Phase::Scope::reads_all}};
    return all;
  }
  void step(const Step& step, Range range) override;

 private:
  /// A robot that may be seen.
  struct Target {
    In<Pose> base;
    RobotId robot;
  };
  struct Device {
    In<Pose> pose;
    ListOut<Neighbour> seen;
    RobotId robot = no_robot;
  };
  void add_targets(Connector& c);
  void locate_targets();
  void serve(const Device& d) const;
  /// Returns the reading of a target by a device at `device`.
  Neighbour reading(const Pose& device, std::uint32_t target) const;

  double range_ = 0;
  std::size_t max_neighbours_ = 0;
  Vec3 target_ = Vec3::Zero();
  Pose mounting_;
  std::optional<line_of_sight::LineOfSight> sight_;
  std::vector<Target> targets_;
  std::vector<Device> devices_;
  std::vector<Vec3> places_;  ///< m, positions of the targets in this step
  SpatialHash hash_;          ///< of the positions
};

void Neighbours::add_targets(Connector& c) {
  const auto patterns = c.parameters().texts("robots");
  std::vector<bool> used(patterns.size());
  for (const RobotView* robot : c.robots()) {
    if (c.constant(robot->base(), keys::shadow_of)) continue;
    bool named = patterns.empty();
    for (std::size_t i = 0; i < patterns.size(); ++i)
      if (matches(patterns[i], robot->name)) named = used[i] = true;
    if (named) targets_.push_back({c.read(robot->base(), keys::pose), robot->id});
  }
  for (std::size_t i = 0; i < patterns.size(); ++i)
    if (!used[i])
      throw Error("robots: no robot is called " + quote(patterns[i]) +
                  "; give names as `muro describe` lists them, such as `rover_*`");
}

void Neighbours::connect(Connector& c) {
  const Parameters& p = c.parameters();
  range_ = p.real("range");
  max_neighbours_ = std::size_t(p.integer("max_neighbours"));
  target_ = Vec3(p.reals("target")[0], p.reals("target")[1], p.reals("target")[2]);
  mounting_ = mounting_of(p);
  add_targets(c);
  if (p.boolean("line_of_sight")) sight_.emplace().connect(c);
  for (const Item& item : c.items()) {
    c.set(item.object, keys::sensor_origin, mounting_);
    Device d;
    d.pose = c.read(item.object, keys::pose);
    d.seen = c.variable_list(item.object, key_neighbours);
    if (item.robot) d.robot = item.robot->id;
    devices_.push_back(d);
  }
}

void Neighbours::start() {
  places_.resize(targets_.size());
  hash_.reserve(targets_.size());
}

void Neighbours::locate_targets() {
  for (std::size_t i = 0; i < targets_.size(); ++i) places_[i] = *targets_[i].base * target_;
  hash_.build(places_, range_);
  if (sight_) sight_->begin_step();
}

void Neighbours::step(const Step& step, Range range) {
  if (step.phase == 0) return locate_targets();
  for (std::uint32_t i = range.begin; i < range.end; ++i) serve(devices_[i]);
}

Neighbour Neighbours::reading(const Pose& device, std::uint32_t target) const {
  const Quat back = device.orientation.conjugate();
  const Vec3 to = back * Vec3(places_[target] - device.position);
  const Vec3 ahead = back * Vec3(targets_[target].base->orientation * Vec3::UnitX());
  const double level = std::sqrt(to.x() * to.x() + to.y() * to.y());
  return {double(index_of(targets_[target].robot)), to.norm(), azimuth_of(to), elementary::atan2(to.z(), level),
          azimuth_of(ahead)};
}

void Neighbours::serve(const Device& d) const {
  struct InRange {
    double squared_distance;  // m^2
    std::uint32_t target;
    auto operator<=>(const InRange&) const = default;
  };
  thread_local std::vector<InRange> in_range;
  in_range.clear();
  in_range.reserve(targets_.size());
  d.seen.clear();
  const Pose device = *d.pose * mounting_;
  hash_.each_within(device.position, range_, [&](std::uint32_t i, double squared) {
    if (targets_[i].robot != d.robot) in_range.push_back({squared, i});
  });
  std::sort(in_range.begin(), in_range.end());
  thread_local line_of_sight::Fan fan;
  if (sight_ && !in_range.empty())
    sight_->look_around(device.position, d.robot, std::sqrt(in_range.back().squared_distance), in_range.size(), fan);
  for (const InRange& candidate : in_range) {
    if ((*d.seen).size() == max_neighbours_) break;
    const std::uint32_t i = candidate.target;
    if (sight_ && sight_->obstacles(fan, places_[i], targets_[i].robot) > 0) continue;
    d.seen.push_back(reading(device, i));
  }
  const std::span<Neighbour> all = *d.seen;
  std::sort(all.begin(), all.end(), is_listed_before);
}

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Neighbours>(description)};

}  // namespace
}  // namespace muro::neighbours

MURO_PLUGIN(.name = "sensor_neighbours", .version = muro::neighbours::description.version, .licence = "MIT",
            .summary = "Which robots are in range", .algorithms = muro::neighbours::algorithms)
