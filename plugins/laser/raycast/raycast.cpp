// SPDX-License-Identifier: MIT
// A laser scanner by exact ray casting; see README.md.
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "caster.hpp"
#include "muro/mounting.hpp"
#include "muro/plugin.hpp"

namespace {

using namespace muro;
using raycast::Caster;
using raycast::Grid;
using raycast::Pattern;
using raycast::ScanKernels;
using raycast::SceneTable;
using std::numbers::pi;

constexpr Parameter parameters[] = {
    real("min_angle", "rad", -pi, "azimuth of the first ray").between(-4 * pi, 4 * pi),
    real("max_angle", "rad", pi, "azimuth of the last ray; 2 pi after the first, the seam is cast once")
        .between(-4 * pi, 4 * pi),
    integer("rays", 360, "rays in a row").between(1, 1e6),
    integer("rows", 1, "rows of rays, from the lowest elevation to the highest").between(1, 4096),
    real("min_elevation", "rad", 0, "elevation of the first row").between(-pi / 2, pi / 2),
    real("max_elevation", "rad", 0, "elevation of the last row").between(-pi / 2, pi / 2),
    reals("directions", "rad", {}, "pairs azimuth, elevation, one for each ray, instead of a grid"),
    real("min_range", "m", 0, "what is nearer reads this").between(0, 1e6),
    real("max_range", "m", 10, "what is farther is not seen and reads this").between(1e-6, 1e6),
    mounting_offset,
    mounting_rpy,
    boolean("see_self", false, "whether the robot that carries the scanner is seen"),
    boolean("hits", false, "also write laser.hits"),
};
constexpr Use reads[] = {{"pose", "of the sensor's object"}, {"scene.index", "of the world"}};
constexpr Use writes[] = {
    {"ranges", "distance along each ray, row by row"},
    {"laser.hits", "hits: true: the object that each ray meets"},
    {"laser.min_angle", "constant"},
    {"laser.angle_increment", "constant; 0 for a list of directions"},
    {"laser.columns", "constant"},
    {"laser.rows", "constant"},
    {"laser.min_range", "constant"},
    {"laser.max_range", "constant"},
    mounting_writes,
};
constexpr Description description{
    .id = "laser.raycast",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary =
        "A laser scanner with any pattern of rays: exact distances to boxes, spheres, cylinders, capsules, planes",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | batched | allocation_free | restorable,
};

void check_interval(const char* low_name, double low, const char* high_name, double high) {
  if (low > high)
    throw Error(std::string(low_name) + " (" + std::to_string(low) + ") is greater than " + high_name + " (" +
                std::to_string(high) + "); exchange them");
}

class Raycast final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    min_range_ = p.real("min_range");
    max_range_ = p.real("max_range");
    if (min_range_ >= max_range_)
      throw Error("min_range (" + std::to_string(min_range_) + " m) must be less than max_range (" +
                  std::to_string(max_range_) + " m)");
    mounting_ = mounting_of(p);
    const Grid shown = p.given("directions") ? read_directions(p) : read_grid(p);

