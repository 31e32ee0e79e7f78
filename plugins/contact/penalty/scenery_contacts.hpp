// SPDX-License-Identifier: MIT
// Contacts with static scenery, of robots that touch nothing that moves. Each robot is computed independently: by
// itself, or in a SIMD lane beside similar ones.
#pragma once

#include <array>
#include <mutex>
#include <vector>

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
  /// By index in Bodies::robots: 1 for those that the last apply_forces() left out.
  const std::vector<std::uint8_t>& remaining() const { return remaining_; }

 private:
  /// What does not change while a contact lasts.
  struct Identity {
    std::uint64_t bodies = 0, shapes = 0, pair = 0;
  };
  /// What is known of a robot and its contacts from earlier steps, so that the same contacts are not analysed again.
  /// Results depend on contacts and anchors alone.
  struct KnownRobot {
    ListIn<Contact> list;
    ListOut<FrictionAnchor> anchors;
    KernelRobot view;            ///< without contacts and anchors
    std::uint64_t revision = 0;  ///< of the list of contacts, when it was last seen
    std::uint32_t contacts = 0;  ///< known
    std::uint32_t layout = 0;    ///< in layouts_; robots of one layout and mass share SIMD lanes
    std::uint32_t mass = 0;
    const std::uint64_t* world = nullptr;  ///< see keys::contact_world
    const double* lag = nullptr;           ///< see keys::twist_lag; null: forces move its bodies one by one
    bool only_scenery = false;
    bool one_model = false;      ///< it touches one object of the scenery, and its layout is known
    bool anchors_match = false;  ///< the robot has an anchor for each contact, in their order
    bool is_parting = false;     ///< some anchor has an overlap
  };
  using Identities = std::array<Identity, max_contacts>;
  /// Robots of one layout and mass, until they fill the SIMD lanes.
  struct Queue {
    std::uint32_t count = 0;
    std::uint32_t robots[8];
    KernelRobot views[8];
  };
  struct Queues;
  struct SpringBatch;

  void forget_turning(std::uint32_t robot) const;
  void fetch(std::uint32_t robot) const;
  bool knows(std::uint32_t robot, std::span<const Contact> now) const;
  void apply_forces_on(const StepContext& context, std::uint32_t robot, Queues& queues);
  void analyse(std::uint32_t robot, std::span<const Contact> contacts);
  Queue& queue_for(const StepContext& context, const KnownRobot& robot, Queues& queues);
  void process_single(const StepContext& context, std::uint32_t robot);
  SpringBatch springs_of(std::uint32_t robot, std::span<const Contact> contacts, const Identities& identities) const;
  void apply_springs(const StepContext& context, std::uint32_t robot, std::span<const Contact> contacts,
                     const SpringBatch& springs, FrictionAnchor* written) const;
  void find_match(std::uint32_t robot);
  void note_parting(KnownRobot& known) const;
  std::uint32_t find_impacts(const StepContext& context, std::uint32_t robot, TimeOfImpact* times) const;
  void process_impacts(const StepContext& context, std::uint32_t robot, std::uint32_t which, const TimeOfImpact* times);
  void apply_impacts(const StepContext& context, std::uint32_t robot, std::span<const Contact> contacts,
                     const TimeOfImpact* times) const;
  void process_queue(const StepContext& context, Queue& queue);
  ContactLayout layout_of(std::uint32_t robot, std::span<const Contact> contacts, const Identities& identities) const;
  std::uint32_t number_of(const ContactLayout& layout);
  int sort_into_patches(std::span<const Contact> contacts, std::uint8_t* patch_of) const;

  static constexpr std::uint32_t unknown_layout = 0xffffffffu;
  static constexpr std::size_t max_layouts = 256;

  const Bodies& bodies_;
  const SceneryKernels& kernels_;
  std::vector<KnownRobot> robots_;      ///< as Bodies::robots
  std::vector<Identities> identities_;  ///< of the contacts that they know
  std::vector<std::uint8_t> remaining_;
  std::mutex mutex_;  ///< of layouts_, for writers
  std::vector<ContactLayout>
      layouts_;  ///< all different; never more than max_layouts, so their addresses do not change
};

}  // namespace muro::penalty
