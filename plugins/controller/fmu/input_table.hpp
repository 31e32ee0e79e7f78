// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "component.hpp"

namespace muro::fmu {

/// Values of inputs over time from a CSV file (RFC 4180). It has a column `time` (s, never falling) and one for each
/// input or tunable parameter, in the units of the FMU. Continuous variables are interpolated between rows; all others
/// keep the value of their row. From a time with several rows on, the last of them counts. The first row also holds
/// before its time, and the last row after its time.
class InputTable {
 public:
  /// Reads the file, at most 64 MiB. `description` must not change while the table is used. Throws Error, which says
  /// what is wrong and where: "FILE:LINE:COLUMN: ...".
  InputTable(const std::string& path, const ModelDescription& description);

  const std::string& path() const { return path_; }
  /// Whether there is a column for a variable, by its index in the model description.
  bool has(std::size_t variable) const;
  /// Returns the size of the buffer that set() needs, in numbers of 8 bytes.
  std::size_t room() const { return room_; }
  /// Sets the values of an instance at `time` (s). `room`: buffer of room() numbers.
  void set(Component& component, double time, std::span<std::uint64_t> room) const;

 private:
  class Reader;
  struct Column {
    std::size_t variable = 0;
    std::size_t number_size = 0;   ///< bytes of a number
    std::vector<std::byte> cells;  ///< rows in the form of FMI functions; texts and binary data: indices of texts_
  };

  void set_column(Component& component, const Column& column, std::size_t row, double time,
                  std::span<std::uint64_t> room) const;

  std::string path_;
  const ModelDescription& description_;
  std::vector<double> times_;  ///< s, one for each row
  std::vector<Column> columns_;
  std::vector<std::string> texts_;  ///< without duplicates
  std::size_t room_ = 0;
};

}  // namespace muro::fmu
