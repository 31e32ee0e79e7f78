// SPDX-License-Identifier: MIT
// Cost of a vehicle on a heightmap, compared with the same vehicle on a plane: motion.simplified with collision.native
// and contact.penalty, on one thread, alternately in one run.
//   --vehicles N   number of vehicles, 300 by default
//   --ground NAME  only grounds whose names contain NAME
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>

#include "muro/toolkit/heightmap.hpp"
#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/files.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr const char* rover_urdf = MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf";
constexpr const char* wheels[] = {"front_left", "rear_left", "front_right", "rear_right"};
constexpr double apart = 5;  ///< m, from vehicle to vehicle

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Hills with slopes of up to 20 degrees, 15 m from top to top, with bumps of up to `bumps` m.
struct Hills {
  std::vector<float> values;
  Heightmap map;

  Hills(double length, std::uint32_t nodes, double bumps) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> bump(-bumps, bumps);
    map = {{}, nodes, nodes, {length, length, 1}};
    values.resize(std::size_t(nodes) * nodes);
    map.values = values;
    for (std::uint32_t r = 0; r < nodes; ++r)
      for (std::uint32_t c = 0; c < nodes; ++c) {
        const Vec3 p = map.node(c, r);
        const double k = 2 * M_PI / 15, height = 0.6 * std::sin(k * p.x() + 0.3) * std::cos(0.8 * k * p.y());
        values[std::size_t(r) * nodes + c] = float(height + bump(engine));
      }
  }
  std::string write(const test::ScratchFolder& folder) const {
    return folder.file("hills.r32",
                       std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)));
  }
};

/// Vehicles on one ground, each with other wheel speeds.
class Vehicles : public test::Scene {
 public:
  /// `hills`: null for a plane.
  Vehicles(int count, const Hills* hills, Wheels shape_of_wheels) {
    if (hills) {
      Shape ground{.kind = ShapeKind::heightmap, .size = hills->map.size};
      ground.mesh = world().intern(hills->write(folder_));
      world().add_scenery("ground", {}, std::span(&ground, 1));
    } else {
      add_ground(0.8);
    }
    const RobotTree rover = read_model(rover_urdf);
    const int side = int(std::ceil(std::sqrt(count)));
    for (int v = 0; v < count; ++v) {
      const int row = v / side, column = v % side;
      const double x = apart * (column - 0.5 * (side - 1)), y = apart * (row - 0.5 * (side - 1));
      add(std::to_string(v), rover,
          {{x, y, 0.15 + (hills ? hills->map.ground_at(x, y)->height : 0)}, Quat::Identity()});
    }
    if (shape_of_wheels == Wheels::balls)
      for (const RobotView* r : world().robots())
        for (const char* const w : wheels)
          for (Shape& s :
               world().values(world().object(std::string(r->name) + "/" + w + "_wheel"), keys::collision_shapes))
            s.kind = ShapeKind::sphere;
    use("motion.simplified", 1000, all_robots());
    use_contacts();
    set_threads(1);
    build();
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> speed(-10, 10);
    for (const RobotView* r : world().robots()) {
      const double left = speed(engine), right = speed(engine);
      for (int w = 0; w < 4; ++w)
        world().value(std::string(r->name) + "/" + wheels[w] + "_wheel_joint", keys::joint_velocity_target) =
            w < 2 ? left : right;
    }
    run_for(0.5);
  }
  /// Returns the time of a step of one vehicle, ns.
  double round() {
    const double start = wall_clock();
    run_for(0.01);
    return 1e9 * (wall_clock() - start) / (10 * double(world().robots().size()));
  }
  /// Returns the mean height of the vehicles' bases, m.
  double mean_height() {
    double sum = 0;
    for (const RobotView* r : world().robots()) sum += pose(*r).position.z() / double(world().robots().size());
    return sum;
  }

 private:
  test::ScratchFolder folder_;
};

}  // namespace

int main(int argc, char** argv) {
  Report report("terrain", "Vehicles on a heightmap", argc, argv);
  const int vehicles = std::stoi(report.argument("vehicles", "300"));
  const std::string only = report.argument("ground", "");
  const double length = apart * (std::ceil(std::sqrt(vehicles)) + 8);
  const std::pair<const char*, Hills> grounds[] = {
      {"flat, cells of 0.5 m", Hills(length, std::uint32_t(2 * length) + 1, 0)},
      {"hills, cells of 0.5 m", Hills(length, std::uint32_t(2 * length) + 1, 0)},
      {"hills, cells of 0.1 m", Hills(length, std::uint32_t(10 * length) + 1, 0)},
      {"hills with bumps of 2 cm, cells of 0.25 m", Hills(length, std::uint32_t(4 * length) + 1, 0.02)},
  };
  report.table(
      fmt::format("{} vehicles, motion.simplified at 1000 Hz, one thread; the least of 200 rounds of 0.01 s each",
                  vehicles),
      {"ground", "wheels", "ns a vehicle and step", "on a plane", "ratio"});
  for (const Wheels shape : {Wheels::cylinders, Wheels::balls})
    for (const auto& [name, hills] : grounds) {
      if (std::string_view(name).find(only) == std::string_view::npos) continue;
      Hills ground = hills;
      if (&name == &grounds[0].first) std::fill(ground.values.begin(), ground.values.end(), 0.f);
      ground.map.values = ground.values;
      Vehicles on_plane(vehicles, nullptr, shape), on_ground(vehicles, &ground, shape);
      double plane = INFINITY, terrain = INFINITY;
      for (int k = 0; k < 200; ++k) {
        plane = std::min(plane, on_plane.round());
        terrain = std::min(terrain, on_ground.round());
      }
      const char* const of_wheels = shape == Wheels::balls ? "balls" : "cylinders";
      report.row({name, of_wheels, whole(terrain), whole(plane), fixed(terrain / plane, 2)});
      const bool gentle = std::string_view(name).find("0.5 m") != std::string_view::npos;
      report.ratio(fmt::format("{}, {} as wheels: cost of a vehicle, to that on a plane", name, of_wheels),
                   terrain / plane, gentle ? "at most 1.5" : "");
    }
  report.finish();
  return 0;
}
