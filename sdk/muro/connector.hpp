// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "muro/extension.hpp"
#include "muro/handles.hpp"
#include "muro/key.hpp"
#include "muro/parameter.hpp"
#include "muro/robot.hpp"

namespace muro {

/// The unit that an algorithm serves: a robot (or none, for the scene) and the object of that robot that the scenario
/// names: the base for a motion, the sensor's own object for a sensor. May grow at its end.
struct Item {
  const RobotView* robot = nullptr;
  ObjectId object = world_object;
  /// Index of this algorithm among the motions that the robot lists: it moves the robot while `motion.level` has this
  /// value.
  std::uint32_t level = 0;
};

/// Use of a property by the steps of an algorithm.
enum class Access : std::uint8_t {
  read,
  write,
  accumulate,  ///< adds one contribution to a sum
  read_sum,    ///< reads all contributions
};

/// Whether a request creates the property, and its part in a snapshot.
enum class Creation : std::uint8_t {
  none,     ///< another algorithm creates it
  state,    ///< part of the state: saved, restored, hashed
  derived,  ///< can be computed again from the state
};

/// Use of a property by an algorithm.
struct Usage {
  Access access = Access::read;
  Creation creation = Creation::none;
  bool is_optional = false;  ///< no error when nobody reads what is written

  bool operator==(const Usage&) const = default;
};

/// The usages that the functions of Connector stand for.
namespace usage {
inline constexpr Usage read{Access::read};                    ///< a constant, or written by another algorithm
inline constexpr Usage input{Access::read, Creation::state};  ///< has a value even if nobody writes it
inline constexpr Usage variable{Access::write, Creation::state};
inline constexpr Usage derived{Access::write, Creation::derived};
inline constexpr Usage write{Access::write};  ///< a command: its reader creates it
inline constexpr Usage optional_output{Access::write, Creation::none, true};
inline constexpr Usage accumulate{Access::accumulate, Creation::derived};
inline constexpr Usage read_sum{Access::read_sum};
}  // namespace usage

/// Whether a property is one value, an array of a fixed length or a list of a changing length.
enum class Multiplicity : std::uint8_t { single, array, list };

/// A property found by its name at set-up. May grow at its end.
struct FoundProperty {
  ObjectId object = no_object;
  const KeyInfo* key = nullptr;
  Multiplicity multiplicity = Multiplicity::single;
  std::uint32_t count = 1;   ///< elements; 0 when not known yet, or a list
  bool is_constant = false;  ///< given at set-up: no algorithm writes it
  bool is_sum = false;       ///< several algorithms add to it: see Connector::read_sum
};

enum class LogLevel : std::uint8_t { debug, info, warning, error };

/// Elements of a constant array: Rows for types that may grow (Shape), else a span.
template <class T>
using ConstantArray = std::conditional_t<value_type<T>.grows, Rows<T>, std::span<const T>>;

/// Services of the host for algorithms, at any time. [any thread]
class Host {
 public:
  virtual void log(LogLevel level, std::string_view text) noexcept = 0;
  /// Returns the extension of this name, version and layout, or null. Logs the reason when the host has another
  /// version, or one with another layout. [setup]
  virtual void* find_extension(const ExtensionId&) noexcept { return nullptr; }

 protected:
  ~Host() = default;
};

/// Connects one instance of an algorithm to the data of the simulation. [setup]
///
/// Requests may name properties that do not exist yet, so every request succeeds here. When all algorithms are
/// connected the host reports what is missing, doubled, or of another type, unit or role, with the names of all
/// involved. Handles may be read from `start()` on.
class Connector {
 public:
  // --- what this instance serves
  virtual Rows<Item> items() const noexcept = 0;
  virtual const Parameters& parameters() const noexcept = 0;
  /// Returns the parameters of item `i`. They differ among the robots of a world only, see Capability::world.
  virtual const Parameters& parameters_of(std::uint32_t i) const noexcept = 0;
  virtual Host& host() const noexcept = 0;
  /// Returns the key of the random numbers of item `i`, which depends on the names of robot and subsystem only.
  virtual std::uint64_t random_key(std::uint32_t i) const noexcept = 0;
  /// Rate of the steps of this instance, Hz; 0: on demand, with the period of its reader.
  virtual double rate() const noexcept = 0;
  /// Returns a path of the scenario (relative to its file) as an absolute path. Valid until connect returns.
  virtual std::string_view resolve_path(std::string_view path) const noexcept = 0;

  // --- the world
  virtual std::uint32_t object_count() const noexcept = 0;
  virtual std::string_view object_name(ObjectId object) const noexcept = 0;
  /// Returns the object of this name, "robot/part", or no_object.
  virtual ObjectId find_object(std::string_view name) const noexcept = 0;
  virtual std::span<const RobotView* const> robots() const noexcept = 0;
  /// Returns the robot that the object is part of; no_robot for scenery.
  virtual RobotId robot_of(ObjectId object) const noexcept = 0;
  virtual std::string_view text(TextId id) const noexcept = 0;
  /// Returns the properties of one object that exist so far, in order of creation. In `connect_by_name` these are the
  /// properties that all algorithms have made in `connect`, and earlier kinds in `connect_by_name`. Valid until the
  /// next call.
  virtual Rows<FoundProperty> properties(ObjectId object) const noexcept = 0;
  /// Whether an algorithm that is connected so far uses the property in this way. In `connect` the answer depends on
  /// the order in which kinds connect (see kind_infos). In `connect_by_name` all algorithms have connected, and the
  /// bindings by name of earlier kinds are known (see by_name_order): motions know what controllers write and read.
  virtual bool is_used(ObjectId object, const KeyInfo& key, Usage usage) const noexcept = 0;

