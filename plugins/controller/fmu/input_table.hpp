// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "component.hpp"

namespace muro::fmu {

/// Values of inputs over time from a CSV file (RFC 4180): a column `time` (s, never falling) and one for each input or
/// tunable parameter, in the units of the FMU. Continuous variables are interpolated between rows, all others keep the
/// value of their row. Of rows with the same time the last one counts from then on. Before the first row its values
/// hold, after the last row those of that one.
class InputTable {
 public:
  /// Reads the file, of at most 64 MiB. `description` stays as it is as long as the table is used. Throws Error, which
  /// says what is wrong and where: "FILE:LINE:COLUMN: ...".
  InputTable(const std::string& path, const ModelDescription& description);

  const std::string& path() const { return path_; }
  /// Whether there is a column for a variable, by its place in the model description.
  bool has(std::size_t variable) const;
  /// Numbers of 8 bytes that set() needs as room.
  std::size_t room() const { return room_; }
  /// Gives an instance the values at `time` (s). `room`: of room() numbers.
  void set(Component& component, double time, std::span<std::uint64_t> room) const;

 private:
  class Reader;
  struct Column {
    std::size_t variable = 0;
    std::size_t number_size = 0;  ///< bytes of a number
    std::vector<std::byte>
        cells;  ///< row by row, as functions of FMI take them; texts and binary data: places in texts_
  };

  void set_column(Component& component, const Column& column, std::size_t row, double time,
                  std::span<std::uint64_t> room) const;

  std::string path_;
  const ModelDescription& description_;
  std::vector<double> times_;  ///< s, one for each row
  std::vector<Column> columns_;
  std::vector<std::string> texts_;  ///< each once
  std::size_t room_ = 0;
};

}  // namespace muro::fmu
