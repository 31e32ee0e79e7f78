// SPDX-License-Identifier: MIT
// A simulation for tests of the service, entirely in memory.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "service.hpp"

namespace muro::jsonrpc::testing {

/// Two robots, `rover` and `drone`, of one link each, with properties of several types.
class FakeInspection final : public Inspection {
 public:
  Pose pose{{1, 2, 3}, Quat::Identity()};
  Twist command;
  std::vector<double> ranges{0.5, 1.5, 2.5};
  std::vector<std::uint32_t> hits{1, std::uint32_t(no_object), 2};
  std::uint64_t counter = 18446744073709551615u;
  std::uint8_t flag = 7;
  float gain = 0.1f;
  char secret[16] = {};
  bool is_stopped = false;

  std::span<const LiveProperty> properties(ObjectId object) noexcept override {
    all_.clear();
    if (std::uint32_t(object) == 0) return all_;
    add(pose_key_, &pose, 1, Multiplicity::single, true, "motion");
    if (std::uint32_t(object) == 2) return all_;
    add(command_key_, &command, 1, Multiplicity::single, true, "");
    add(ranges_key_, ranges.data(), ranges.size(), Multiplicity::array, true, "laser");
    add(hits_key_, hits.data(), hits.size(), Multiplicity::list, false, "laser");
    add(counter_key_, &counter, 1, Multiplicity::single, true, "");
    add(flag_key_, &flag, 1, Multiplicity::single, true, "");
    add(gain_key_, &gain, 1, Multiplicity::single, true, "");
    add(secret_key_, &secret, 1, Multiplicity::single, true, "");
    return all_;
  }
  std::span<const LiveCost> costs() noexcept override { return {}; }
  std::uint32_t object_count() const noexcept override { return 3; }
  std::string_view object_name(ObjectId object) const noexcept override {
    constexpr std::string_view names[] = {"world", "rover/base", "drone/base"};
    return std::uint32_t(object) < 3 ? names[std::uint32_t(object)] : "?";
  }
  std::string_view text(TextId) const noexcept override { return "?"; }
  void stop() noexcept override { is_stopped = true; }
  bool is_stopping() const noexcept override { return false; }

 private:
  void add(const KeyInfo& key, void* data, std::size_t count, Multiplicity m, bool is_variable, std::string_view by) {
    all_.push_back({&key, m, std::uint32_t(count), data, false, is_variable, by});
  }

  static constexpr ValueType block_type_{"muro.block", 16, 1, Scalar::opaque, {}};
  static constexpr ValueType object_type_{"muro.ObjectId", 4, 4, Scalar::u32, {}};
  static constexpr Key<Pose> pose_key_{"pose", "m", "of the body"};
  static constexpr Key<Twist> command_key_{"command.twist", "m/s, rad/s", "wanted velocity"};
  static constexpr Key<double> ranges_key_{"ranges", "m", ""};
  static constexpr KeyInfo hits_key_{"hits", "1", &object_type_};
  static constexpr Key<std::uint64_t> counter_key_{"counter", "1", ""};
  static constexpr Key<std::uint8_t> flag_key_{"flag", "1", ""};
  static constexpr Key<float> gain_key_{"gain", "1", ""};
  static constexpr KeyInfo secret_key_{"state.block", "1", &block_type_};
  std::vector<LiveProperty> all_;
};

/// Carries out requests when complete() is called, as hosts do between instants.
class FakeRun final : public RunControl {
 public:
  explicit FakeRun(FakeInspection& its_scene) : scene(its_scene) {}

  FakeInspection& scene;
  bool paused = false;
  std::int64_t pause_at = -1;
  double factor = 1;
  std::int64_t now = 0;
  std::vector<std::string> carried_out;  ///< as texts
  std::string refuses;                   ///< reason to refuse all requests; empty: none is refused

  /// Completes the present instant.
  void complete() {
    while (!asked_.empty()) {
      Asked a = std::move(asked_.front());
      asked_.pop_front();
      if (refuses.empty()) {
        carried_out.push_back(a.words);
        a.work();
      }
      if (a.done) a.done->done(a.ticket, refuses);
    }
  }

