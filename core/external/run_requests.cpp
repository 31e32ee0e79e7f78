// SPDX-License-Identifier: MIT
#include "core/external/run_requests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>
#include <tuple>
#include <utility>

#include "core/external/request_bytes.hpp"
#include "core/running_call.hpp"
#include "core/simulation.hpp"
#include "core/value_check.hpp"

namespace muro {

RunRequests::RunRequests(InputLog& inputs, const World& world) : inputs_(inputs), world_(world) {}
RunRequests::~RunRequests() = default;

std::uint64_t RunRequests::state_hash() const noexcept { return world_.hash(); }

void RunRequests::set_paused(bool paused) noexcept {
  paused_ = paused;
  pause_at_ = -1;
}

void RunRequests::step_for(std::int64_t ns) noexcept {
  paused_ = true;
  pause_at_ = time() + std::max<std::int64_t>(ns, 0);
}

void RunRequests::set_speed(double factor) noexcept {
  speed_ = factor;
  speed_changed_ = true;
}

/// Algorithms that run alone talk to the outside, and ask in the order of the run. Others belong to the simulation:
/// they ask again in a replay, and perhaps from several threads at once.
void RunRequests::add(Request request) noexcept {
  const Callee* callee = running_call().callee.load();
  request.is_from_outside = !callee || callee->runs_alone;
  const std::lock_guard lock(mutex_);
  requests_.push_back(std::move(request));
  has_requests_ = true;
}

void RunRequests::place(const Placement& p, std::uint64_t ticket, RequestDone* done) noexcept {
  RequestWriter bytes;
  bytes.value(p.object).value(p.pose.position.x()).value(p.pose.position.y()).value(p.pose.position.z());
  for (int i = 0; i < 4; ++i) bytes.value(p.pose.orientation.coeffs()[i]);
  for (int i = 0; i < 3; ++i) bytes.value(p.twist.linear[i]);
  for (int i = 0; i < 3; ++i) bytes.value(p.twist.angular[i]);
  bytes.value(std::uint8_t(p.is_forced));
  add({Kind::place, bytes.take(), ticket, done});
}

void RunRequests::set(ObjectId object, std::string_view key, std::uint32_t element, std::string_view bytes,
                      std::uint64_t ticket, RequestDone* done) noexcept {
  add({Kind::set, RequestWriter().value(object).text(key).value(element).text(bytes).take(), ticket, done});
}

void RunRequests::reset(std::uint64_t ticket, RequestDone* done) noexcept { add({Kind::reset, "", ticket, done}); }

void RunRequests::snapshot(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept {
  add({Kind::snapshot, RequestWriter().text(name).take(), ticket, done});
}

void RunRequests::restore(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept {
  add({Kind::restore, RequestWriter().text(name).take(), ticket, done});
}

std::int64_t RunRequests::next_time(std::int64_t now) const {
  std::int64_t next =
      inputs_.has_recording() ? inputs_.own_channel().next_time() : std::numeric_limits<std::int64_t>::max();
  if (paused_ && pause_at_ >= 0) next = std::min(next, pause_at_);
  return std::max(next, now);
}

void RunRequests::record_stop() {
  if (std::exchange(has_stopped_, true)) return;
  inputs_.record_again(
      {inputs_.own_channel().name(), inputs_.epoch(), inputs_.time(), {std::uint32_t(Kind::stop), 0, ""}});
}

void RunRequests::carry_out(Simulation& simulation, const std::function<bool()>& stop) {
  const auto is_over = [&] { return stop && stop(); };
  for (;;) {
    if (inputs_.has_recording()) replay_all(simulation);
    while (has_requests_) carry_out_all(simulation);  // the receiver of done() may ask for the next
    if (std::exchange(speed_changed_, false)) simulation.set_pacing({speed_});
    if (paused_ && pause_at_ >= 0 && simulation.now() >= pause_at_) pause_at_ = -1;
    if (!paused_ || pause_at_ >= 0 || is_over()) break;
    for (PauseAttendant* const attendant : attendants_) attendant->attend();
    if (!has_requests_ && paused_ && pause_at_ < 0) std::this_thread::sleep_for(std::chrono::microseconds(500));
    simulation.set_pacing({speed_});  // the run does not make up for the time of a pause
  }
}

void RunRequests::carry_out_all(Simulation& simulation) {
  std::vector<Request> requests;
  {
    const std::lock_guard lock(mutex_);
    requests.swap(requests_);
    has_requests_ = false;
  }
  const auto others =
      std::stable_partition(requests.begin(), requests.end(), [](const Request& r) { return r.is_from_outside; });
  std::sort(others, requests.end(),
            [](const Request& a, const Request& b) { return std::tie(a.kind, a.bytes) < std::tie(b.kind, b.bytes); });
  const auto is_same = [](const Request& a, const Request& b) { return a.kind == b.kind && a.bytes == b.bytes; };
  requests.erase(std::unique(others, requests.end(), is_same), requests.end());
  for (const Request& r : requests) {
    const std::int64_t time = simulation.now();
    const std::uint64_t epoch = inputs_.epoch();
    const std::string problem = carry_out(simulation, r.kind, r.bytes);
    if (problem.empty() && r.is_from_outside)
      inputs_.record({inputs_.own_channel().name(), epoch, time, {std::uint32_t(r.kind), 0, r.bytes}});
    if (r.done) r.done->done(r.ticket, problem);
  }
}

void RunRequests::replay_all(Simulation& simulation) {
  ExternalInput input;
  while (inputs_.own_channel().replay(simulation.now(), input))
    if (const std::string problem = carry_out(simulation, Kind(input.kind), std::string(input.bytes)); !problem.empty())
      throw StepError(fmt::format(
          "the recording cannot be replayed: at t = {:f} s it asks for what is not possible here: {}; it is of another "
          "scenario or another version of muro",
          1e-9 * double(simulation.now()), problem));
}

std::string RunRequests::carry_out(Simulation& simulation, Kind kind, std::string_view bytes) {
  RequestReader reader(bytes);
  try {
    switch (kind) {
      case Kind::place: {
        Placement p;
        p.object = reader.value<ObjectId>();
        for (int i = 0; i < 3; ++i) p.pose.position[i] = reader.value<double>();
        for (int i = 0; i < 4; ++i) p.pose.orientation.coeffs()[i] = reader.value<double>();
        for (int i = 0; i < 3; ++i) p.twist.linear[i] = reader.value<double>();
        for (int i = 0; i < 3; ++i) p.twist.angular[i] = reader.value<double>();
        p.is_forced = reader.value<std::uint8_t>() != 0;
        if (!reader.is_complete()) return "the request is cut short";
        simulation.place(p);
        return "";
      }
      case Kind::set:
        return set_element(simulation, bytes);
      case Kind::reset:
        simulation.reset();
        return "";
      case Kind::stop:
        if (inputs_.may_open()) simulation.stop();  // an inspection of the recorded run does not stop here
        has_stopped_ = true;
        return "";
      case Kind::snapshot:
        snapshots_.insert_or_assign(std::string(reader.text()), std::make_unique<Snapshot>(simulation.snapshot()));
        return "";
      case Kind::restore: {
        const std::string_view name = reader.text();
        const auto found = snapshots_.find(name);
        if (found == snapshots_.end()) return fmt::format("there is no snapshot {}", in_backquotes(std::string(name)));
        simulation.restore(*found->second);
        return "";
      }
    }
    return "it is of an unknown kind";
  } catch (const std::exception& e) {
    return e.what();
  }
}

std::string RunRequests::set_element(Simulation& simulation, std::string_view bytes) {
  RequestReader reader(bytes);
  const auto object = reader.value<ObjectId>();
  const std::string_view key = reader.text();
  const auto element = reader.value<std::uint32_t>();
  const std::string_view value = reader.text();
  if (!reader.is_complete()) return "the request is cut short";
  if (index_of(object) >= simulation.world().object_count()) return "there is no such object";
  const PropertyStore& store = simulation.world().store();
  const std::string name =
      fmt::format("{}, property {}", in_backquotes(store.object_name(object)), in_backquotes(std::string(key)));
  const Slot* slot = store.find(object, key);
  if (!slot) return fmt::format("{}, is not there", name);
  if (slot->kind != Slot::Class::variable)
    return fmt::format("{}, is no state: it is {}", name,
                       slot->kind == Slot::Class::constant ? "given at the set-up" : "computed from others");
  if (slot->multiplicity == Multiplicity::list) return fmt::format("{}, is a list, which its owner alone writes", name);
  const KeyInfo& info = store.key_of(*slot);
  if (info.type->scalar == Scalar::opaque || !slot->place)
    return fmt::format("{}, holds what its owner alone understands", name);
  if (key == "pose" || key == "twist")
    return fmt::format("{}, is set by placing the object, which tells all that keep something of it", name);
  const std::size_t count = slot->multiplicity == Multiplicity::array ? slot->array->size : 1;
  if (element >= count) return fmt::format("{}, has {} elements, so there is no number {}", name, count, element);
  if (value.size() != info.type->size)
    return fmt::format("{}, takes {} bytes, not {}", name, info.type->size, value.size());
  if (const std::string problem = problem_of_values(info, value.data(), 1); !problem.empty())
    return fmt::format("{}: the value {}", name, problem);
  auto* first = static_cast<std::byte*>(slot->multiplicity == Multiplicity::array ? slot->array->data : slot->place);
  std::memcpy(first + element * info.type->size, value.data(), value.size());
  if (slot->writer()) simulation.tell_of_change();
  return "";
}

}  // namespace muro
