// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/property_store.hpp"
#include "core/schedule/executor.hpp"

namespace muro {

class Instance;

/// Proves that algorithms keep to the properties that they have declared.
///
/// Every call is made twice from the same state, with restored() and the calls before it in the same step in between.
/// It asks for calls in the order of due tasks (see stages_of). The second time, all that the call has no right to read
/// is poisoned, as AddressSanitizer poisons memory (here by bytes 0xff: not a number). The call must then write the
/// same bits, and nothing but what it may write: else it reads or writes in secret, and could not run beside others.
/// What a call has access to follows from the bindings of its instance and from the scope of its phase. Runs take many
/// times longer.
class AccessCheck final : public CallObserver {
 public:
  AccessCheck(PropertyStore& store, const std::vector<Instance*>& instances, std::vector<RobotId> robot_of_slot);
  bool call(const Task& task, const Step& step, Range range, abi::ErrorText& error) override;

 private:
  /// The memory of one property, or of one contribution to a sum.
  struct Memory {
    std::uint32_t slot = 0;
    Accessor contributor = setup_accessor;  ///< of a contribution to a sum
    std::byte* data = nullptr;
    std::size_t size = 0;
    ListHeader* list = nullptr;

    std::span<std::byte> bytes() const {
      if (!list) return {data, size};
      return {static_cast<std::byte*>(list->data), list->size * list->element_size};
    }
  };
  /// What an instance has bound, by slot.
  struct Bindings {
    const abi::AlgorithmInstance* algorithm = nullptr;
    const Description* description = nullptr;
    Accessor accessor = setup_accessor;
    std::vector<bool> reads, writes;
  };
  struct Allowed {
    std::vector<bool> reads, writes;  ///< by number in memory_
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
