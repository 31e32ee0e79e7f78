// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "rpc_error.hpp"

namespace muro::jsonrpc {

/// Limits of the answers to one message; all requests of a batch share them. A method spends from the budget before it
/// computes its answer.
class Budget {
 public:
  static constexpr std::size_t most_numbers = 500'000;  ///< about 10 MB of text
  static constexpr std::size_t most_names = 20'000;
  static constexpr std::size_t most_bytes = 16 << 20;

  /// These functions throw RpcError (too many), which names the limit.
  void spend_numbers(std::size_t count) { spend(count, most_numbers, numbers_, "numbers"); }
  void spend_names(std::size_t count) { spend(count, most_names, names_, "names"); }
  void spend_bytes(std::size_t count) { spend(count, most_bytes, bytes_, "bytes"); }

 private:
  static void spend(std::size_t count, std::size_t most, std::size_t& spent, const std::string& what) {
    if (count > most - spent)
      throw RpcError{Code::too_many,
                     "the replies to one message have at most " + std::to_string(most) + " " + what +
                         ", all requests of a batch together; ask for less, or in several messages",
                     {{"limit", what}, {"most", most}, {"left", most - spent}}};
    spent += count;
  }

  std::size_t numbers_ = 0, names_ = 0, bytes_ = 0;
};

}  // namespace muro::jsonrpc
