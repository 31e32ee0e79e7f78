// SPDX-License-Identifier: MIT
#include "scanner.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "muro/base/number_text.hpp"
#include "plugins/common/link_motion/constant_twist.hpp"
#include "plugins/common/text/counted.hpp"
#include "scratch.hpp"

namespace muro::scanner {

namespace {

constexpr Key<double> key_sweep_ranges{"laser.sweep.ranges", "m", "array: the scan in progress"};
constexpr Key<double> key_sweep_incidence{"laser.sweep.incidence", "rad", "array: the scan in progress"};
constexpr Key<ObjectId> key_sweep_hits{"laser.sweep.hits", "1", "array: the scan in progress"};
constexpr Key<Pose> key_sweep_pose{"laser.sweep.pose", "m", "where the device was at the step before"};

void check_interval(const char* low_name, double low, const char* high_name, double high) {
  if (low > high)
    throw Error(std::string(low_name) + " (" + number_text(low) + ") is greater than " + high_name + " (" +
                number_text(high) + "); exchange them");
}

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
    throw Error("min_angle to max_angle is " + number_text(grid.max_angle - grid.min_angle) +
                " rad; a row goes round once at most (6.283186)");
  if (std::uint64_t(grid.columns) * grid.rows > (1u << 24))
    throw Error("rays * rows is " + std::to_string(std::uint64_t(grid.columns) * grid.rows) +
                "; at most 16777216 rays are possible");
  return grid;
}

std::span<const double> read_directions(const Parameters& p) {
  for (const char* name : {"min_angle", "max_angle", "rays", "rows", "min_elevation", "max_elevation"})
    if (p.given(name)) throw Error(std::string("directions and ") + name + " are both given; remove one of them");
  const std::span<const double> pairs = p.reals("directions");
  if (pairs.empty() || pairs.size() % 2 != 0)
    throw Error("directions has " + counted(pairs.size(), "number") +
                "; give an azimuth and an elevation for every ray");
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!std::isfinite(pairs[i])) throw Error("directions: number " + std::to_string(i + 1) + " is not finite");
  return pairs;
}

template <class T>
void copy(ArrayOut<T> from, ArrayOut<T> to) {
  if (to) std::copy((*from).begin(), (*from).end(), (*to).begin());
}

}  // namespace

void Scanner::connect(Connector& c) {
  const Parameters& p = c.parameters();
  min_range_ = p.real("min_range");
  max_range_ = p.real("max_range");
  if (min_range_ >= max_range_)
    throw Error("min_range (" + number_text(min_range_) + " m) must be less than max_range (" +
                number_text(max_range_) + " m)");
  mounting_ = mounting_of(p);
  read_pattern(p);
  if (p.real("divergence") > 0 || p.boolean("incidence")) beam_.emplace(p.real("divergence"));
  const auto steps = std::uint32_t(p.integer("sweep_steps"));
  if (steps > 1) sweep_.emplace(grid_, is_list_, steps);
  method_->connect(c);
  make_sets(is_list_ ? RaySet::of(p.reals("directions")) : RaySet::of(grid_));
  for (const Item& item : c.items()) bind(c, item);
}

void Scanner::read_pattern(const Parameters& p) {
  is_list_ = p.given("directions");
  if (!is_list_) {
    grid_ = read_grid(p);
    return;
  }
  const std::span<const double> pairs = read_directions(p);
  grid_ = {.min_angle = pairs[0],
           .max_angle = pairs[0],
           .columns = std::uint32_t(pairs.size() / 2),
           .min_elevation = pairs[1],
           .max_elevation = pairs[1]};
}

void Scanner::bind(Connector& c, const Item& item) {
  const Parameters& p = c.parameters();
  const ObjectId sensor = item.object;
  c.set(sensor, keys::laser_min_angle, grid_.first_angle());
  c.set(sensor, keys::laser_angle_increment, is_list_ ? 0 : grid_.angle_increment());
  c.set(sensor, keys::laser_columns, grid_.columns);
  c.set(sensor, keys::laser_rows, grid_.rows);
  c.set(sensor, keys::laser_min_elevation, grid_.elevation(0));
  c.set(sensor, keys::laser_elevation_increment,
        grid_.rows > 1 ? (grid_.max_elevation - grid_.min_elevation) / (grid_.rows - 1) : 0);
  c.set(sensor, keys::laser_min_range, min_range_);
  c.set(sensor, keys::laser_max_range, max_range_);
  c.set(sensor, keys::sensor_origin, mounting_);
  const bool hits = p.boolean("hits"), incidence = p.boolean("incidence");
  Device d;
  d.pose = c.read(sensor, keys::pose);
  d.ranges = c.variable_array(sensor, keys::ranges, size());
  if (hits) d.hits = c.variable_array(sensor, keys::laser_hits, size());
  if (incidence) d.incidence = c.variable_array(sensor, keys::laser_incidence, size());
  if (item.robot && !p.boolean("see_self")) d.ignored_robot = item.robot->id;
  if (sweep_) {
    d.previous_pose = c.variable(sensor, key_sweep_pose, Pose{});
    d.sweep_ranges = c.variable_array(sensor, key_sweep_ranges, size());
    if (hits) d.sweep_hits = c.variable_array(sensor, key_sweep_hits, size());
    if (incidence) d.sweep_incidence = c.variable_array(sensor, key_sweep_incidence, size());
  }
  devices_.push_back(d);
}

