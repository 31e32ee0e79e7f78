// SPDX-License-Identifier: MIT
// Files of parameters with their source: values of a real device from a data sheet or a measurement.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace muro {

/// A part file that was read. It has lines `name: value`, in sections: a line `name:` opens a section, and its lines
/// are indented. `#` begins a comment. A value is a number, numbers in brackets, or a text, in quotes or without. The
/// format is a subset of YAML.
class PartFile {
 public:
  struct Entry {
    std::string section;  ///< empty: before the first section
    std::string name, value;
    int line = 0, column = 0;  ///< of the value
    int name_column = 0;
  };
  /// Throws Error with `name`, line and column for any other text, and for a name that is in a section twice.
  static PartFile parse(std::string_view text, std::string name);
  /// Throws Error if the file cannot be read, or is larger than 1 MiB.
  static PartFile read(const std::string& path);

  /// Returns the name in messages.
  const std::string& name() const { return name_; }
  const std::vector<Entry>& entries() const { return entries_; }
  std::vector<std::string> sections() const;
  /// Returns an entry; null if it is not there.
  const Entry* find(std::string_view section, std::string_view name) const;
  /// Returns the value as a finite number. Throws Error if it is not one.
  std::optional<double> number(std::string_view section, std::string_view name) const;
  /// Returns the value, one finite number or several, "[1, 2]". Throws Error if it is neither.
  std::vector<double> numbers(const Entry& entry) const;
  /// Returns "FILE:LINE:COLUMN: " of the value.
  std::string place(const Entry& entry) const;
  /// Returns "FILE:LINE:COLUMN: " of the name.
  std::string place_of_name(const Entry& entry) const;
  /// Throws Error for an entry of a section (or before all sections) whose name is not one of `known`.
  void check_names(std::string_view section, std::span<const std::string_view> known) const;

 private:
  std::string name_;
  std::vector<Entry> entries_;
};

/// A part file that a plugin contains.
struct ReadyPart {
  std::string_view name;  ///< of the file, without extension
  std::string_view text;
};

/// Returns the part that a scenario names: one of `ready`, else the file `path` (absolute). A name with a slash or a
/// dot is a file. Throws Error for a name that is neither, and lists those that are ready.
PartFile find_part(std::string_view name, const std::string& path, std::span<const ReadyPart> ready);

}  // namespace muro
