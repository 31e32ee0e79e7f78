// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "plugins/laser/common/scanner/method.hpp"

namespace muro::laser_auto {

/// Uses one of several methods: the one that the user names, or the fastest one as measured at the start.
class MethodSelector final : public scanner::Method {
 public:
  void connect(Connector& c) override;
  void prepare(std::span<const scanner::RaySet> sets) override;
  void start() override;
  void restored() override;
  void begin_step(const scanner::Viewpoint& example, std::size_t scanners) override;
  void update() override { selected().update(); }
  void cast(std::size_t set, const scanner::Viewpoint& from, std::span<double> ranges,
            std::span<ObjectId> hits) override {
    selected().cast(set, from, ranges, hits);
  }
  bool is_parallel() const override { return candidates_.empty() || selected().is_parallel(); }
  bool is_cheap_for_few_rays() const override { return true; }

 private:
  struct Candidate {
    std::string_view name;
    std::unique_ptr<Method> method;
    std::uint32_t number = 0;  ///< value of laser.method
    double seconds = 0;        ///< time of one scan by each scanner
  };

  void exclude_failing(const std::function<void(Method&)>& work);
  Candidate& find(const Method& method);
  void exclude(std::string_view name, const std::string& reason);
  double seconds_of(Method& method, const scanner::Viewpoint& example, std::size_t scanners) const;
  scanner::Method& selected() const;

  std::vector<Candidate> candidates_;
  std::vector<Out<std::uint32_t>> method_;  ///< laser.method of each scanner
  std::uint32_t fastest_ = 0;               ///< number of the method, as measured by this process; 0: not measured yet
  std::uint32_t rays_ = 0;
  Host* host_ = nullptr;
};

}  // namespace muro::laser_auto
