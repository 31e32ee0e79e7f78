// SPDX-License-Identifier: MIT
// Robots that touch nothing that moves. Each is served for itself: alone, or in a lane with others like it.
#pragma once

#include <array>
#include <mutex>
#include <vector>

#include "bodies.hpp"
#include "standing.hpp"

namespace muro::penalty {

class Standings {
 public:
  explicit Standings(const Bodies& bodies);
  /// Forgets what robots stood on; call it before the first step and when the state was changed from outside.
  void start();
  /// Serves those robots of a block (robot numbers) that touch only scenery, or nothing. Any thread.
  void push(const Moment& moment, Range block);
  /// By place in Bodies::robots: 1 for those that the last push() did not serve.
  const std::vector<std::uint8_t>& left() const { return left_; }

 private:
  /// What of a contact does not change while it lasts, as long as nothing comes or goes.
  struct Identity {
    std::uint64_t bodies = 0, shapes = 0, pair = 0;
  };
  /// What a robot stood on in the step before. It saves looking at the same contacts again; how a robot is served
  /// follows from its contacts and grips alone.
  struct Standing {
    ListIn<Contact> list;
    ListOut<Grip> grips;
    StandingRobot view;          ///< without contacts and grips
    std::uint64_t revision = 0;  ///< of the list of contacts, when it was last seen
    std::uint32_t contacts = 0;  ///< known
    std::uint32_t layout = 0;    ///< in layouts_; robots of one layout and mass share lanes
    std::uint32_t mass = 0;
    const std::uint64_t* world = nullptr;  ///< see keys::contact_world
    const double* lag = nullptr;           ///< see keys::twist_lag; null: forces move its bodies one by one
    bool only_scenery = false;
    bool in_lanes = false;     ///< one piece of scenery, and a layout that is known
    bool springs_fit = false;  ///< the robot has a spring for each contact, in their order
  };
  using Identities = std::array<Identity, most_contacts>;
  /// Robots that wait until they fill a lane.
  struct Queue {
    std::uint32_t count = 0;
    std::uint32_t robots[8];
    StandingRobot views[8];
  };
  struct Queues;

  void fetch(std::uint32_t robot) const;
  bool knows(std::uint32_t robot, std::span<const Contact> now) const;
  void push_one(const Moment& moment, std::uint32_t robot, Queues& queues);
  void learn(std::uint32_t robot, std::span<const Contact> contacts);
  void push_alone(const Moment& moment, std::uint32_t robot);
  void push_queue(const Moment& moment, Queue& queue);
  Layout lay_out(std::uint32_t robot, std::span<const Contact> contacts) const;
  std::uint32_t number_of(const Layout& layout);
  int sort_into_patches(std::span<const Contact> contacts, std::uint8_t* patch_of) const;

  static constexpr std::uint32_t unknown_layout = 0xffffffffu;
  static constexpr std::size_t most_layouts = 256;

  const Bodies& bodies_;
  const StandingKernels& kernels_;
  std::vector<Standing> standings_;     ///< as Bodies::robots
  std::vector<Identities> identities_;  ///< of the contacts that they know
  std::vector<std::uint8_t> left_;
  std::mutex mutex_;             ///< of those who learn a layout
  std::vector<Layout> layouts_;  ///< all different; never more than most_layouts, so they stay where they are
};

}  // namespace muro::penalty
