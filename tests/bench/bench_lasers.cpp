// SPDX-License-Identifier: MIT
// Compares methods of laser scanners: rays and pictures, the cost of the z-buffer and of OpenGL used directly, and the
// number of rays from which the z-buffer is worth it.
#include <fmt/format.h>

#include <chrono>

#include "core/instance.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/render/gpu_scene.hpp"
#include "plugins/laser/common/zbuffer/camera_rig.hpp"
#include "tests/bench/baselines/depth.hpp"
#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr int vehicles = 100;
constexpr double range = 30;  // m
constexpr int turns = 5;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// A grid of rays, symmetric about straight ahead.
struct Grid {
  int columns, rows;
  double horizontal_fov, vertical_fov;  ///< rad

  std::string name() const { return fmt::format("{}x{}", columns, rows); }
  scanner::Grid scanner() const {
    return {.min_angle = -0.5 * horizontal_fov,
            .max_angle = 0.5 * horizontal_fov,
            .columns = std::uint32_t(columns),
            .min_elevation = -0.5 * vertical_fov,
            .max_elevation = 0.5 * vertical_fov,
            .rows = std::uint32_t(rows)};
  }
};

/// One scanner in the city, on the first vehicle. Nothing moves, so that all methods see the same. Each scan still
/// checks where everything is.
class OneScanner {
 public:
  OneScanner(const City& city, const Grid& grid, const std::string& method, double supersampling = 1) : scene_(city) {
    scene_.use("motion.point", 100, scene_.all_robots());
    scene_.use_kinematics();
    scene_.use("scene.bvh", 0);
    const RobotView& carrier = *scene_.world().robots()[0];
    sensor_ = scene_.add_sensor_object(carrier, "laser", carrier.base());
    std::map<std::string, ParameterInput> parameters{{"rays", std::int64_t(grid.columns)},
                                                     {"rows", std::int64_t(grid.rows)},
                                                     {"min_angle", -0.5 * grid.horizontal_fov},
                                                     {"max_angle", 0.5 * grid.horizontal_fov},
                                                     {"min_elevation", -0.5 * grid.vertical_fov},
                                                     {"max_elevation", 0.5 * grid.vertical_fov},
                                                     {"max_range", range},
                                                     {"offset", std::vector{0.0, 0.0, scanner_height}}};
    if (method == "laser.zbuffer") parameters["device"] = std::string("software");
    if (method == "laser.zbuffer") parameters["supersampling"] = supersampling;
    scene_.use(method, 100, {{&carrier, sensor_}}, parameters);
    scene_.build();
    for (std::size_t i = 0; i < scene_.instances().size(); ++i) {
      const std::string& used = scene_.instances()[i]->setup().use;
      if (used == method || (used == "scene.bvh" && method == "laser.raycast")) tasks_.push_back(scene_.task_of(i));
    }
    scene_.run_for(0.2);  // warm
  }
  /// Returns the time of a scan (us), with all that it needs except poses of bodies.
  double turn() {
    const double start = now();
    double spent = seconds();
    int scans = 0;
    while (now() - start < 0.15 || scans < 4) {
      scene_.run_for(0.1);
      scans += 10;
    }
    spent = seconds() - spent;
    return 1e6 * spent / scans;
  }
  double mean_range() {
    double sum = 0;
    const std::span<const double> ranges = scene_.world().values(sensor_, keys::ranges);
    for (const double r : ranges) sum += r / double(ranges.size());
    return sum;
  }

 private:
  double seconds() {
    double sum = 0;
    for (const TaskId t : tasks_)
      sum += double(scene_.scheduler().cost(t).ticks) * scene_.scheduler().seconds_per_tick();
    return sum;
  }

  CityScene scene_;
  ObjectId sensor_ = no_object;
  std::vector<TaskId> tasks_;
};

