// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "muro/detail/abi.hpp"

namespace muro {

/// The table of a plugin in the structs of this host. A plugin of an older SDK has shorter descriptions and parameters:
/// their other members get default values.
class OwnTable {
 public:
  explicit OwnTable(const abi::PluginTable& given);
  OwnTable(const OwnTable&) = delete;
  OwnTable& operator=(const OwnTable&) = delete;

  const abi::PluginTable& table() const { return table_; }

 private:
  const Description& own(const abi::AlgorithmEntry& entry);
  const ReaderDescription& own(const abi::ReaderEntry& entry);

  std::deque<Description> descriptions_;
  std::deque<ReaderDescription> reader_descriptions_;
  std::deque<std::vector<Parameter>> parameters_;
  std::deque<std::vector<PropertyUse>> uses_;
  std::vector<abi::AlgorithmEntry> algorithms_;
  std::vector<abi::ReaderEntry> readers_;
  abi::PluginTable table_;
};

}  // namespace muro
