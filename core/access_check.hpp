// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/property_store.hpp"
#include "core/schedule/executor.hpp"

namespace muro {

class Instance;

/// Checks that algorithms access only the properties that they have declared.
///
/// Every call is made twice from the same state. Between the two calls, restored() and the earlier calls of the same
/// step are made. The calls must come in the order of the due tasks (see stages_of). Before the second call, everything
/// that the call has no right to read is poisoned, as AddressSanitizer poisons memory (here with bytes 0xff: not a
/// number). The call must then write the same bits, and only where it may write. Otherwise it has undeclared accesses
/// and could not run in parallel with others. The accesses that a call may make follow from the bindings of its
/// instance and from the scope of its phase. Runs take many times longer.
class AccessCheck final : public Executor::Observer {
 public:
  AccessCheck(PropertyStore& store, const std::vector<Instance*>& instances, std::vector<RobotId> robot_of_slot);
  bool call(const Task& task, const Step& step, Range range, abi::ErrorText& error) override;

 private:
  /// The memory of one property, or of one contribution to a sum.
  struct Memory {
    std::uint32_t slot = 0;
    Accessor contributor = setup_accessor;  ///< the contributor, when this is a contribution to a sum
    std::byte* data = nullptr;
    std::size_t size = 0;
    ListHeader* list = nullptr;

    std::span<std::byte> bytes() const {
      if (!list) return {data, size};
      return {static_cast<std::byte*>(list->data), list->size * list->element_size};
    }
  };
  /// The slots that an instance has bound, by slot.
  struct Bindings {
    const abi::AlgorithmInstance* algorithm = nullptr;
    const Description* description = nullptr;
    Accessor accessor = setup_accessor;
    std::vector<bool> reads, writes;
  };
  struct Allowed {
    std::vector<bool> reads, writes;  ///< by index in memory_
  };
  using Copy = std::vector<std::vector<std::byte>>;

  void find_memory();
  Allowed allowed(const Bindings& bindings, const Task& task, const Step& step, Range range) const;
  Copy copy() const;
  void restore(const Copy& from);
  void poison(const Allowed& allowed);
  bool repeat_until(const Task& task, Step step, Range range, abi::ErrorText& error);
  std::string name_of(const Memory& memory) const;

  PropertyStore& store_;
  std::vector<Bindings> bindings_;
  std::vector<RobotId> robot_of_slot_;
  std::vector<Memory> memory_;
  Copy before_step_;
};

}  // namespace muro
