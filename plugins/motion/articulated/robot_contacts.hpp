// SPDX-License-Identifier: MIT
// Contacts of a robot that its motion resolves: those with scenery and with robots that no force moves.
#pragma once

#include <span>
#include <vector>

#include "kept_contact.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/contact_geometry/disc_contact.hpp"
#include "plugins/motion/common/multibody/robot_model.hpp"

namespace muro::articulated {

/// Bodies of a scene that robots can touch, by object id.
class TouchedBodies {
 public:
  /// Connects shapes and contact worlds. [setup]
  void connect(Connector& c);
  /// Connects poses, which other algorithms write. [setup]
  void connect_by_name(Connector& c);

  struct Touched {
    std::uint64_t name = 0;  ///< hash
    In<Pose> pose;           ///< not connected for scenery
    In<Twist> twist;
    In<std::uint64_t> world;  ///< keys::contact_world of its robot
    std::vector<contact_geometry::ShapeExtent> shapes;
  };
  const Touched& operator[](ObjectId id) const { return all_[index_of(id)]; }

 private:
  std::vector<Touched> all_;
};

class RobotContacts {
 public:
  RobotContacts() = default;
  /// Connects the contacts; a robot without shapes has none. [setup]
  RobotContacts(Connector& c, const RobotView& view, const multibody::RobotModel& model);

  /// Finds the contacts of the step that begins. [step, before any robot moves]
  void look_up(const TouchedBodies& bodies);
  /// Forgets earlier steps, and takes the memory that steps need. [setup]
  void start();
  /// Continues after another motion has moved the robot.
  void take_over() const {
    if (kept_) kept_.clear();
  }

  /// Returns the contacts, by body in rising order.
  std::vector<KernelContact>& contacts() { return contacts_; }
  const std::vector<KernelContact>& contacts() const { return contacts_; }
  /// See RobotState::contact_bodies and contact_faces.
  std::uint64_t bodies() const { return bodies_; }
  std::uint64_t faces() const { return faces_; }
  /// Whether there are contacts with other robots in the list.
  bool touches_robots() const { return touches_robots_; }
  /// Returns contact `i` as it is in the list.
  const Contact& contact(std::size_t i) const { return (*list_)[places_[i].in_list]; }
  /// Contacts of one loaded link. They follow each other.
  struct OfLink {
    std::uint32_t link = 0, end = 0;  ///< `end`: number of the first contact of the next link
  };
  std::span<const OfLink> of_links() const { return of_links_; }

 private:
  static constexpr std::uint64_t no_revision = ~std::uint64_t{0};

  void find(const TouchedBodies& bodies);
  void sort_by_body();
  void find_bodies();
  void find_links();
  void keep_what_lasts(const TouchedBodies& bodies);
  void find_joins();
  void look_at_others(const TouchedBodies& bodies);

  struct LinkPlace {
    ObjectId object = no_object;
    std::uint32_t loaded_link = 0;  ///< index in RobotModel
    int body = 0;
    Quat orientation = Quat::Identity();  ///< orientation in the body's frame
  };
  const LinkPlace* place_of(ObjectId object) const;

  struct Place {
    std::uint32_t in_list = 0;
    std::uint32_t link = 0;  ///< loaded link
  };

  ListIn<Contact> list_;
  ListOut<KeptContact> kept_;
  std::vector<LinkPlace> link_places_;
  std::uint64_t revision_ = no_revision;  ///< revision of the list when contacts were found
  std::size_t length_ = 0;                ///< length of the list when contacts were found
  bool touches_robots_ = false;
  std::vector<KernelContact> contacts_;
  std::uint64_t bodies_ = 0, faces_ = 0;
  std::vector<ContactExtent> extents_;  ///< one per contact
  std::vector<Place> places_;           ///< one per contact
  std::vector<OfLink> of_links_;
  std::vector<Twist> others_;  ///< one per contact: velocity of what it touches, at the point
  std::vector<KeptContact> before_;
};

}  // namespace muro::articulated
