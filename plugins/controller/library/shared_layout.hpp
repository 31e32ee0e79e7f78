// SPDX-License-Identifier: MIT
// The memory that an instance in a separate process shares with the simulation.
#pragma once

#include <span>

#include "control_instance.hpp"
#include "plugins/controller/common/shared_call/turn.hpp"

namespace muro::control {

/// The begin of that memory. The side that has the turn may access the rest.
struct SharedHeader {
  Turn turn;

  // the call
  Function function = Function::step;
  double time = 0, period = 0;  ///< s
  std::uint64_t seed = 0, index = 0;
  std::uint64_t saved_size = 0;  ///< bytes of the state of an instance with its own memory

  // result of the call
  Ending ending = Ending::fine;
  char in_function[64] = "";  ///< function of the library
  char reason[1024] = "";
  std::int32_t signal = 0;          ///< signal that ends the process
  std::uint64_t fault_address = 0;  ///< address of an invalid access
  std::uint32_t is_short_of_memory = 0;
  std::uint32_t is_signal_of_others = 0;

  // log lines of the call, one after the other: a level, and a text with its closing zero
  std::uint32_t log_size = 0;  ///< bytes
  std::uint32_t log_lost = 0;  ///< number of lines for which there was no room
  char log[16 * 1024] = "";
};

/// Places behind the header. Both sides compute them from the same sizes.
class SharedLayout {
 public:
  SharedLayout(const ControlTable& table, std::span<const std::uint32_t> input_sizes,
               std::span<const std::uint32_t> output_sizes);

  std::size_t size() const { return size_; }  ///< bytes, including the header
  /// Returns the addresses in memory that starts at `begin`.
  InstanceMemory memory(std::byte* begin) const;
  /// Returns the numbers of elements of inputs. They change for lists.
  std::uint32_t* input_sizes_in(std::byte* begin) const;

 private:
  std::size_t add(std::size_t bytes);

  std::vector<std::uint32_t> input_sizes_, output_sizes_;
  std::vector<std::size_t> inputs_, outputs_;
  std::size_t sizes_ = 0, state_ = 0;
  std::size_t size_ = sizeof(SharedHeader);
};

}  // namespace muro::control
