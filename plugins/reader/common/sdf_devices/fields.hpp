// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/common/model_file/document.hpp"
#include "plugins/common/model_file/left_out.hpp"

namespace muro::sdf_devices {

using model_file::concat;
using model_file::Element;
using model_file::FileLocation;
using model_file::LeftOut;
using model_file::Problems;

/// Receivers of the messages about one file.
struct Messages {
  Problems& problems;
  LeftOut& left_out;
  std::string file = {};  ///< name of the file in messages; empty: the file that is read
  FileLocation at(const Element& e) const { return {file, model_file::location_of(e)}; }
};

/// The children of an element. Each child is read once. A number outside of its range is reported and replaced by the
/// nearest one in the range. A child with no valid value is reported and counts as missing.
class Fields {
 public:
  /// `owner` begins messages: "sensor `lidar`".
  Fields(Element& parent, std::string owner, Messages& messages)
      : parent_(parent), owner_(std::move(owner)), messages_(messages) {}

  /// Returns a number, clamped to the range from `low` to `high`.
  std::optional<double> number(const char* name, double low, double high);
  /// Returns `count` numbers, each clamped to that range.
  std::optional<std::vector<double>> numbers(const char* name, std::size_t count, double low, double high);
  /// Returns the text without the blanks around it; empty if there is no such child.
  std::string text(const char* name);
  std::optional<bool> flag(const char* name);
  /// Returns null if there is no such child.
  Element* section(const char* name);
  std::vector<Element*> sections(const char* name);
  bool has(const char* name) const { return parent_.FirstChildElement(name) != nullptr; }
  bool is_read(const Element& child) const;
  /// Marks children that change nothing here. They are reported as notes.
  void skip(std::initializer_list<const char*> names, const std::string& reason);
  /// Reports the children that no other call has read.
  void list_unread(const std::string& reason);

  Element& parent() { return parent_; }
  const std::string& owner() const { return owner_; }
  Messages& messages() { return messages_; }

 private:
  Element* take(const char* name);

  Element& parent_;
  std::string owner_;
  Messages& messages_;
  std::vector<const Element*> read_;
};

/// Returns the text of an element, or of its attribute `value`, without the blanks around it.
std::string text_of(const Element& e);

}  // namespace muro::sdf_devices