  bool is_paused() const noexcept override { return paused; }
  void set_paused(bool is) noexcept override { paused = is, pause_at = -1; }
  void step_for(std::int64_t ns) noexcept override { paused = true, pause_at = now + ns; }
  double speed() const noexcept override { return factor; }
  void set_speed(double f) noexcept override { factor = f; }
  void place(const Placement& p, std::uint64_t ticket, RequestDone* done) noexcept override {
    add("place " + std::string(scene.object_name(p.object)) + (p.is_forced ? " by force" : ""), ticket, done,
        [this, p] { scene.pose = p.pose; });
  }
  void set(ObjectId object, std::string_view key, std::uint32_t element, std::string_view bytes, std::uint64_t ticket,
           RequestDone* done) noexcept override {
    const std::string name(key), value(bytes);
    add("set " + name, ticket, done, [this, object, name, element, value] {
      for (const LiveProperty& p : scene.properties(object))
        if (p.key->name == name)
          value.copy(static_cast<char*>(p.data) + element * p.key->type->size, p.key->type->size);
    });
  }
  void reset(std::uint64_t ticket, RequestDone* done) noexcept override {
    add("reset", ticket, done, [this] { now = 0; });
  }
  void snapshot(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept override {
    add("snapshot " + std::string(name), ticket, done, [] {});
  }
  void restore(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept override {
    add("restore " + std::string(name), ticket, done, [] {});
  }
  std::uint64_t state_hash() const noexcept override { return 0xabcdef; }
  std::int64_t time() const noexcept override { return now; }

 private:
  struct Asked {
    std::string words;
    std::uint64_t ticket;
    RequestDone* done;
    std::function<void()> work;
  };
  void add(std::string words, std::uint64_t ticket, RequestDone* done, std::function<void()> work) {
    asked_.push_back({std::move(words), ticket, done, std::move(work)});
  }
  std::deque<Asked> asked_;
};

/// Keeps the lines that clients get.
class FakeOutlet final : public Outlet {
 public:
  std::map<std::uint32_t, std::string> sent;
  std::vector<std::uint32_t> ended;
  std::map<std::uint32_t, bool> held;
  std::size_t answers = 0, changes = 0;
  bool is_full = false, is_full_for_updates = false, is_slow = false, is_slow_for_updates = false;

  bool has_room(std::uint32_t) const override { return !is_slow; }
  bool has_room_for_updates(std::uint32_t) const override { return !is_slow_for_updates; }
  bool send(std::uint32_t client, std::string_view line) override {
    if (!is_full) sent[client] += line;
    return !is_full;
  }
  bool send_update(std::uint32_t client, std::string_view line) override {
    return !is_full_for_updates && send(client, line);
  }
  void hold(std::uint32_t client, bool is_held) override { held[client] = is_held; }
  void changed() override { ++changes; }
  void answered() override { ++answers; }
  void disconnect(std::uint32_t client) override { ended.push_back(client); }
};

inline std::string request(const std::string& method, const std::string& params = "{}", int id = 1) {
  return R"({"jsonrpc":"2.0","id":)" + std::to_string(id) + R"(,"method":")" + method + R"(","params":)" + params +
         "}\n";
}

/// Service, simulation and clients together, with a period of 20 ms.
struct Dialogue {
  explicit Dialogue(std::vector<std::string_view> write = {"*", "call:*"}) : service(served(write), outlet) {
    service.scene().add_robot("rover", ObjectId{1});
    service.connected(0);
    next_step();
  }
  Served served(std::span<const std::string_view> write) { return {SceneNames(scene), run, Grants(write)}; }

  /// Ends the instant, and begins the next step of the controller.
  void next_step() {
    run.complete();
    if (steps++ > 0) run.now += period;
    service.begin_step(run.now, period);
    service.answer_due();
  }
  /// Runs until all requests are done, for lines that take a step each.
  void settle() {
    for (int i = 0; i < 10; ++i) next_step();
  }
  /// Completes an instant while the run is paused.
  void attend() {
    run.complete();
    service.begin_pause();
    service.answer_due();
  }
  /// Returns the lines that a line is answered with at once.
  std::string say(std::string_view line, std::uint32_t client = 0) {
    outlet.sent[client].clear();
    service.received(client, line);
    return std::exchange(outlet.sent[client], "");
  }
  /// Returns the lines since the last call.
  std::string heard(std::uint32_t client = 0) { return std::exchange(outlet.sent[client], ""); }

  static constexpr std::int64_t period = 20'000'000;
  FakeInspection scene;
  FakeRun run{scene};
  FakeOutlet outlet;
  Service service;
  int steps = 0;
};

}  // namespace muro::jsonrpc::testing
