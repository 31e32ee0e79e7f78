// SPDX-License-Identifier: MIT
// The memory that an instance in a process of its own shares with the simulation.
#pragma once

#include <span>

#include "control_instance.hpp"
#include "plugins/controller/common/shared_call/turn.hpp"

namespace muro::control {

/// At the beginning of that memory. Who has the turn may touch the rest.
struct SharedHeader {
  Turn turn;

  // the call
  Function function = Function::step;
  double time = 0, period = 0;  ///< s
  std::uint64_t seed = 0, index = 0;
  std::uint64_t saved_size = 0;  ///< bytes, of the state of an instance with memory of its own

  // how it has ended
  Ending ending = Ending::fine;
  char in_function[64] = "";  ///< of the library
  char reason[1024] = "";
  std::int32_t signal = 0;          ///< by which the process dies
  std::uint64_t fault_address = 0;  ///< of an invalid access
  std::uint32_t is_short_of_memory = 0;
  std::uint32_t is_signal_of_others = 0;

  // what was logged meanwhile: a level and a text with its closing zero, one behind the other
  std::uint32_t log_size = 0;  ///< bytes
  std::uint32_t log_lost = 0;  ///< lines for which there was no room
  char log[16 * 1024] = "";
};

/// Where things lie behind the header; both sides work it out from the same sizes.
class SharedLayout {
 public:
  SharedLayout(const ControlTable& table, std::span<const std::uint32_t> input_sizes,
               std::span<const std::uint32_t> output_sizes);

  std::size_t size() const { return size_; }  ///< bytes, with the header
  /// The places in such memory.
  InstanceMemory memory(std::byte* begin) const;
  /// The numbers of elements of inputs, which change for lists.
  std::uint32_t* input_sizes_in(std::byte* begin) const;

 private:
  std::size_t add(std::size_t bytes);

  std::vector<std::uint32_t> input_sizes_, output_sizes_;
  std::vector<std::size_t> inputs_, outputs_;
  std::size_t sizes_ = 0, state_ = 0;
  std::size_t size_ = sizeof(SharedHeader);
};

}  // namespace muro::control
