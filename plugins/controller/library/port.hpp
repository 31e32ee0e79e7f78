// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "control_table.hpp"
#include "muro/connector.hpp"

namespace muro::control {

/// The names of all objects, by id.
using ObjectNames = std::shared_ptr<const std::vector<std::string>>;

/// One input or output of one robot: the scalars of one or several properties, as contiguous elements of one type.
class Port {
 public:
  /// `capacity`: largest number of elements of a list or text; 0: the number that the properties have.
  explicit Port(PortType type = PortType::number, std::uint32_t capacity = 0) : type_(type), capacity_(capacity) {}

  /// `handle`: result of Connector::read_any or write_any for `property`. [setup]
  void add(const FoundProperty& property, void* handle);
  /// Adds the target of a joint that follows the joint added at place `leader`. It reads offset + multiplier * (target
  /// of the leader). Values written to it are ignored. [setup]
  void add_follower(std::size_t leader, double multiplier, double offset);
  /// Adds objects; a port of texts gives their names. [setup]
  void add_objects(const FoundProperty& property, void* handle, ObjectNames names);
  /// Adds a text that does not change. [setup]
  void add_text(std::string text);
  /// Finds the addresses and lengths of arrays. [start]
  void resolve();

  PortType type() const { return type_; }
  /// Whether the port has no property: an optional input that the robot lacks.
  bool is_missing() const { return segments_.empty(); }
  /// Returns the number of elements that fit; only a list may have fewer. Known after resolve().
  std::uint32_t size() const { return size_; }
  /// Whether the longest text fits into the property that receives it.
  bool has_room_for_text() const { return segments_.empty() || size_ <= segments_[0].count + 1; }
  std::size_t bytes() const { return std::size_t(size_) * (type_ == PortType::text ? 1 : 8); }
  /// Returns the scalars themselves when they are one segment of the right type, so that no copy is needed; else null.
  void* direct() const { return direct_; }

  /// Reads the elements. Returns their present number.
  std::uint32_t read(void* to) const;
  /// Writes the elements; rounds to whole numbers when the property has an integer type. Returns false when a number is
  /// not finite or does not fit its property: `bad` is then its index, and nothing is written.
  bool write(const void* from, std::uint32_t& bad) const;
  /// Sets velocities, accelerations and efforts to 0, and leaves all other values.
  void rest() const;

 private:
  struct Segment {  ///< contiguous scalars, or a text
    void* handle = nullptr;
    Multiplicity multiplicity = Multiplicity::single;
    Scalar scalar = Scalar::f64;
    std::uint32_t per_element = 1;
    bool is_contact = false;
    bool rests_at_zero = false;  ///< decided by its unit
    void* data = nullptr;
    std::uint32_t count = 0;
    ObjectNames names{};
    std::string text{};
    std::int32_t leader = -1;  ///< for a follower: the segment of its leader
    double multiplier = 1, offset = 0;

    bool is_led() const { return leader >= 0; }
  };

  void resolve(Segment& s) const;
  double of_leader(const Segment& follower) const;
  std::uint32_t read_list(const Segment& s, double* to) const;
  std::uint32_t read_text(char* to) const;
  static std::size_t longest_text(const Segment& s);
  template <class T, class Write>
  bool each_of(const void* from, std::uint32_t& bad, Write write) const;

  PortType type_;
  std::uint32_t capacity_;
  std::vector<Segment> segments_;
  std::uint32_t size_ = 0;
  void* direct_ = nullptr;
};

/// Number of values of one contact in a list: point and normal in world axes, depth.
inline constexpr std::uint32_t numbers_of_contact = 7;

/// Whether 0 in this unit keeps a robot at rest: velocities, accelerations, forces and torques.
bool rests_at_zero(std::string_view unit);

/// Whether a port may read such values as a list of numbers.
inline bool is_contact(const KeyInfo& key) { return key.type->name == "muro.Contact"; }

}  // namespace muro::control
