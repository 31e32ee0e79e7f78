// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

#include "muro/object.hpp"

namespace muro {

/// Texts by number, each once; number 0 is the empty text. Views of texts stay valid while the table lives.
class TextTable {
 public:
  TextTable() { intern(""); }
  TextTable(const TextTable& other) { *this = other; }
  TextTable& operator=(const TextTable& other);
  TextTable(TextTable&&) = default;
  TextTable& operator=(TextTable&&) = default;
  ~TextTable() = default;

  TextId intern(std::string_view text);
  const std::string& operator[](TextId id) const { return texts_[static_cast<std::size_t>(id)]; }
  std::size_t size() const { return texts_.size(); }
  bool operator==(const TextTable& other) const { return texts_ == other.texts_; }
  auto begin() const { return texts_.begin(); }
  auto end() const { return texts_.end(); }

 private:
  std::deque<std::string> texts_;
  std::unordered_map<std::string_view, TextId> ids_;  ///< keys are views of texts_
};

}  // namespace muro
