// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene_names.hpp"
#include "values.hpp"

namespace muro::jsonrpc {

/// Properties whose values a client gets repeatedly.
class Subscription {
 public:
  struct Timing {
    bool is_on_change = false;
    double rate = 0;          ///< rate if not on change, Hz of simulated time
    std::int64_t period = 0;  ///< least time between two updates if on change, ns
    Encoding encoding = Encoding::text;
  };
  /// `numbers`: total number of values in the properties.
  Subscription(std::uint32_t number, std::vector<PropertyName> properties, std::size_t numbers, Timing timing)
      : number_(number), properties_(std::move(properties)), numbers_(numbers), timing_(timing) {}

  std::uint32_t number() const { return number_; }
  std::size_t numbers() const { return numbers_; }
  /// Returns the notification for this instant. Returns null when none is due, or when there is no room: then the
  /// update is lost and costs nothing. `at_step`: whether this is a step, so that rates count.
  Reply update(const SceneNames& scene, std::int64_t time, bool at_step, bool has_room);
  /// Counts a lost update; the next one reports the count. A lost change is sent when there is room again.
  void was_lost() { lost_ += is_repeated_ ? 0 : 1; }
  void was_sent() { lost_ = 0; }
  /// Handles a jump of time: rates count from here.
  void begin_anew() { last_time_ = never; }

 private:
  static constexpr std::int64_t never = -1;
  bool is_due(std::int64_t time, bool at_step);
  bool has_changed(const SceneNames& scene);

  std::uint32_t number_;
  std::vector<PropertyName> properties_;
  std::size_t numbers_;
  Timing timing_;
  std::int64_t begin_ = 0;          ///< begin of the rate, ns
  std::int64_t last_time_ = never;  ///< time of the last update, ns
  std::uint64_t next_ = 0;          ///< number of the next update at the rate
  std::uint64_t lost_ = 0;
  bool is_repeated_ = false;  ///< whether the last update reported a change that had been lost before
  std::string last_bytes_;    ///< all properties in the last check for changes
};

}  // namespace muro::jsonrpc
