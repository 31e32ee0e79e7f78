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

/// Where messages go that are found in one file.
struct Messages {
  Problems& problems;
  LeftOut& left_out;
  std::string file = {};  ///< in messages; empty: the file that is read
  FileLocation at(const Element& e) const { return {file, model_file::location_of(e)}; }
};

/// The children of an element, each of which is read once. A number outside of its range is told and counts as the
/// nearest one, a value that is none as missing.
class Fields {
 public:
  /// `owner` begins messages: "sensor `lidar`".
  Fields(Element& parent, std::string owner, Messages& messages)
      : parent_(parent), owner_(std::move(owner)), messages_(messages) {}

  /// A number, brought into the range from `low` to `high`.
  std::optional<double> number(const char* name, double low, double high);
  /// As many numbers, each brought into that range.
  std::optional<std::vector<double>> numbers(const char* name, std::size_t count, double low, double high);
  /// The text without the blanks around it; empty where there is none.
  std::string text(const char* name);
  std::optional<bool> flag(const char* name);
  /// Null where there is none.
  Element* section(const char* name);
  std::vector<Element*> sections(const char* name);
  bool has(const char* name) const { return parent_.FirstChildElement(name) != nullptr; }
  bool is_read(const Element& child) const;
  /// Marks children that change nothing here: they are told as notes.
  void skip(std::initializer_list<const char*> names, const std::string& reason);
  /// Lists the children that nobody has read.
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

/// The text of an element, or of its attribute `value`, without the blanks around it.
std::string text_of(const Element& e);

}  // namespace muro::sdf_devices
