// SPDX-License-Identifier: MIT
// Contacts with static scenery, of robots that touch nothing that moves. Each robot is computed independently: alone,
// or in a SIMD lane beside similar ones.
#pragma once

#include <array>
#include <vector>

#include "contact_patterns.hpp"
#include "impact.hpp"
#include "scenery_kernel.hpp"

namespace muro::penalty {

class SceneryContacts {
 public:
  explicit SceneryContacts(const Bodies& bodies);
  /// Clears what is known of earlier steps; call it before the first step and when the state was changed from outside.
  void start();
  /// Applies the forces on those robots of a block (robot numbers) that touch only scenery, or nothing. Any thread.
  void apply_forces(const StepContext& context, Range block);
  /// Flags by index in Bodies::robots: 1 for robots that the last apply_forces() left out.
  const std::vector<std::uint8_t>& remaining() const { return remaining_; }

 private:
  /// Data that do not change while a contact lasts.
  struct Identity {
    std::uint64_t bodies = 0, shapes = 0, pair = 0;
  };
  using Identities = std::array<Identity, max_contacts>;
  using KernelContacts = std::array<KernelContact, max_contacts>;
  /// Data about a robot and its contacts from earlier steps, so that the same contacts are not analysed again. Results
  /// depend on contacts and anchors alone.
  struct alignas(64) KnownRobot {
    ListIn<Contact> list;
    Anchors anchors;
    LastingContacts lasting;               ///< `count`: number of known contacts
    std::uint64_t revision = 0;            ///< revision of the list of contacts, when it was last seen
    const std::uint64_t* world = nullptr;  ///< see keys::contact_world
    const double* lag = nullptr;           ///< see keys::twist_lag; null: forces move its bodies one by one
    std::uint64_t robots_revision = ~std::uint64_t{0};  ///< of the list, when it was last searched for robots
    std::uint32_t robots_length = 0;                    ///< length of the list at that time
    bool touches_robots : 1 = false;
    bool is_one_link : 1 = false, may_resist_turning : 1 = false;
    bool is_clear : 1 = false;  ///< no wrench acts on it, and it has no anchors
    bool only_scenery : 1 = false;
    bool anchors_match : 1 = false;  ///< the robot has an anchor for each contact, in their order
    bool is_parting : 1 = false;     ///< some anchor has an overlap
    bool was_in_impact : 1 = false;  ///< some anchor is that of an impact
  };
  static_assert(sizeof(KnownRobot) == 128);  // two cache lines
  /// Robots with similar contacts, collected until they fill the SIMD lanes.
  struct Queue {
    std::uint32_t count;
    std::uint32_t robots[8];
  };
  struct Plan;
  struct Queues;

  bool touches_robots(std::uint32_t robot, std::span<const Contact> contacts);
  void forget_turning(std::uint32_t robot) const;
  bool knows(std::uint32_t robot, std::span<const Contact> now) const;
  void apply_forces_on(const StepContext& context, std::uint32_t robot, Queues& queues);
  void analyse(std::uint32_t robot, std::span<const Contact> contacts);
  void find_match(std::uint32_t robot);
  bool is_one_patch(std::span<const Contact> contacts) const;
  void enqueue_changed(const StepContext& context, std::uint32_t robot, Queues& queues);
  void process_rest(const StepContext& context, Queues& queues);
  void process_queue(const StepContext& context, Queue& queue);
  void process_changed(const StepContext& context, Queues& queues);
  void process_single(const StepContext& context, std::uint32_t robot);
  void make_plan(std::uint32_t robot, std::uint32_t which, Plan& plan) const;
  KernelRobot view_of(std::uint32_t robot, const Plan& plan) const;
  KernelBatch batch_of(const StepContext& context) const;
  bool find_overlaps(const StepContext& context, std::uint32_t robot, const Plan& plan, double* overlaps) const;
  void apply_springs(const StepContext& context, std::uint32_t robot, const Plan& plan, const double* overlaps) const;
  std::uint32_t find_impacts(const StepContext& context, std::uint32_t robot, TimeOfImpact* times) const;
  void apply_impacts(const StepContext& context, std::uint32_t robot, std::uint32_t which,
                     const TimeOfImpact* times) const;

  const Bodies& bodies_;
  const SceneryKernels& kernels_;
  std::vector<KnownRobot> robots_;        ///< in the order of Bodies::robots
  std::vector<Identities> identities_;    ///< identities of the contacts that they know
  std::vector<KernelContacts> contacts_;  ///< for the kernel: the contacts that they know
  ContactPatterns patterns_;              ///< patterns of contacts_ that several robots have
  std::vector<std::uint8_t> remaining_;
};

}  // namespace muro::penalty