  // --- constants, readable at once
  template <class T>
  std::optional<T> constant(ObjectId object, const Key<T>& key) const {
    const ArrayHeader found = constant_raw(object, key);
    if (!found.data) return std::nullopt;
    return *static_cast<const T*>(found.data);
  }
  template <class T>
  ConstantArray<T> constant_array(ObjectId object, const Key<T>& key) const {
    const ArrayHeader found = constant_raw(object, key);
    const auto* const first = static_cast<const T*>(found.data);
    if constexpr (value_type<T>.grows)
      return Rows<T>(first, found.size, found.element_size);
    else
      return std::span<const T>(first, found.size);
  }
  /// Adds a constant to an object of this instance's robot or sensor.
  template <class T>
  void set(ObjectId object, const Key<T>& key, const T& value) {
    set_raw(object, key, &value);
  }

  // --- reading
  template <class T>
  In<T> read(ObjectId object, const Key<T>& key) {
    return In<T>(bind(object, key, usage::read, Multiplicity::single, 1, nullptr));
  }
  template <class T>
  In<T> input(ObjectId object, const Key<T>& key, const T& default_value) {
    return In<T>(bind(object, key, usage::input, Multiplicity::single, 1, &default_value));
  }
  template <class T>
  ArrayIn<T> read_array(ObjectId object, const Key<T>& key) {
    return ArrayIn<T>(bind(object, key, usage::read, Multiplicity::array, 0, nullptr));
  }
  template <class T>
  ListIn<T> read_list(ObjectId object, const Key<T>& key) {
    return ListIn<T>(bind(object, key, usage::read, Multiplicity::list, 0, nullptr));
  }
  template <class T>
  SumIn<T> read_sum(ObjectId object, const Key<T>& key) {
    return SumIn<T>(bind(object, key, usage::read_sum, Multiplicity::single, 1, nullptr));
  }
  /// Returns the address of the value, of the ArrayHeader or ListHeader, or of the SumHeader of a sum: for recorders
  /// and controllers, which learn the type when they run.
  const void* read_any(const FoundProperty& p) {
    return bind(p.object, *p.key, p.is_sum ? usage::read_sum : usage::read, p.multiplicity, p.count, nullptr);
  }

  // --- writing
  template <class T>
  Out<T> variable(ObjectId object, const Key<T>& key, const T& initial) {
    return Out<T>(bind(object, key, usage::variable, Multiplicity::single, 1, &initial));
  }
  template <class T>
  ArrayOut<T> variable_array(ObjectId object, const Key<T>& key, std::uint32_t count) {
    return ArrayOut<T>(bind(object, key, usage::variable, Multiplicity::array, count, nullptr));
  }
  template <class T>
  ListOut<T> variable_list(ObjectId object, const Key<T>& key) {
    return ListOut<T>(bind(object, key, usage::variable, Multiplicity::list, 0, nullptr));
  }
  template <class T>
  Out<T> derived(ObjectId object, const Key<T>& key) {
    return bind_default<T>(object, key, usage::derived);
  }
  template <class T>
  ArrayOut<T> derived_array(ObjectId object, const Key<T>& key, std::uint32_t count) {
    return ArrayOut<T>(bind(object, key, usage::derived, Multiplicity::array, count, nullptr));
  }
  template <class T>
  ListOut<T> derived_list(ObjectId object, const Key<T>& key) {
    return ListOut<T>(bind(object, key, usage::derived, Multiplicity::list, 0, nullptr));
  }
  template <class T>
  Out<T> write(ObjectId object, const Key<T>& key) {
    return bind_default<T>(object, key, usage::write);
  }
  template <class T>
  Out<T> optional_output(ObjectId object, const Key<T>& key) {
    return bind_default<T>(object, key, usage::optional_output);
  }
  template <class T>
  Sum<T> accumulate(ObjectId object, const Key<T>& key) {
    return Sum<T>(bind(object, key, usage::accumulate, Multiplicity::single, 1, nullptr));
  }
  void* write_any(const FoundProperty& p) {
    return bind(p.object, *p.key, usage::write, p.multiplicity, p.count, nullptr);
  }
  /// Returns `size` bytes of state on `object` under a name of their own: state that only its owner understands.
  virtual void* state_block(ObjectId object, std::string_view name, std::uint32_t size) noexcept = 0;

 protected:
  virtual void* bind(ObjectId object, const KeyInfo& key, Usage usage, Multiplicity multiplicity, std::uint32_t count,
                     const void* initial) noexcept = 0;
  virtual ArrayHeader constant_raw(ObjectId object, const KeyInfo& key) const noexcept = 0;
  virtual void set_raw(ObjectId object, const KeyInfo& key, const void* value) noexcept = 0;
  ~Connector() = default;

 private:
  /// The value is that of a default-constructed T until somebody gives one.
  template <class T>
  Out<T> bind_default(ObjectId object, const Key<T>& key, Usage usage) {
    const T value{};
    return Out<T>(bind(object, key, usage, Multiplicity::single, 1, &value));
  }
};

}  // namespace muro
