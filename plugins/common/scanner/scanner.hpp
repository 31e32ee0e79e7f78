// SPDX-License-Identifier: MIT
// A laser scanner but for its method: parameters, properties, the width of beams, the time that a scan takes.
#pragma once

#include <memory>
#include <optional>

#include "beam.hpp"
#include "method.hpp"
#include "muro/plugin.hpp"
#include "parameters.hpp"
#include "sweep.hpp"

namespace muro::scanner {

/// The base of the plugins laser.*. Its descriptions have the parameters and writes of parameters.hpp.
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
    std::int32_t ignored_robot = -1;
    Out<Pose> before;                           ///< where it was at the step before
    ArrayOut<double> coming, coming_incidence;  ///< of the scan that is being taken
    ArrayOut<ObjectId> coming_hits;
  };
  /// Where the readings of a scan go.
  struct Scan {
    std::span<double> ranges, incidence;
    std::span<ObjectId> hits;
  };

  void read_pattern(const Parameters& p);
  void bind(Connector& c, const Item& item);
  void make_sets(const RaySet& whole);
  std::uint32_t size() const { return grid_.columns * grid_.rows; }
  bool is_wide() const { return beam_.has_value(); }

  View view_of(const Device& d) const { return {*d.pose * mounting_, max_range_, d.ignored_robot, min_range_}; }
  bool takes_rays(std::uint64_t index) const;
  void serve(const Device& d, std::uint64_t index);
  void sweep(const Device& d, std::uint64_t index);
  /// Casts a set whose rays are those of columns from `first` on, all rows of each.
  void cast(std::size_t set, const View& view, std::uint32_t first, std::uint32_t columns, const Scan& scan);

  std::unique_ptr<Method> method_;
  std::vector<Device> devices_;
  Grid grid_;  ///< of a list: one row
  bool is_list_ = false;
  std::vector<std::size_t> set_of_;  ///< of a sweep: by column, or by step
  std::optional<Beam> beam_;
  std::optional<Sweep> sweep_;
  Pose mounting_;
  double min_range_ = 0, max_range_ = 0;
};

}  // namespace muro::scanner
