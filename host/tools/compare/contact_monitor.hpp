// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/scenario.hpp"
#include "muro/scene.hpp"

namespace muro::host {

/// Detects contacts of robots from outside, in the same way for all motions.
///
/// Engines report contacts in ways that cannot be compared: a list of points, the sum of forces on a body, nothing. So
/// the monitor copies the bodies and the scenery of the monitored scene into a scene of its own. There it moves the
/// bodies at regular intervals to their present poses, and collision detection finds which of them touch. Contacts with
/// the ground do not count: those with planes, and those that exist at the first update.
class ContactMonitor {
 public:
  static constexpr std::int64_t period = 10'000'000;  ///< ns between updates
  static constexpr double margin = 0.001;             ///< m: bodies that are closer than this touch
  static constexpr double separation = 0.1;           ///< s: a pair that is apart for longer begins a new contact

  /// Counts contacts of those of `robots` (numbers) that forces move. `algorithms`: the algorithms of the scenario; its
  /// collision detection and scene index are used, or else the default ones. Throws SetupError when there are none.
  ContactMonitor(Simulation& monitored, const std::vector<std::uint32_t>& robots,
                 const std::vector<Subsystem>& algorithms);

  /// To be called every `period`.
  void update();

  /// Whether there is a robot with contacts that count.
  bool is_active() const { return active_; }
  std::size_t contacts() const { return contacts_; }                      ///< those that have begun, by pairs of bodies
  std::optional<double> first_contact() const { return first_contact_; }  ///< s

 private:
  /// Number of a robot and the touched object: another robot, or an object of the scenery.
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  struct Body {
    std::uint32_t robot;
    const Pose* monitored;
    Pose* copy = nullptr;
  };

  void add_scenery();
  void add_bodies();
  template <class Owner>
  Shape copy_of(Shape shape, double grown_by, Owner& owner) const;
  void add_collision_detection(const std::vector<Subsystem>& algorithms);
  void add_contact(std::uint32_t body, const Contact& contact, double now);
  void add_contact(const Pair& pair, double now);

  Simulation& monitored_;
  Simulation scene_;
  std::vector<TaskId> tasks_;
  std::vector<bool> counts_;  ///< by number of the robot
  bool active_ = false;
  std::vector<Body> bodies_;             ///< by number of the copy
  std::map<Pair, double> last_contact_;  ///< s
  std::set<Pair> initial_contacts_;
  bool updated_ = false;
  std::size_t contacts_ = 0;
  std::optional<double> first_contact_;
};

}  // namespace muro::host
