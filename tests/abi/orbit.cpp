// SPDX-License-Identifier: MIT
// Moves a base on a circle about the world's z axis. It uses everything whose layout matters at the border between host
// and plugin: fixed and dynamic Eigen values on the heap, shapes, spans, texts, parameters. CMake compiles it once for
// each set of flags. VARIANT: from CMake, e.g. avx2.
#include <vector>

#include "muro/plugin.hpp"
#include "muro/toolkit/rotations.hpp"

namespace {

using namespace muro;

constexpr Key<double> paint{"abi.paint", "1", "sum of all colour values of the shapes"};
constexpr double default_axis[] = {0, 0, 1};
constexpr Parameter parameters[] = {real("rate", "rad/s", 1, "turn rate").between(-10, 10),
                                    reals("axis", "1", default_axis, "axis of the orbit").of_length(3),
                                    text("who", "nobody", "whom to greet")};
constexpr PropertyUse writes[] = {{"pose", "of the base"}, {"twist", "of the base"}, {"abi.paint", "of the base"}};
constexpr Description description{.id = "motion.orbit_" VARIANT,
                                  .kind = Kind::motion,
                                  .version = "1.0.0",
                                  .summary = "Circles about an axis of the world",
                                  .parameters = parameters,
                                  .writes = writes,
                                  .capabilities = deterministic | batched | allocation_free | restorable};

class Orbit final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    if (p.text("who") != "world") throw Error("the text arrived as `" + std::string(p.text("who")) + "`");
    axis_ = Vec3(p.reals("axis")[0], p.reals("axis")[1], p.reals("axis")[2]);
    rate_ = p.real("rate");
    for (const Item& item : c.items()) {
      const ObjectId base = item.object;
      const Rows<Shape> shapes = c.constant_array(base, keys::collision_shapes);
      Eigen::Matrix<double, 4, Eigen::Dynamic> colors(4, Eigen::Index(shapes.size()));
      for (std::size_t i = 0; i < shapes.size(); ++i) colors.col(Eigen::Index(i)) = shapes[i].color;
      robots_.push_back({Eigen::Matrix4d::Identity(),
                         c.variable(base, keys::pose, c.constant(base, keys::initial_pose).value_or(Pose{})),
                         c.variable(base, keys::twist, Twist{}), c.variable(base, paint, 0.0), colors});
    }
  }

  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      Robot& r = robots_[i];
      r.turn.topLeftCorner<3, 3>() = rotation_of(Vec3(axis_ * (rate_ * step.dt))).toRotationMatrix();
      Pose& pose = *r.pose;
      pose.position = (r.turn * pose.position.homogeneous()).head<3>();
      pose.orientation = Quat(Mat3(r.turn.topLeftCorner<3, 3>() * pose.orientation.toRotationMatrix())).normalized();
      *r.twist = {Vec3(rate_ * axis_.cross(pose.position)), Vec3(rate_ * axis_)};
      *r.paint = r.colors.sum();
    }
  }

 private:
  struct Robot {
    Eigen::Matrix4d turn;
    Out<Pose> pose;
    Out<Twist> twist;
    Out<double> paint;
    Eigen::Matrix<double, 4, Eigen::Dynamic> colors;
  };
  std::vector<Robot> robots_;
  Vec3 axis_;
  double rate_ = 0;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Orbit>(description)};

}  // namespace

MURO_PLUGIN(.name = "orbit_" VARIANT, .version = "1.0.0", .licence = "MIT", .summary = "A circling base",
            .algorithms = algorithms)