/// Makes the sets of rays. Set 0 is the full scan. In a sweep each column, or each step, has a set as well.
void Scanner::make_sets(const RaySet& full) {
  std::vector<RaySet> sets;
  const auto add = [&](std::uint32_t first, std::uint32_t end) {
    RaySet set;
    set.columns = end - first;
    set.rows = grid_.rows;
    set.spacing = full.spacing;
    for (std::uint32_t row = 0; row < grid_.rows; ++row)
      for (std::uint32_t column = first; column < end; ++column)
        set.directions.push_back(full.directions[row * grid_.columns + column]);
    sets.push_back(has_beam() ? beam_->widened(set) : std::move(set));
  };
  add(0, grid_.columns);
  if (sweep_ && method_->is_cheap_for_few_rays())
    for (std::uint32_t column = 0; column < grid_.columns; ++column) add(column, column + 1);
  else if (sweep_)
    for (std::uint32_t k = 0; k < sweep_->steps(); ++k) {
      sets_of_steps_.push_back(sets.size());
      if (sweep_->first(k) < sweep_->first(k + 1)) add(sweep_->first(k), sweep_->first(k + 1));
    }
  method_->prepare(sets);
}

std::span<const Phase> Scanner::phases() const {
  static constexpr Phase few_rays[] = {{Phase::IndexSpace::whole}, {Phase::IndexSpace::items, Phase::Scope::reads_all}};
  static constexpr Phase many_rays[] = {{Phase::IndexSpace::whole},
                                        {Phase::IndexSpace::items, Phase::Scope::reads_all, true}};
  return size() < 500 ? few_rays : many_rays;
}

bool Scanner::casts_rays_in(std::uint64_t step) const {
  if (!sweep_ || step == 0) return true;
  const auto k = std::uint32_t((step - 1) % sweep_->steps());
  return sweep_->first(k) < sweep_->first(k + 1);
}

void Scanner::step(const Step& step, Range range) {
  if (step.phase == 0) {
    if (!devices_.empty()) method_->begin_step(viewpoint_of(devices_.front()), devices_.size());
    if (casts_rays_in(step.index)) method_->update();
    if (method_->is_parallel()) return;
    for (const Device& d : devices_) serve(d, step.index);
  } else if (method_->is_parallel()) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) serve(devices_[i], step.index);
  }
}

void Scanner::serve(const Device& d, std::uint64_t index) {
  if (sweep_ && index > 0) return sweep(d, index);
  const Viewpoint from = viewpoint_of(d);
  const auto hits = d.hits ? *d.hits : std::span<ObjectId>();
  const auto incidence = d.incidence ? *d.incidence : std::span<double>();
  cast(0, from, 0, grid_.columns, {*d.ranges, incidence, hits});
  if (sweep_) *d.previous_pose = from.device;
}

void Scanner::sweep(const Device& d, std::uint64_t index) {
  const auto k = std::uint32_t((index - 1) % sweep_->steps());
  const std::uint32_t first = sweep_->first(k), end = sweep_->first(k + 1);
  const Pose previous = *d.previous_pose, now = *d.pose * mounting_;
  *d.previous_pose = now;
  const Scan scan{*d.sweep_ranges, d.sweep_incidence ? *d.sweep_incidence : std::span<double>(),
                  d.sweep_hits ? *d.sweep_hits : std::span<ObjectId>()};
  if (method_->is_cheap_for_few_rays()) {
    for (std::uint32_t column = first; column < end; ++column) {
      const Pose device = constant_twist::interpolated(previous, now, sweep_->time_fraction(column));
      cast(1 + column, {device, max_range_, d.ignored_robot, min_range_}, column, 1, scan);
    }
  } else if (first < end) {
    const double middle = 0.5 * (sweep_->time_fraction(first) + sweep_->time_fraction(end - 1));
    const Pose device = constant_twist::interpolated(previous, now, middle);
    cast(sets_of_steps_[k], {device, max_range_, d.ignored_robot, min_range_}, first, end - first, scan);
  }
  if (k != sweep_->last_step()) return;
  copy(d.sweep_ranges, d.ranges);
  copy(d.sweep_hits, d.hits);
  copy(d.sweep_incidence, d.incidence);
}

void Scanner::cast(std::size_t set, const Viewpoint& from, std::uint32_t first, std::uint32_t columns,
                   const Scan& scan) {
  const bool is_full_scan = columns == grid_.columns;
  if (is_full_scan && !has_beam()) return method_->cast(set, from, scan.ranges, scan.hits);

  thread_local std::vector<double> range_memory;
  thread_local std::vector<ObjectId> hit_memory;
  const std::uint32_t count = columns * grid_.rows, rays_per_reading = has_beam() ? Beam::rays : 1;
  const std::span<double> ranges = scratch(range_memory, std::size_t(count) * rays_per_reading);
  const std::span<ObjectId> hits = scan.hits.empty() ? std::span<ObjectId>() : scratch(hit_memory, ranges.size());
  method_->cast(set, from, ranges, hits);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t target = i / columns * grid_.columns + first + i % columns;
    Beam::Reading r{.range = ranges[i * rays_per_reading]};
    if (has_beam()) r = beam_->read(&ranges[std::size_t(i) * rays_per_reading], max_range_);
    scan.ranges[target] = r.range;
    if (!scan.hits.empty()) scan.hits[target] = hits[i * rays_per_reading + r.main_ray];
    if (!scan.incidence.empty()) scan.incidence[target] = r.incidence;
  }
}

}  // namespace muro::scanner
