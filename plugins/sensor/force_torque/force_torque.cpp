// SPDX-License-Identifier: MIT
// A force-torque sensor in a joint or in a fixed connection of two links.
#include "muro/plugin.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/sensor/common/internal_sensor/link_load.hpp"
#include "plugins/sensor/common/internal_sensor/mounted.hpp"
#include "plugins/sensor/common/internal_sensor/property_uses.hpp"
#include "subtree.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;
using link_motion::FrameMotion, link_motion::LinkMotion, link_motion::Order;

constexpr PropertyUse reads[] = {
    reads_pose,
    reads_twist,
    reads_acceleration,
    {"joint.position", "of joints up to the sensor, and beyond it"},
    reads_joint_velocity,
    reads_joint_acceleration,
    reads_gravity,
    {"inertial", "of all links beyond the sensor"},
    {"wrench.applied", "of all links beyond the sensor, where forces move the robot"},
    {"contact.wrenches.law", "of the robot, where no force moves it"},
    {"contact.wrenches.motion", "of others, where no force moves it"},
    reads_contact_world,
};
constexpr PropertyUse writes[] = {{"wrench", "by what lies beyond on what carries it, axes of the device"},
                                  mounting_writes};
constexpr Description description{
    .id = "sensor.force_torque",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Force and torque that pass through a joint or a fixed connection",
    .parameters = mounting_parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Data of one device.
struct Device {
  LinkMotion link;  ///< the first link beyond the sensor
  Pose mounting;    ///< pose of the device in this link
  Subtree beyond;
  Out<Wrench> wrench;
};

class ForceTorque final : public PerRobotAlgorithm<Device> {
 public:
  void connect_by_name(Connector& c) override {
    for (std::uint32_t i = 0; i < c.items().size(); ++i) robot(i).link.check(c), robot(i).beyond.check(c);
    if (without_contacts_.empty()) return;
    c.host().log(LogLevel::info, "sensor.force_torque: no force moves " + without_contacts_ +
                                     ", so of its contacts those with robots that forces move are felt, beside weight "
                                     "and acceleration, and no others; give it a motion by forces for that");
  }

  void step(const Step&, Range range) override {
    for (Device& d : robots(range)) {
      const FrameMotion link = d.link.now();
      const Pose device = link.pose * d.mounting;
      const Wrench holding = d.beyond.holding_wrench(link, device.position, gravity_);
      const Quat to_device = device.orientation.conjugate();
      *d.wrench = {to_device * Vec3(-holding.force), to_device * Vec3(-holding.torque)};
    }
  }

 private:
  Device connect_robot(Connector& c, const Item& item) override {
    gravity_ = gravity_of(c);
    const RobotView& view = *item.robot;
    const std::uint32_t link = carrying_link_or_joint(c, item);
    if (link == 0)
      throw Error("it is mounted on the base of " + quote(view.name) +
                  ", which nothing carries; name with `on` a joint, or the link behind it");
    check_feet(c, view, link);
    Device d;
    d.mounting = mounting_of(c.parameters());
    c.set(item.object, keys::sensor_origin, d.mounting);
    d.link = LinkMotion(c, view, link, Pose{}, Order::acceleration);
    d.beyond = Subtree(c, view, link);
    if (d.beyond.reads_other_robots()) set_reads_other_robots();
    if (!is_moved_by_forces(c, view) && without_contacts_.empty()) without_contacts_ = quote(view.name);
    d.wrench = c.variable(item.object, keys::sensed_wrench, Wrench{});
    return d;
  }

  /// Throws Error if the ground carries the links beyond the sensor, as reported by a motion without forces: then the
  /// forces of the ground are not known.
  static void check_feet(const Connector& c, const RobotView& view, std::uint32_t link) {
    if (is_moved_by_forces(c, view)) return;
    std::vector<bool> is_beyond(view.links.size());
    for (std::uint32_t i = link; i < view.links.size(); ++i) {
      is_beyond[i] = i == link || is_beyond[std::size_t(view.links[i].parent)];
      if (is_beyond[i] && c.is_used(view.links[i].object, keys::foot_contact, usage::variable))
        throw Error("no force moves " + quote(view.name) + ", so what the ground does to its foot " +
                    quote(c.object_name(view.links[i].object)) +
                    " is not known, nor what the leg bears; give the robot a motion by forces (motion.simplified with "
                    "contact.penalty, motion.mujoco, motion.bullet, motion.ode), or read `foot.contact` of that link");
    }
  }

  Vec3 gravity_ = Vec3::Zero();
  std::string without_contacts_;  ///< name of the first robot that no force moves
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<ForceTorque>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_force_torque", .version = description.version, .licence = "MIT",
            .summary = "A force-torque sensor", .algorithms = algorithms)
