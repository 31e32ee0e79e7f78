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
/// It asks for calls in the order of turns (see stages_of). The second time, all that the call has no right to read is
/// poisoned (bytes 0xff: not a number). The call must then write the same bits, and nothing but what it may write: else
/// it reads or writes in secret, and could not run beside others. What a call may touch follows from the bindings of
/// its instance and from the reach of its phase (Phase::Scope). Runs take many times longer.
class AccessCheck final : public CallObserver {
 public:
  AccessCheck(PropertyStore& store, const std::vector<Instance*>& instances, std::vector<std::int32_t> robot_of_slot);
  bool make(const Task& task, const Step& step, Range range, abi::ErrorText& error) override;

 private:
  /// One value in memory, or the elements of a list.
  struct Cell {
    std::uint32_t slot = 0;
    Accessor adder = setup_accessor;  ///< of a contribution to a sum
    std::byte* memory = nullptr;
    std::size_t size = 0;
    ListHeader* list = nullptr;

    std::span<std::byte> bytes() const {
      if (!list) return {memory, size};
      return {static_cast<std::byte*>(list->data), list->size * list->element_size};
    }
  };
  /// What an instance has bound, by slot.
  struct Rights {
    const abi::AlgorithmInstance* algorithm = nullptr;
    const Description* description = nullptr;
    Accessor accessor = setup_accessor;
    std::vector<bool> reads, writes;
  };
  struct Allowed {
    std::vector<bool> reads, writes;  ///< by cell
  };
  using Copy = std::vector<std::vector<std::byte>>;

  void find_cells();
  Allowed allowed(const Rights& rights, const Task& task, const Step& step, Range range) const;
  Copy copy() const;
  void put_back(const Copy& from);
  void poison(const Allowed& allowed);
  bool come_again(const Task& task, Step step, Range range, abi::ErrorText& error);
  std::string name_of(const Cell& cell) const;

  PropertyStore& store_;
  std::vector<Rights> rights_;
  std::vector<std::int32_t> robot_of_slot_;
  std::vector<Cell> cells_;
  Copy before_step_;
};

}  // namespace muro
