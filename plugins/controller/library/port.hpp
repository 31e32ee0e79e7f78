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
  /// `capacity`: the most elements of a list or a text; 0: as many as the properties have.
  explicit Port(PortType type = PortType::number, std::uint32_t capacity = 0) : type_(type), capacity_(capacity) {}

  /// `handle` is what Connector::read_any or write_any returned for `property`. [setup]
  void add(const FoundProperty& property, void* handle);
  /// The target of a joint that follows another one, whose own is what was added at place `leader`: it reads
  /// offset + multiplier * that, and what is written to it goes nowhere. [setup]
  void add_follower(std::size_t leader, double multiplier, double offset);
  /// Objects, which a port of texts names. [setup]
  void add_objects(const FoundProperty& property, void* handle, ObjectNames names);
  /// A text that does not change. [setup]
  void add_text(std::string text);
  /// Looks up the addresses and lengths of arrays. [start]
  void resolve();

  PortType type() const { return type_; }
  /// Whether it stands for nothing: an optional input that the robot lacks.
  bool is_missing() const { return segments_.empty(); }
  /// Number of elements that it has room for, which is all there are but in a list; known once resolved.
  std::uint32_t size() const { return size_; }
  /// Whether the longest text fits into the property that it is written to.
  bool has_room_for_text() const { return segments_.empty() || size_ <= segments_[0].count + 1; }
  std::size_t bytes() const { return std::size_t(size_) * (type_ == PortType::text ? 1 : 8); }
  /// The scalars themselves when they are one segment of the right type, so that nothing is copied; else null.
  void* direct() const { return direct_; }

  /// Returns the number of elements that there are now.
  std::uint32_t read(void* to) const;
  /// Rounds to whole numbers where the property holds such. False when a number does not fit into its property, or is
  /// not finite; `bad` is then its index, and nothing is written.
  bool write(const void* from, std::uint32_t& bad) const;
  /// Sets velocities, accelerations and efforts to 0, and leaves everything else.
  void rest() const;

 private:
  struct Segment {  ///< contiguous scalars, or a text
    void* handle = nullptr;
    Multiplicity multiplicity = Multiplicity::single;
    Scalar scalar = Scalar::f64;
    std::uint32_t per_element = 1;
    bool is_contact = false;
    bool rests_at_zero = false;  ///< by its unit
    void* data = nullptr;
    std::uint32_t count = 0;
    ObjectNames names{};
    std::string text{};
    std::int32_t leader = -1;  ///< of a joint that follows another one: the segment that moves it
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

/// The numbers of one contact in a list: point and normal in world axes, depth.
inline constexpr std::uint32_t numbers_of_contact = 7;

/// Whether 0 of this unit leaves a robot where it is: of velocities, accelerations, forces and torques.
bool rests_at_zero(std::string_view unit);

/// Whether a port may read such values as a list of numbers.
inline bool is_contact(const KeyInfo& key) { return key.type->name == "muro.Contact"; }

}  // namespace muro::control
