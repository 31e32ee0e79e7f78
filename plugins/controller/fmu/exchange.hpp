// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "component.hpp"
#include "mapping.hpp"

namespace muro::fmu {

/// Scalars of a property that are adjacent in memory, once addresses are known.
struct Run {
  void* handle = nullptr;  ///< result of Connector::read_any or write_any
  Multiplicity multiplicity = Multiplicity::single;
  const ValueType* type = nullptr;
  std::uint64_t first = 0;
  std::optional<std::uint64_t> wanted;  ///< number of scalars; nothing: all from `first` on
  std::vector<Conversion> conversions;  ///< one for each scalar of an element; empty: not needed
  std::string name;                     ///< name of the property, for messages
  std::byte* data = nullptr;            ///< address of the first scalar
  std::uint64_t count = 0;

  /// Finds the address and the length of arrays. Throws Error when an array is shorter than needed. [start]
  void resolve();
};

/// Throws Error unless a variable and its properties have the same size; `name` and others have `count` scalars.
void check_size(const Variable& variable, std::uint64_t count, const std::string& name);

/// Transfers the values of variables between the properties of one robot and an instance: inputs, or outputs.
class Exchange {
 public:
  /// `version`: of FMI; it determines the size of a Boolean.
  void add(const Variable& variable, std::vector<Run> runs, int version);
  bool is_empty() const { return groups_.empty() && binaries_.empty(); }
  /// Throws Error when a variable and its properties have different sizes. [start]
  void resolve();

  void set(Component& component);
  /// Throws Error when a number is not finite or does not fit.
  void get(Component& component);

 private:
  struct Entry {
    const Variable* variable = nullptr;
    std::vector<Run> runs;
    std::size_t offset = 0;  ///< place of its first number in the buffer
  };
  /// Variables of one type; one call transfers them all.
  struct Group {
    std::vector<std::uint32_t> references;
    std::vector<Entry> entries;
    std::vector<std::uint64_t> buffer;  ///< numbers of up to 8 bytes
    std::size_t count = 0;              ///< numbers in the buffer
  };

  int version_ = 2;
  std::map<Type, Group> groups_;
  std::vector<Entry> binaries_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace muro::fmu
