// SPDX-License-Identifier: MIT
#include "core/own_table.hpp"

namespace muro {

namespace {

template <class T>
Rows<T> own_rows(const Rows<T>& given, std::deque<std::vector<T>>& memory) {
  std::vector<T>& copies = memory.emplace_back();
  for (std::size_t i = 0; i < given.size(); ++i) copies.push_back(given.known(i));
  return copies;
}

}  // namespace

OwnTable::OwnTable(const abi::PluginTable& given) : table_(given) {
  for (const abi::AlgorithmEntry& e : given.algorithms) algorithms_.push_back({&own(e), e.create, sizeof(Description)});
  for (const abi::ReaderEntry& e : given.readers) readers_.push_back({&own(e), e.create, sizeof(ReaderDescription)});
  table_.algorithms = algorithms_;
  table_.readers = readers_;
}

const Description& OwnTable::own(const abi::AlgorithmEntry& entry) {
  Description& d = descriptions_.emplace_back(known_part<Description>(entry.description, entry.description_size));
  d.parameters = own_rows(d.parameters, parameters_);
  d.reads = own_rows(d.reads, uses_);
  d.writes = own_rows(d.writes, uses_);
  return d;
}

const ReaderDescription& OwnTable::own(const abi::ReaderEntry& entry) {
  return reader_descriptions_.emplace_back(known_part<ReaderDescription>(entry.description, entry.description_size));
}

}  // namespace muro
