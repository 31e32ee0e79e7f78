// SPDX-License-Identifier: MIT
#include "tests/conformance/laser/room.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/image_file/png.hpp"

#include <algorithm>
#include <random>

namespace muro::test {

std::vector<std::string> laser_methods() {
  std::vector<std::string> ids;
  for (const CatalogEntry& o : plugins().catalog())
    if (o.id.rfind("laser.", 0) == 0) ids.push_back(o.id);
  return ids;
}

std::string method_name(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

Settings with(Settings settings, const Settings& more) {
  for (const auto& [name, value] : more) settings[name] = value;
  return settings;
}

Room::Room(const Pose& at) {
  carrier = &add("carrier", tree_of([](RobotBuilder& b) { b.base("body"); }), at);
}

ObjectId Room::put(const std::string& name, const Shape& shape, const Pose& at) {
  return world().add_scenery(name, at, std::span<const Shape>(&shape, 1));
}

void Room::furnish() {
  add_ground();
  put("east", Shape::box({0.2, 8.4, 3}), {{5.1, 0, 1.5}, Quat::Identity()});
  put("west", Shape::box({0.2, 8.4, 3}), {{-5.1, 0, 1.5}, Quat::Identity()});
  put("north", Shape::box({10.4, 0.2, 3}), {{0, 4.1, 1.5}, Quat::Identity()});
  put("south", Shape::box({10.4, 0.2, 3}), {{0, -4.1, 1.5}, Quat::Identity()});
  put("pillar", Shape::cylinder(0.5, 3), {{2, 2, 1.5}, Quat::Identity()});
}

void Room::scatter(unsigned seed, int count) {
  std::mt19937 dice(seed);
  const auto from = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice); };
  for (int i = 0; i < count; ++i) {
    const double r = from(0.1, 0.5), length = from(0.2, 1);
    const Shape shapes[] = {Shape::box({from(0.1, 1), from(0.1, 1), length}), Shape::sphere(r),
                            Shape::cylinder(r, length), Shape::capsule(r, length)};
    const Pose at{{from(-6, 6), from(-6, 6), from(0, 2)}, from_rpy(from(-3, 3), from(-1.5, 1.5), from(-3, 3))};
    if ((at.position - Vec3(0, 0, 1)).norm() < 2.5) continue;
    const std::string name = "thing" + std::to_string(i);
    if (i % 3 == 0)
      add(name, single_body(shapes[i % 4], {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}), at);
    else
      put(name, shapes[i % 4], at);
  }
}

ObjectId Room::put_heightmap(const std::string& name, const Vec3& size,
                             const std::function<double(double, double)>& height, const Pose& at) {
  constexpr std::size_t nodes = 129;
  std::vector<std::uint16_t> pixels;
  for (std::size_t row = nodes; row-- > 0;)  // the first row is at +y
    for (std::size_t column = 0; column < nodes; ++column) {
      const double x = (double(column) / (nodes - 1) - 0.5) * size.x(),
                   y = (double(row) / (nodes - 1) - 0.5) * size.y();
      pixels.push_back(std::uint16_t(std::lround(65535 * std::clamp(height(x, y) / size.z(), 0.0, 1.0))));
    }
  const std::string path = folder_.path(name + ".png");
  image_file::write_png(path, image_file::Format::grey16, nodes, nodes, pixels.data());
  return put(name, {.kind = ShapeKind::heightmap, .mesh = world().intern(path), .size = size}, at);
}

std::size_t Room::add_laser(const std::string& method, const Settings& settings) {
  sensors_.push_back(add_sensor_object(*carrier, "laser" + std::to_string(sensors_.size()), carrier->base()));
  lasers_.push_back({method, with({{"max_range", 20.0}}, settings)});
  // its own choice depends on the machine: see auto_test.cpp
  if (method == "laser.auto") lasers_.back().settings.try_emplace("method", std::string("raycast"));
  if (method == "laser.zbuffer" || method == "laser.auto") lasers_.back().settings["device"] = std::string("software");
  return sensors_.size() - 1;
}

void Room::build_and_run(double seconds) {
  use("motion.point", motion_rate, all_robots());
  use_kinematics();
  use("scene.bvh", 0);
  for (std::size_t i = 0; i < lasers_.size(); ++i)
    use(lasers_[i].method, laser_rate, {{carrier, sensors_[i]}}, lasers_[i].settings);
  build();
  run_for(seconds);
}

Settings urg() {
  const double step = 2 * pi / 1024;
  return {{"rays", std::int64_t(682)},
          {"min_angle", -340 * step},
          {"max_angle", 341 * step},
          {"min_range", 0.02},
          {"max_range", 5.6}};
}

Settings grid_100() {
  return {{"rays", std::int64_t(100)}, {"rows", std::int64_t(100)}, {"min_angle", -pi / 6},
          {"max_angle", pi / 6},       {"min_elevation", -pi / 6},  {"max_elevation", pi / 6}};
}

Bound bound_of(const std::string& method, double spacing, double supersampling) {
  if (method == "laser.zbuffer") return {3e-5, 3e-4, spacing / supersampling};
  return {1e-11, 1e-9, 0};
}

}  // namespace muro::test
