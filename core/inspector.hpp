// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "core/schedule/scheduler.hpp"
#include "core/world.hpp"
#include "muro/ext/inspection.hpp"

namespace muro {

/// Shows a simulation to algorithms that run alone.
class Inspector final : public Inspection {
 public:
  Inspector(const World& world, const Scheduler& scheduler) : world_(world), scheduler_(scheduler) {}

  std::span<const LiveProperty> properties(ObjectId object) noexcept override;
  std::span<const LiveCost> costs() noexcept override;
  std::uint32_t object_count() const noexcept override { return world_.object_count(); }
  std::string_view object_name(ObjectId object) const noexcept override;
  std::string_view text(TextId id) const noexcept override;
  void stop() noexcept override { stopped_ = true; }
  bool is_stopping() const noexcept override { return stopped_ || (stop_ && stop_()); }

  /// Sets a function that says whether something else wants to end the run that now begins.
  void set_stop(std::function<bool()> stop) { stop_ = std::move(stop); }
  bool stopped() const { return stopped_; }

 private:
  const World& world_;
  const Scheduler& scheduler_;
  std::vector<LiveProperty> properties_;
  std::deque<KeyInfo> keys_;  ///< with the names that the object uses for them
  std::vector<LiveCost> costs_;
  std::function<bool()> stop_;
  bool stopped_ = false;
};

}  // namespace muro