/// Returns the visible bodies of the city, in the form in which a separate program would keep them.
BareDepth::Instances visible_bodies(const City& city, const Pose& camera_pose, const render::Frustum& frustum) {
  BareDepth::Instances found;
  const auto add = [&](std::vector<BareDepth::Transform>& list, const Pose& pose, const Vec3& scale, double radius) {
    const Vec3 position = pose.position - camera_pose.position;
    if (position.norm() > range + radius) return;
    for (const Eigen::Vector4d& plane : frustum)
      if (plane.head<3>().dot(position) + plane[3] <= -radius) return;
    const Mat3 rotation = pose.orientation.toRotationMatrix() * scale.asDiagonal();
    BareDepth::Transform& transform = list.emplace_back();
    for (int row = 0; row < 3; ++row) {
      for (int k = 0; k < 3; ++k) transform[std::size_t(4 * row + k)] = float(rotation(row, k));
      transform[std::size_t(4 * row + 3)] = float(position[row]);
    }
  };
  const auto box = [&](const Pose& pose, const Vec3& lengths) {
    add(found.boxes, pose, lengths, 0.5 * lengths.norm());
  };
  box({{camera_pose.position.x(), camera_pose.position.y(), -0.5}, Quat::Identity()}, {60, 60, 1});  // the ground
  for (const Block& b : city.blocks()) box({b.centre, Quat::Identity()}, b.lengths);
  for (std::size_t v = 1; v < city.starts().size(); ++v) {
    const Pose& p = city.starts()[v];
    box(p, {Rover::length, Rover::width, Rover::height});
    for (int w = 0; w < 4; ++w)
      add(found.cylinders, p * Pose{Rover::wheel_centre(w), from_rpy(-M_PI / 2, 0, 0)},
          {Rover::wheel_radius, Rover::wheel_radius, Rover::wheel_width},
          std::hypot(Rover::wheel_radius, 0.5 * Rover::wheel_width));
  }
  return found;
}

/// Draws the views that laser.zbuffer draws for a grid, by OpenGL directly, and measures the time (us).
class BareViews {
 public:
  BareViews(const City& city, const Grid& grid) : rig_(zbuffer::CameraRig::of(scanner::RaySet::of(grid.scanner()), 1)) {
    const render::Surface wheel = render::unit_cylinder(render::corners_for(Rover::wheel_radius, 2e-4));
    const Pose camera_pose = city.starts()[0] * Pose{{0, 0, scanner_height}, Quat::Identity()};
    for (render::Camera& camera : rig_.cameras) {
      camera.pose = camera_pose * camera.pose;
      camera.near = 1e-3;
      pixels_ += double(camera.width) * camera.height;
      drawn_.push_back({std::make_unique<BareDepth>(camera.width, camera.height, wheel),
                        render::projection_of(camera).cast<float>(),
                        visible_bodies(city, camera_pose, render::frustum_of(camera))});
    }
  }
  double turn() {
    const double start = now();
    int passes = 0;
    for (; now() - start < 0.15; ++passes)
      for (View& v : drawn_) v.depth->draw(v.projection, v.instances);
    return 1e6 * (now() - start) / passes;
  }
  double pixels() const { return pixels_; }
  std::size_t views() const { return drawn_.size(); }

 private:
  struct View {
    std::unique_ptr<BareDepth> depth;
    Eigen::Matrix4f projection;
    BareDepth::Instances instances;
  };
  zbuffer::CameraRig rig_;
  std::vector<View> drawn_;
  double pixels_ = 0;
};

/// Returns a grid over the same angles with a tenth of columns and rows; supersampling_of_few(): for as many pixels.
Grid few_of(const Grid& g) {
  const auto fewer = [](int n) { return n > 1 ? std::max(2, 1 + (n - 1) / 10) : 1; };
  return {fewer(g.columns), fewer(g.rows), g.horizontal_fov, g.vertical_fov};
}
double supersampling_of_few(const Grid& g) {
  const auto pitch = [](const Grid& grid) {
    return 1 / zbuffer::CameraRig::of(scanner::RaySet::of(grid.scanner()), 1).cameras.front().fx;
  };
  return pitch(few_of(g)) / pitch(g);
}

