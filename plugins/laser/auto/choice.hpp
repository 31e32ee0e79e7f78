// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "plugins/common/scanner/method.hpp"

namespace muro::laser_auto {

/// One of several methods: the one that the user names, or the one that turns out to be the fastest.
class Choice final : public scanner::Method {
 public:
  void connect(Connector& c) override;
  void prepare(std::span<const scanner::RaySet> sets) override;
  void start() override;
  void restored() override;
  void begin(const scanner::View& example, std::size_t scanners) override;
  void look() override { taken().look(); }
  void cast(std::size_t set, const scanner::View& view, std::span<double> ranges, std::span<ObjectId> hits) override {
    taken().cast(set, view, ranges, hits);
  }
  bool is_parallel() const override { return candidates_.empty() || taken().is_parallel(); }
  bool is_cheap_for_few() const override { return true; }

 private:
  struct Candidate {
    std::string_view name;
    std::unique_ptr<Method> method;
    std::uint32_t number = 0;  ///< as the state has it
    double seconds = 0;        ///< that a scan of every scanner takes
  };

  void try_all(const std::function<void(Method&)>& work);
  Candidate& find(const Method& method);
  void leave_out(std::string_view name, const std::string& reason);
  double seconds_of(Method& method, const scanner::View& example, std::size_t scanners) const;
  scanner::Method& taken() const;

  std::vector<Candidate> candidates_;
  std::vector<Out<std::uint32_t>> number_;  ///< of the method that is taken, one a scanner; 0: not known yet
  std::uint32_t measured_ = 0;              ///< what this process has found
  std::uint32_t rays_ = 0;
  Host* host_ = nullptr;
};

}  // namespace muro::laser_auto
