// SPDX-License-Identifier: MIT
#include "core/text_table.hpp"

namespace muro {

TextTable& TextTable::operator=(const TextTable& other) {
  if (this == &other) return *this;
  texts_.clear();
  ids_.clear();
  for (const std::string& text : other.texts_) intern(text);
  return *this;
}

TextId TextTable::intern(std::string_view text) {
  const auto known = ids_.find(text);
  if (known != ids_.end()) return known->second;
  const TextId id{std::uint32_t(texts_.size())};
  ids_.emplace(texts_.emplace_back(text), id);
  return id;
}

}  // namespace muro
