// SPDX-License-Identifier: MIT
// What remote controls, windows and referees may ask of a run: pause and speed, reset, snapshots, placing.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// Told when a request has been carried out. [between steps]
class RequestDone {
 public:
  /// `problem`: why it was refused; empty: it is done.
  virtual void done(std::uint64_t ticket, std::string_view problem) noexcept = 0;

 protected:
  ~RequestDone() = default;
};

/// Called again and again while a run is paused, so that who paused it can also let it go on. [between steps]
class PauseAttendant {
 public:
  virtual void attend() noexcept = 0;

 protected:
  ~PauseAttendant() = default;
};

/// Where a robot, or an object that moves, is put.
struct Placement {
  ObjectId object = no_object;  ///< the base of a robot, or an object that moves by itself
  Pose pose{};                  ///< in the world
  Twist twist{};                ///< of the base, in the world; 0 unless it is to be thrown
  bool is_forced = false;       ///< also where it overlaps something
};

/// An extension of hosts, version 1: for algorithms, in their steps, and for pause attendants.
///
/// Requests are carried out when the present instant is complete. Those of pause attendants and of algorithms that run
/// alone come from outside: they keep their order, and are recorded and replayed as external inputs. Those of other
/// algorithms follow, in an order of their own; equal ones of one instant are one. `done` may be null.
class RunControl {
 public:
  virtual bool is_paused() const noexcept = 0;
  /// Time stands after the present instant, or goes on.
  virtual void set_paused(bool paused) noexcept = 0;
  /// Goes on for `ns` of simulated time, then pauses.
  virtual void step_for(std::int64_t ns) noexcept = 0;
  /// Simulated seconds in a second; 0: as fast as possible.
  virtual double speed() const noexcept = 0;
  virtual void set_speed(double factor) noexcept = 0;
  virtual void add_attendant(PauseAttendant& attendant) noexcept = 0;     ///< [setup]
  virtual void remove_attendant(PauseAttendant& attendant) noexcept = 0;  ///< [between steps]

  virtual void place(const Placement& placement, std::uint64_t ticket, RequestDone* done) noexcept = 0;
  /// Puts `bytes` in the place of element `element` (of an array; else 0) of a property that is state.
  virtual void set(ObjectId object, std::string_view key, std::uint32_t element, std::string_view bytes,
                   std::uint64_t ticket, RequestDone* done) noexcept = 0;
  /// The state right after the set-up.
  virtual void reset(std::uint64_t ticket, RequestDone* done) noexcept = 0;
  /// Keeps the state under a name, in memory; another of this name is replaced.
  virtual void snapshot(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept = 0;
  virtual void restore(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept = 0;
  virtual std::uint64_t state_hash() const noexcept = 0;  ///< [pause attendants, RequestDone]
  virtual std::int64_t time() const noexcept = 0;         ///< ns

  static ExtensionId id() noexcept;
  /// The host's, or null where it has none. [setup]
  static RunControl* of(Host& host) { return static_cast<RunControl*>(host.find_extension(id())); }

 protected:
  ~RunControl() = default;
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
inline ExtensionId RunControl::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(Placement), MURO_PLACE(Placement, object),
                                           MURO_PLACE(Placement, pose), MURO_PLACE(Placement, twist),
                                           MURO_PLACE(Placement, is_forced)};
  return {"muro.RunControl", 1,
          abi::extension_layout<RunControl>(
              structs, &RequestDone::done, &PauseAttendant::attend, &RunControl::is_paused, &RunControl::set_paused,
              &RunControl::step_for, &RunControl::speed, &RunControl::set_speed, &RunControl::add_attendant,
              &RunControl::remove_attendant, &RunControl::place, &RunControl::set, &RunControl::reset,
              &RunControl::snapshot, &RunControl::restore, &RunControl::state_hash, &RunControl::time)};
}
#pragma GCC diagnostic pop

}  // namespace muro
