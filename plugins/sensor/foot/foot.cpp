// SPDX-License-Identifier: MIT
// A sole with a load cell in each corner and a switch.
#include <algorithm>
#include <array>

#include "muro/base/bounds.hpp"
#include "muro/base/number_text.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/sensor/common/internal_sensor/link_load.hpp"
#include "plugins/sensor/common/internal_sensor/mounted.hpp"
#include "plugins/sensor/common/internal_sensor/property_uses.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;

constexpr Parameter parameters[] = {
    mounting_offset,
    mounting_rpy,
    reals("size", "m", {},
          "length x and width y of the rectangle of the cells, about the device; default: the box around the link's "
          "shapes"),
    real("threshold", "N", 1, "the foot is in contact from this force on").between(0, 1e9),
    real("release_threshold", "N", -1, "it is no more in contact below this force; -1: half the threshold")
        .between(-1, 1e9),
};
constexpr PropertyUse reads[] = {
    reads_pose,         reads_joint_position,  {"collision.shapes", "of the link, for its size"},
    reads_contact,      reads_contacts_of_law, reads_contacts_of_motion,
    reads_contact_world};
constexpr PropertyUse writes[] = {{"foot.contact", "with hysteresis"},
                                  {"foot.force", "sum of the cells"},
                                  {"foot.cells", "front left, front right, rear left, rear right"},
                                  {"foot.center_of_pressure", "in the frame of the device"},
                                  mounting_writes};
constexpr Description description{
    .id = "sensor.foot",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Ground contact, load cells and centre of pressure of a foot",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Data of one foot.
struct Foot {
  link_motion::LinkMotion link;
  Pose device;  ///< pose in the link's frame
  Aabb sole;    ///< in the device's frame; z is the plane of the cells
  LinkLoad load;
  Out<std::uint32_t> contact;
  Out<double> force;
  Out<Vec3> center;
  ArrayOut<double> cells;
};

class FootSensor final : public PerRobotAlgorithm<Foot> {
 public:
  /// A load F, M about the device acts in the plane z of the cells at x = (-M_y + z F_x) / F_z and y = (M_x + z F_y) /
  /// F_z. The cells share F_z so that it acts at the same point, as long as this point is between the cells.
  void step(const Step&, Range range) override {
    for (const Foot& foot : robots(range)) {
      const Pose link = foot.link.now().pose, device = link * foot.device;
      const Wrench at_link = foot.load.wrench(link.position);
      const Quat to_device = device.orientation.conjugate();
      const Vec3 f = to_device * at_link.force;
      const Vec3 m = to_device * Vec3(at_link.torque + (link.position - device.position).cross(at_link.force));
      read(foot, f, m);
    }
  }

 private:
  void read_parameters(const Parameters& p) override {
    threshold_ = p.real("threshold");
    release_ = p.given("release_threshold") && p.real("release_threshold") >= 0 ? p.real("release_threshold")
                                                                                : 0.5 * threshold_;
    if (release_ > threshold_)
      throw Error("release_threshold (" + number_text(release_) + " N) is greater than threshold (" +
                  number_text(threshold_) + " N); a foot is released by less than what it is put down with");
  }

  Foot connect_robot(Connector& c, const Item& item) override {
    const RobotView& view = *item.robot;
    const std::uint32_t link = carrying_link(c, item);
    Foot foot;
    foot.device = mounting_of(c.parameters());
    c.set(item.object, keys::sensor_origin, foot.device);
    foot.link = {c, view, link, Pose{}, link_motion::Order::pose};
    foot.load = {c, view, link, Load::contacts};
    if (foot.load.reads_other_robots()) set_reads_other_robots();
    if (!is_moved_by_forces(c, view) || !foot.load.knows_contacts())
      throw Error(
          "no force moves " + quote(view.name) +
          ", so there is nothing for a foot to feel; give the robot a motion by forces (motion.simplified with "
          "contact.penalty, motion.mujoco, motion.bullet, motion.ode), or take sensor.bumper, which tells contact "
          "alone" +
          std::string(c.is_used(view.links[link].object, keys::foot_contact, usage::variable)
                          ? "; its motion itself tells `foot.contact` of " +
                                quote(c.object_name(view.links[link].object))
                          : ""));
    foot.sole = sole_of(c, view, link, foot.device);
    foot.contact = c.variable(item.object, keys::foot_contact, std::uint32_t{0});
    foot.force = c.variable(item.object, keys::foot_force, 0.0);
    foot.center = c.variable(item.object, keys::foot_center_of_pressure, Vec3(0, 0, 0));
    foot.cells = c.variable_array(item.object, keys::foot_cells, 4);
    return foot;
  }

  static Aabb sole_of(const Connector& c, const RobotView& view, std::uint32_t link, const Pose& device) {
    const std::span<const double> size = c.parameters().reals("size");
    if (!size.empty() && (size.size() != 2 || !(size[0] > 0) || !(size[1] > 0)))
      throw Error("size is the length and the width of the sole, two numbers above 0 in m");
    if (!size.empty()) return {Vec3(-0.5 * size[0], -0.5 * size[1], 0), Vec3(0.5 * size[0], 0.5 * size[1], 0)};
    Aabb box;
    for (const Shape& shape : c.constant_array(view.links[link].object, keys::collision_shapes))
      box.include(bounds_of(shape, device.inverse() * shape.origin));
    if (!(box.high.x() > box.low.x()) || !(box.high.y() > box.low.y()))
      throw Error(quote(c.object_name(view.links[link].object)) +
                  " has no collision shape that tells the size of a sole; give `size`");
    box.high.z() = box.low.z();
    return box;
  }

  void read(const Foot& foot, const Vec3& f, const Vec3& m) const {
    const double z = foot.sole.low.z(), normal = std::max(f.z(), 0.0);
    const bool is_pressed = normal > 0;
    const auto between = [](double x, double low, double high) {
      return std::clamp((x - low) / (high - low), 0.0, 1.0);
    };
    const double forward = is_pressed ? between((z * f.x() - m.y()) / f.z(), foot.sole.low.x(), foot.sole.high.x()) : 0;
    const double left = is_pressed ? between((z * f.y() + m.x()) / f.z(), foot.sole.low.y(), foot.sole.high.y()) : 0;
    const std::array<double, 4> cells{normal * forward * left, normal * forward * (1 - left),
                                      normal * (1 - forward) * left, normal * (1 - forward) * (1 - left)};
    std::copy(cells.begin(), cells.end(), (*foot.cells).begin());
    *foot.force = normal;
    const Vec3 size = foot.sole.high - foot.sole.low;
    *foot.center = is_pressed ? Vec3(foot.sole.low + Vec3(forward * size.x(), left * size.y(), 0)) : Vec3(Vec3::Zero());
    const bool stays = *foot.contact != 0 && normal >= release_;
    *foot.contact = stays || (normal >= threshold_ && is_pressed) ? 1 : 0;
  }

  double threshold_ = 0, release_ = 0;  ///< N
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<FootSensor>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_foot", .version = description.version, .licence = "MIT",
            .summary = "A foot with load cells", .algorithms = algorithms)
