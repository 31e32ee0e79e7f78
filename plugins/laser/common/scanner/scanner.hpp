// SPDX-License-Identifier: MIT
// Common part of laser scanners of all methods: parameters, properties, the width of beams, the sweep of a scan.
#pragma once

#include <memory>
#include <optional>

#include "beam.hpp"
#include "method.hpp"
#include "muro/plugin.hpp"
#include "parameters.hpp"
#include "sweep.hpp"

namespace muro::scanner {

/// Base of the plugins laser.*. Their descriptions list the parameters and writes of parameters.hpp.
class Scanner : public Algorithm {
 public:
  explicit Scanner(std::unique_ptr<Method> method) : method_(std::move(method)) {}

  void connect(Connector& c) override;
  void start() override { method_->start(); }
  void restored() override { method_->restored(); }
  std::span<const Phase> phases() const override;
  void step(const Step& step, Range range) override;

 private:
  struct Device {
    In<Pose> pose;
    ArrayOut<double> ranges, incidence;
    ArrayOut<ObjectId> hits;
    RobotId ignored_robot = no_robot;
    Out<Pose> previous_pose;                         ///< at the step before
    ArrayOut<double> sweep_ranges, sweep_incidence;  ///< of the scan in progress
    ArrayOut<ObjectId> sweep_hits;
  };
  /// Destination of the readings of a scan.
  struct Scan {
    std::span<double> ranges, incidence;
    std::span<ObjectId> hits;
  };

  void read_pattern(const Parameters& p);
  void bind(Connector& c, const Item& item);
  void make_sets(const RaySet& full);
  std::uint32_t size() const { return grid_.columns * grid_.rows; }
  bool has_beam() const { return beam_.has_value(); }

  Viewpoint viewpoint_of(const Device& d) const {
    return {*d.pose * mounting_, max_range_, d.ignored_robot, min_range_};
  }
  bool casts_rays_in(std::uint64_t step) const;
  void serve(const Device& d, std::uint64_t index);
  void sweep(const Device& d, std::uint64_t index);
  /// Casts a set that has the rays of `columns` columns from `first` on, with all rows of each column.
  void cast(std::size_t set, const Viewpoint& from, std::uint32_t first, std::uint32_t columns, const Scan& scan);

  std::unique_ptr<Method> method_;
  std::vector<Device> devices_;
  Grid grid_;  ///< a list of directions is one row
  bool is_list_ = false;
  std::vector<std::size_t> sets_of_steps_;  ///< number of the set of each step, if a sweep has one set for each step
  std::optional<Beam> beam_;
  std::optional<Sweep> sweep_;
  Pose mounting_;
  double min_range_ = 0, max_range_ = 0;
};

}  // namespace muro::scanner