    scene_ = c.read(world_object, keys::scene_index);
    for (const Item& item : c.items()) {
      const ObjectId sensor = item.object;
      c.set(sensor, keys::laser_min_angle, shown.first_angle());
      c.set(sensor, keys::laser_angle_increment, shown.angle_increment());
      c.set(sensor, keys::laser_columns, shown.columns);
      c.set(sensor, keys::laser_rows, shown.rows);
      c.set(sensor, keys::laser_min_range, min_range_);
      c.set(sensor, keys::laser_max_range, max_range_);
      c.set(sensor, keys::sensor_origin, mounting_);
      Scanner s;
      s.pose = c.read(sensor, keys::pose);
      s.ranges = c.variable_array(sensor, keys::ranges, pattern_->size());
      if (p.boolean("hits")) s.hits = c.variable_array(sensor, keys::laser_hits, pattern_->size());
      if (item.robot && !p.boolean("see_self")) s.ignored_robot = std::int32_t(item.robot->number);
      scanners_.push_back(s);
    }
    warn_of_meshes(c);
    kernels_ = &raycast::scan_kernels_for(lane::best_isa());
  }

  void start() override { built_ = false; }
  void restored() override { built_ = false; }

  std::span<const Phase> phases() const override {
    static constexpr Phase few_rays[] = {{Phase::Over::whole}, {Phase::Over::items, Phase::Reach::wide}};
    static constexpr Phase many_rays[] = {{Phase::Over::whole}, {Phase::Over::items, Phase::Reach::wide, true}};
    return pattern_->size() < 500 ? few_rays : many_rays;
  }

  void step(const Step& step, Range range) override {
    if (step.phase == 0) return look_at_scene();
    thread_local Caster caster;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Scanner& s = scanners_[i];
      caster.cast(*kernels_, table_, {*s.pose * mounting_, max_range_, s.ignored_robot, min_range_}, *pattern_,
                  *s.ranges, s.hits ? *s.hits : std::span<ObjectId>());
    }
  }

 private:
  struct Scanner {
    In<Pose> pose;
    ArrayOut<double> ranges;
    ArrayOut<ObjectId> hits;
    std::int32_t ignored_robot = -1;
  };

  /// Takes over shapes at the first time, and where robots are now.
  void look_at_scene() {
    if (built_) return table_.update(*scene_);
    table_.build(*scene_);
    built_ = true;
  }

  /// Makes the pattern of a grid and returns the grid.
  Grid read_grid(const Parameters& p) {
    const Grid grid{.min_angle = p.real("min_angle"),
                    .max_angle = p.real("max_angle"),
                    .columns = std::uint32_t(p.integer("rays")),
                    .min_elevation = p.real("min_elevation"),
                    .max_elevation = p.real("max_elevation"),
                    .rows = std::uint32_t(p.integer("rows"))};
    check_interval("min_angle", grid.min_angle, "max_angle", grid.max_angle);
    check_interval("min_elevation", grid.min_elevation, "max_elevation", grid.max_elevation);
    if (grid.max_angle - grid.min_angle > 2 * pi + 1e-9)
      throw Error("min_angle to max_angle is " + std::to_string(grid.max_angle - grid.min_angle) +
                  " rad; a row goes round once at most (6.283186)");
    if (std::uint64_t(grid.columns) * grid.rows > (1u << 24))
      throw Error("rays * rows is " + std::to_string(std::uint64_t(grid.columns) * grid.rows) +
                  "; at most 16777216 rays are possible");
    pattern_.emplace(grid);
    return grid;
  }

  /// Makes the pattern of a list and returns what to tell of it: one row, as many columns as rays, no increment.
  Grid read_directions(const Parameters& p) {
    for (const char* name : {"min_angle", "max_angle", "rays", "rows", "min_elevation", "max_elevation"})
      if (p.given(name)) throw Error(std::string("directions and ") + name + " are both given; remove one of them");
    const std::span<const double> pairs = p.reals("directions");
    if (pairs.empty() || pairs.size() % 2 != 0)
      throw Error("directions has " + std::to_string(pairs.size()) +
                  " numbers; give an azimuth and an elevation for every ray");
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (!std::isfinite(pairs[i])) throw Error("directions: number " + std::to_string(i + 1) + " is not finite");
    pattern_.emplace(pairs);
    return {.min_angle = pairs[0], .max_angle = pairs[0], .columns = pattern_->size()};
  }

  void warn_of_meshes(Connector& c) {
    std::size_t meshes = 0;
    std::string_view first;
    for (std::uint32_t i = 0; i < c.object_count(); ++i)
      for (const Shape& shape : c.constant_array(ObjectId(i), keys::collision_shapes)) {
        if (shape.kind != ShapeKind::mesh) continue;
        if (++meshes == 1) first = c.object_name(ObjectId(i));
      }
    if (meshes > 0)
      c.host().log(LogLevel::warning, "laser.raycast does not see meshes: " + std::to_string(meshes) +
                                          " collision shapes are left out, the first on " + std::string(first));
  }

  std::vector<Scanner> scanners_;
  In<SceneIndex> scene_;
  std::optional<Pattern> pattern_;
  Pose mounting_;
  double min_range_ = 0, max_range_ = 0;
  const ScanKernels* kernels_ = nullptr;
  SceneTable table_;
  bool built_ = false;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Raycast>(description)};

}  // namespace

MURO_PLUGIN(.name = "laser_raycast", .version = "1.0.0", .licence = "MIT", .summary = "Laser scanner by ray casting",
            .algorithms = algorithms)
