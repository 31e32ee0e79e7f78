// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/external/input_log.hpp"
#include "muro/ext/run_control.hpp"

namespace muro {

class Simulation;
struct Snapshot;

/// Requests of algorithms and of a recording to the run; they are carried out between two instants.
class RunRequests final : public RunControl {
 public:
  RunRequests(InputLog& inputs, const World& world);
  ~RunRequests();

  bool is_paused() const noexcept override { return paused_; }
  void set_paused(bool paused) noexcept override;
  void step_for(std::int64_t ns) noexcept override;
  double speed() const noexcept override { return speed_; }
  void set_speed(double factor) noexcept override;
  void place(const Placement& placement, std::uint64_t ticket, RequestDone* done) noexcept override;
  void set(ObjectId object, std::string_view key, std::uint32_t element, std::string_view bytes, std::uint64_t ticket,
           RequestDone* done) noexcept override;
  void reset(std::uint64_t ticket, RequestDone* done) noexcept override;
  void snapshot(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept override;
  void restore(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept override;
  std::uint64_t state_hash() const noexcept override;
  std::int64_t time() const noexcept override { return inputs_.time(); }

  /// Calls it while the run is paused. [set-up]
  void add_attendant(PauseAttendant& attendant) { attendants_.push_back(&attendant); }
  /// Announces that requests may come: each instant must then be complete before the next one begins.
  void want() { wanted_ = true; }
  bool is_wanted() const { return wanted_; }
  /// Sets the speed of the run as it was chosen outside.
  void start_with_speed(double factor) { speed_ = factor; }
  /// Whether the run has to stop between instants for a request.
  bool is_waiting() const { return has_requests_ || speed_changed_ || (paused_ && pause_at_ < 0); }
  /// Time (ns) at which the run is to stop for a recorded request, or for the end of a step.
  std::int64_t next_time(std::int64_t now) const;
  /// Whether something has to be carried out at `now` (ns).
  bool is_due(std::int64_t now) const { return is_waiting() || next_time(now) <= now; }
  /// Records that the run has ended here, before its time; its replay ends here too.
  void record_stop();
  /// Carries out the requests, and stays here while the run is paused. `stop` ends a pause.
  void carry_out(Simulation& simulation, const std::function<bool()>& stop);

  /// The kinds of inputs in the simulation's own channel.
  enum class Kind : std::uint32_t { place, set, reset, snapshot, restore, stop };

 private:
  struct Request {
    Kind kind;
    std::string bytes;  ///< the recorded form of the request
    std::uint64_t ticket = 0;
    RequestDone* done = nullptr;
    bool is_from_outside = true;
  };
  void add(Request request) noexcept;
  void carry_out_all(Simulation& simulation);
  void replay_all(Simulation& simulation);
  /// Returns why it was refused; empty when it was done.
  std::string carry_out(Simulation& simulation, Kind kind, std::string_view bytes);
  std::string set_element(Simulation& simulation, std::string_view bytes);

  InputLog& inputs_;
  const World& world_;
  std::mutex mutex_;  ///< guards requests_
  std::vector<Request> requests_;
  std::atomic<bool> has_requests_{false};
  std::vector<PauseAttendant*> attendants_;
  std::map<std::string, std::unique_ptr<Snapshot>, std::less<>> snapshots_;
  bool wanted_ = false;
  bool paused_ = false;
  bool has_stopped_ = false;    ///< the run has ended, and its end is recorded
  std::int64_t pause_at_ = -1;  ///< ns: a pause begins there; -1: now
  double speed_ = 0;
  bool speed_changed_ = false;
};

}  // namespace muro
