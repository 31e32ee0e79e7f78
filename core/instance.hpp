// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>

#include "core/algorithm_setup.hpp"
#include "core/schedule/task.hpp"
#include "core/world.hpp"
#include "muro/detail/abi.hpp"

namespace muro {

/// The rank of an algorithm within its kind. Worlds run before all other motions, since they read where those are.
constexpr Task::Rank rank_of(const Description& d) {
  return d.kind == Kind::motion && (d.capabilities & Capability::world) == 0 ? Task::Rank::second : Task::Rank::first;
}
/// The place of an algorithm in an instant.
constexpr int order_of(const Description& d) { return Task::order_of(d.kind, rank_of(d)); }

/// Parameters checked against a description; owns the memory to which they point.
class ParameterSet {
 public:
  /// Throws SetupError with every problem, each with the allowed values and the nearest name.
  ParameterSet(const Description& description, const AlgorithmSetup& setup);
  ParameterSet(const ParameterSet&) = delete;
  ParameterSet& operator=(const ParameterSet&) = delete;
  const Parameters& view() const { return view_; }

 private:
  ParameterValue value_of(const Parameter& p, const ParameterInput* given, std::vector<std::string>& problems);

  std::deque<std::string> texts_;
  std::deque<std::vector<double>> reals_;
  std::deque<std::vector<std::string_view>> text_lists_;
  std::vector<ParameterValue> values_;
  Parameters view_;
};

/// An instance of an algorithm: created by its plugin and connected to the world.
class Instance final : private Connector {
 public:
  Instance(const abi::AlgorithmEntry& entry, AlgorithmSetup setup, World& world, Host& host);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const AlgorithmSetup& setup() const { return setup_; }
  const Description& description() const { return *entry_.description; }
  abi::AlgorithmInstance& algorithm() { return *algorithm_; }
  Accessor accessor() const { return accessor_; }
  /// Names of the algorithm in messages about its calls.
  const std::shared_ptr<const Callee>& callee() const { return callee_; }

  /// Sets the rate to that of its sequence. [before connect]
  void set_rate(Rate rate) { setup_.rate = rate; }
  /// Sets, by robot number, whether another motion moves the robot at the start; the initial values of that motion then
  /// count. [before connect]
  void set_inactive_at_start(std::vector<bool> inactive) { inactive_at_start_ = std::move(inactive); }
  /// Throws SetupError with the algorithm's own message.
  void connect();
  void connect_by_name();
  /// Excludes it from the run: it is never called again, and reads and writes nothing.
  void leave_out();
  bool is_left_out() const { return is_left_out_; }
  void start();
  void restored();
  void finish();
  /// Returns false when it cannot take the robot over; `error` then names the algorithm and the reason.
  bool on_handover(std::uint32_t item, abi::ErrorText& error);
  /// Slots that it reads and slots that it writes, for the scheduler.
  std::vector<SlotId> reads() const;
  std::vector<SlotId> writes() const;
  /// Adds indirect reads: the reader of a property that points into others (SceneIndex) reads what its writer reads.
  void add_indirect_reads(const std::vector<const Instance*>& by_accessor);
  /// Every property that is not a constant, once. Contributions to a sum do not exclude each other, but they exclude
  /// readers of the sum.
  std::vector<Task::Access> accesses() const;
  /// Adds a property that it has to read to know when to run.
  void add_read(SlotId slot) { bound_.push_back({slot, usage::read}); }
  /// Paths in its parameters that it has resolved: files that it reads.
  const std::deque<std::string>& resolved_paths() const { return paths_; }
  /// The phases of a step; one or more.
  std::vector<Phase> phases() const;
  /// Returns the interface that the algorithm offers, or null. [after connect]
  template <class Interface>
  Interface* find_extension() {
    if (is_left_out_) return nullptr;
    const CallScope scope(*callee_, "find_extension");
    return static_cast<Interface*>(algorithm_->find_extension(Interface::id()));
  }

 private:
  Rows<Item> items() const noexcept override { return setup_.items; }
  const Parameters& parameters() const noexcept override { return parameters_.view(); }
  const Parameters& parameters_of(std::uint32_t i) const noexcept override {
    return item_parameters_.empty() ? parameters_.view() : item_parameters_[i].view();
  }
  Host& host() const noexcept override { return host_; }
  std::uint64_t random_key(std::uint32_t i) const noexcept override;
  std::string_view resolve_path(std::string_view path) const noexcept override;
  std::uint32_t object_count() const noexcept override { return world_.object_count(); }
  std::string_view object_name(ObjectId object) const noexcept override { return world_.object_name(object); }
  ObjectId find_object(std::string_view name) const noexcept override { return world_.find_object(name); }
  std::span<const RobotView* const> robots() const noexcept override { return world_.robots(); }
  RobotId robot_of(ObjectId object) const noexcept override { return world_.robot_of(object); }
  std::string_view text(TextId id) const noexcept override { return world_.text(id); }
  Rows<FoundProperty> properties(ObjectId object) const noexcept override;
  bool is_used(ObjectId object, const KeyInfo& key, Usage usage) const noexcept override;
  void* state_block(ObjectId object, std::string_view name, std::uint32_t size) noexcept override;
  void* bind(ObjectId object, const KeyInfo& key, Usage usage, Multiplicity multiplicity, std::uint32_t count,
             const void* initial) noexcept override;
  ArrayHeader constant_raw(ObjectId object, const KeyInfo& key) const noexcept override;
  void set_raw(ObjectId object, const KeyInfo& key, const void* value) noexcept override;
  double rate() const noexcept override { return setup_.rate.hertz(); }

  void require(bool fine, const abi::ErrorText& error, const char* doing) const;
  std::shared_ptr<const Callee> make_callee() const;

  const abi::AlgorithmEntry& entry_;
  AlgorithmSetup setup_;
  World& world_;
  Host& host_;
  ParameterSet parameters_;
  std::deque<ParameterSet> item_parameters_;  ///< one for each item, when they differ
  Accessor accessor_;
  std::shared_ptr<const Callee> callee_;
  abi::AlgorithmInstance* algorithm_ = nullptr;
  mutable std::vector<FoundProperty> found_;
  mutable std::deque<KeyInfo> aliases_;
  mutable std::deque<std::string> paths_;
  struct Bound {
    SlotId slot;
    Usage usage;
  };
  std::vector<Bound> bound_;
  bool is_left_out_ = false;
  std::vector<bool> inactive_at_start_;
};

}  // namespace muro