/// Medians of several turns, in which all methods take part: us a scan.
struct Times {
  double rays, picture, drawn, embree, bare;
  double pixels;
  std::size_t views;
  double mean_ray, mean_picture;
};

Times times_of(const City& city, const Grid& grid) {
  OneScanner rays(city, grid, "laser.raycast"), picture(city, grid, "laser.zbuffer"),
      embree(city, grid, "laser.embree");
  BareViews bare(city, grid);
  OneScanner drawn(city, few_of(grid), "laser.zbuffer", supersampling_of_few(grid));
  std::vector<double> r, p, d, e, b;
  for (int k = 0; k < turns; ++k) {
    r.push_back(rays.turn());
    p.push_back(picture.turn());
    d.push_back(drawn.turn());
    e.push_back(embree.turn());
    b.push_back(bare.turn());
  }
  return {median(r),     median(p),    median(d),         median(e),           median(b),
          bare.pixels(), bare.views(), rays.mean_range(), picture.mean_range()};
}

}  // namespace

int main(int argc, char** argv) {
  Report report("lasers", "Methods of laser scanners: rays, pictures, OpenGL used directly", argc, argv);
  const City city(vehicles);
  report.table(
      fmt::format("us a scan: one scanner on one of {} vehicles in the city, {} m, one thread", vehicles, range),
      {"rays", "laser.raycast", "laser.embree", "laser.zbuffer", "its pictures", "its pixels",
       "the same pixels for few rays", "OpenGL directly", "pictures to OpenGL directly", "mean range by rays, m",
       "by z-buffer, m"});
  const Grid grids[] = {{10, 1, 1.0, 0},      {100, 1, 1.0, 0},        {682, 1, 4.1786, 0},  {100, 10, 1.0, 0.2},
                        {100, 100, 1.0, 1.0}, {1024, 64, 1.0, 0.0625}, {640, 480, 1.0, 0.75}};
  const std::string only = report.argument("rays", "");
  for (const Grid& grid : grids) {
    if (!only.empty() && only != grid.name()) continue;
    const Times t = times_of(city, grid);
    report.row({grid.name(), fixed(t.rays, 1), fixed(t.embree, 1), fixed(t.picture, 1), t.views, whole(t.pixels),
                fixed(t.drawn, 1), fixed(t.bare, 1), fixed(t.drawn / t.bare, 2), fixed(t.mean_ray, 3),
                fixed(t.mean_picture, 3)});
    report.ratio(fmt::format("{} rays: pictures of laser.zbuffer to OpenGL directly, {} pixels", grid.name(), t.pixels),
                 t.drawn / t.bare, "at most 1.3");
  }

  if (!only.empty()) return 0;
  report.table("Break-even: square grids of 60 by 60 degrees, us a scan",
               {"rays", "laser.raycast", "laser.embree", "laser.zbuffer"});
  double over_rays = 0, over_embree = 0;
  for (const int n : {4, 8, 16, 32, 64, 128, 256, 512, 1024}) {
    const Times t = times_of(city, {n, n, 1.0472, 1.0472});
    report.row({fmt::format("{0}x{0}", n), fixed(t.rays, 1), fixed(t.embree, 1), fixed(t.picture, 1)});
    if (over_rays == 0 && t.picture < t.rays) over_rays = double(n) * n;
    if (over_embree == 0 && t.picture < t.embree) over_embree = double(n) * n;
  }
  const auto told = [](double rays) {
    return rays > 0 ? fmt::format("from {:.0f} rays on", rays) : std::string("at no number of rays up to 1 048 576");
  };
  report.note("On this machine the z-buffer is faster than laser.raycast " + told(over_rays) +
              ", and faster than laser.embree " + told(over_embree) +
              ". It draws by Mesa's llvmpipe in the calling thread; a GPU moves both.");
  report.finish();
  return 0;
}
