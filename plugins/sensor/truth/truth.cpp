// SPDX-License-Identifier: MIT
// The true pose and velocity of any object, for algorithms above the level of sensing (MuRoSimF, Section 1).
#include <vector>

#include "muro/plugin.hpp"
#include "plugins/sensor/common/internal_sensor/mounted.hpp"
#include "plugins/sensor/common/internal_sensor/property_uses.hpp"
#include "plugins/sensor/common/internal_sensor/scene_frame.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;
using link_motion::FrameMotion, link_motion::LinkMotion, link_motion::Order;

constexpr Parameter parameters[] = {
    mounting_offset,
    mounting_rpy,
    text("of", "",
         "the object whose truth is told: a part of the own robot, a robot, `robot/part`, or scenery; default: the "
         "device"),
    text("frame", "", "the object in whose frame it is told, named likewise; `self`: the device; default: the world"),
    boolean("acceleration", false, "also write truth.acceleration, of the device"),
};
constexpr PropertyUse reads[] = {reads_pose,           reads_twist,          reads_acceleration,
                                 reads_joint_position, reads_joint_velocity, reads_joint_acceleration};
constexpr PropertyUse writes[] = {{"truth.pose", "in the frame of reference"},
                                  {"truth.twist", "against the frame of reference, in its axes"},
                                  {"truth.acceleration", "acceleration: true; in the world"},
                                  mounting_writes};
constexpr Description description{
    .id = "sensor.truth",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "True pose and velocity of anything in the scene, in any frame",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class Truth final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it serves robots, but no robot is named");
      Teller t;
      if (p.boolean("acceleration")) {
        t.device = device_motion(c, item, Order::acceleration);
        t.acceleration = c.variable(item.object, keys::true_acceleration, Twist{});
      }
      const auto device = [&]() -> SceneFrame { return device_motion(c, item, Order::twist); };
      t.of = p.text("of").empty() ? device() : SceneFrame::named(c, item, p.text("of"));
      const std::string_view frame = p.text("frame");
      if (!frame.empty()) t.frame = frame == "self" ? device() : SceneFrame::named(c, item, frame);
      t.pose = c.variable(item.object, keys::true_pose, Pose{});
      t.twist = c.variable(item.object, keys::true_twist, Twist{});
      tellers_.push_back(std::move(t));
    }
  }

  void connect_by_name(Connector& c) override {
    for (const Teller& t : tellers_)
      if (t.device) t.device.check(c);
  }

  void step(const Step&, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Teller& t = tellers_[i];
      const FrameMotion of = t.of.now(), frame = t.frame.now();
      const Pose to_frame = frame.pose.inverse();
      *t.pose = to_frame * of.pose;
      const Vec3 drift = frame.twist.at(of.pose.position - frame.pose.position);
      *t.twist = {to_frame.orientation * Vec3(of.twist.linear - drift),
                  to_frame.orientation * Vec3(of.twist.angular - frame.twist.angular)};
      if (t.device) *t.acceleration = t.device.now().acceleration;
    }
  }

 private:
  struct Teller {
    SceneFrame of, frame;
    LinkMotion device;  ///< set if its acceleration is written
    Out<Pose> pose;
    Out<Twist> twist, acceleration;
  };

  std::vector<Teller> tellers_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Truth>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_truth", .version = description.version, .licence = "MIT",
            .summary = "True poses and velocities", .algorithms = algorithms)
