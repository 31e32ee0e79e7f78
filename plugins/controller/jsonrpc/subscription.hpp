// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene_names.hpp"
#include "values.hpp"

namespace muro::jsonrpc {

/// Properties whose values a client is sent again and again.
class Subscription {
 public:
  struct Timing {
    bool is_on_change = false;
    double rate = 0;          ///< Hz of simulated time, of those that are not on change
    std::int64_t period = 0;  ///< ns, the least between two updates, of those on change
    Encoding encoding = Encoding::text;
  };
  /// `numbers`: that the properties have together.
  Subscription(std::uint32_t number, std::vector<PropertyName> properties, std::size_t numbers, Timing timing)
      : number_(number), properties_(std::move(properties)), numbers_(numbers), timing_(timing) {}

  std::uint32_t number() const { return number_; }
  std::size_t numbers() const { return numbers_; }
  /// The notification for this instant, or null where none is due, or where there is no room for it: then it is lost,
  /// and costs nothing. `at_step`: time goes on, and rates count.
  Reply update(const SceneNames& scene, std::int64_t time, bool at_step, bool has_room);
  /// It was not sent: the next one tells how many were lost. A change is told again as soon as there is room.
  void was_lost() { lost_ += is_repeated_ ? 0 : 1; }
  void was_sent() { lost_ = 0; }
  /// Time has jumped: rates count from here.
  void begin_anew() { last_time_ = never; }

 private:
  static constexpr std::int64_t never = -1;
  bool is_due(std::int64_t time, bool at_step);
  bool has_changed(const SceneNames& scene);

  std::uint32_t number_;
  std::vector<PropertyName> properties_;
  std::size_t numbers_;
  Timing timing_;
  std::int64_t begin_ = 0;          ///< ns, from which the rate counts
  std::int64_t last_time_ = never;  ///< ns, of the last update
  std::uint64_t next_ = 0;          ///< which update at the rate is next
  std::uint64_t lost_ = 0;
  bool is_repeated_ = false;  ///< the last update told of a change that had been lost before
  std::string last_bytes_;    ///< of all properties, as they were told last
};

}  // namespace muro::jsonrpc
