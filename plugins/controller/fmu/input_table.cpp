// SPDX-License-Identifier: MIT
#include "input_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <type_traits>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/base/input_file.hpp"
#include "number.hpp"
#include "plugins/common/model_file/message.hpp"
#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/text/counted.hpp"
#include "table_row.hpp"
#include "value_text.hpp"

namespace muro::fmu {

namespace {

constexpr std::size_t most_bytes = std::size_t(64) << 20;
constexpr double rounding = 0.5e-9;  ///< tolerance, s: times of a simulation are whole nanoseconds

bool may_be_column(const Variable& v) { return v.causality == Causality::input || v.is_tunable; }

}  // namespace

class InputTable::Reader {
 public:
  explicit Reader(InputTable& table) : table_(table), description_(table.description_) {}

  void read() {
    InputFile file(table_.path_);
    std::size_t bytes = 0, number = 0;
    for (std::string line; file.line(line, most_bytes);) {
      bytes += line.size() + 1;
      if (bytes > most_bytes) throw Error(table_.path_ + " has more than " + std::to_string(most_bytes >> 20) + " MiB");
      const std::size_t mark = number == 0 && line.starts_with("\xef\xbb\xbf") ? 3 : 0;
      TableRow row(table_.path_, ++number, line, mark);
      if (row.is_blank()) continue;
      if (!has_header_)
        read_header(row);
      else
        read_row(row);
    }
    if (!has_header_) throw Error(table_.path_ + " is empty; its first line is to name the columns: time,INPUT,...");
    if (table_.times_.empty()) throw Error(table_.path_ + " has no row behind its header; at least one is needed");
  }

 private:
  void read_header(TableRow& row) {
    row.next();
    if (row.cell() != "time")
      row.fail("the first column is called " + quote(row.cell()) + "; it must be `time`, in s" +
               (row.cell().find_first_of(";\t") != std::string::npos ? ", and commas separate columns" : ""));
    while (row.next()) add_column(row);
    if (table_.columns_.empty())
      row.fail("there is no column beside `time`; what may stand here: " + names_of_columns());
    has_header_ = true;
  }

  void add_column(const TableRow& row) {
    const Variable* const v = description_.find(row.cell());
    const std::string name = quote(row.cell());
    if (v && v->causality == Causality::structural_parameter)
      row.fail(name + " is a structural parameter, which keeps its value during the run; give that in `parameters`");
    if (!v || !may_be_column(*v))
      row.fail((v ? name + " is not an input or a tunable parameter"
                  : "the FMU has no variable " + name + did_you_mean(row.cell(), columns())) +
               "; what may stand here: " + names_of_columns());
    const auto variable = std::size_t(v - description_.variables.data());
    if (table_.has(variable)) row.fail(name + " is there twice");
    if (v->type == Type::string && v->size != 1) row.fail(name + " is an array of texts, which cannot be given");
    const bool is_number = v->type != Type::string && v->type != Type::binary;
    table_.columns_.push_back({variable, is_number ? bytes_of(v->type, description_.version) : sizeof(TextPlace), {}});
    table_.room_ = std::max(table_.room_, std::size_t(v->size));
  }

  void read_row(TableRow& row) {
    row.next();
    std::string problem;
    const auto time = model_file::parse_numbers(row.cell(), 1, problem);
    if (!time) row.fail("time " + quote(row.cell()) + " " + problem);
    if (!table_.times_.empty() && time->front() < table_.times_.back())
      row.fail("time goes back from " + model_file::shortest(table_.times_.back()) + " s to " +
               model_file::shortest(time->front()) + " s; rows are sorted by it");
    table_.times_.push_back(time->front());
    for (std::size_t i = 0; i < table_.columns_.size(); ++i) {
      if (!row.next())
        row.fail("the row ends after " + counted(i + 1, "column") + "; the header names " +
                 std::to_string(table_.columns_.size() + 1));
      read_cell(row, table_.columns_[i]);
    }
    if (row.next())
      row.fail("there are more columns than the " + std::to_string(table_.columns_.size() + 1) + " of the header");
  }

  void read_cell(const TableRow& row, Column& column) {
    const Variable& v = description_.variables[column.variable];
    const auto refuse = [&](std::string_view problem) {
      row.fail((row.cell().empty() ? "an empty cell" : quote(row.cell())) + " in column " + quote(v.name) + " " +
               std::string(problem));
    };
    if (v.type == Type::string) return add(column, place_of_text(row.cell()));
    if (v.type == Type::binary) {
      const auto bytes = bytes_of_hexadecimal(row.cell());
      if (!bytes) refuse(is_no_hexadecimal);
      return add(column, place_of_text(std::string(bytes->begin(), bytes->end())));
    }
    if (const std::string problem = read_numbers(v, row.cell(), description_.version, numbers_); !problem.empty())
      refuse(problem);
    column.cells.insert(column.cells.end(), numbers_.begin(), numbers_.end());
  }

  using TextPlace = std::uint32_t;
  TextPlace place_of_text(const std::string& text) {
    const auto [found, is_new] = places_.emplace(text, TextPlace(table_.texts_.size()));
    if (is_new) table_.texts_.push_back(text);
    return found->second;
  }
  static void add(Column& column, TextPlace place) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&place);
    column.cells.insert(column.cells.end(), bytes, bytes + sizeof place);
  }

  std::vector<std::string> columns() const {
    std::vector<std::string> names;
    for (const Variable& v : description_.variables)
      if (may_be_column(v)) names.push_back(v.name);
    return names;
  }
  std::string names_of_columns() const { return quoted_list(columns()); }

  InputTable& table_;
  const ModelDescription& description_;
  bool has_header_ = false;
  std::vector<std::byte> numbers_;  ///< numbers of a cell
  std::map<std::string, TextPlace> places_;
};

InputTable::InputTable(const std::string& path, const ModelDescription& description)
    : path_(path), description_(description) {
  Reader(*this).read();
}

bool InputTable::has(std::size_t variable) const {
  return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.variable == variable; });
}

void InputTable::set(Component& component, double time, std::span<std::uint64_t> room) const {
  const auto after = std::upper_bound(times_.begin(), times_.end(), time + rounding);
  const auto row = std::size_t(std::max<std::ptrdiff_t>(after - times_.begin() - 1, 0));
  for (const Column& c : columns_) set_column(component, c, row, time, room);
}

void InputTable::set_column(Component& component, const Column& column, std::size_t row, double time,
                            std::span<std::uint64_t> room) const {
  const Variable& v = description_.variables[column.variable];
  if (v.type == Type::string || v.type == Type::binary) {
    std::uint32_t place = 0;
    std::memcpy(&place, column.cells.data() + row * sizeof place, sizeof place);
    const std::string& text = texts_[place];
    if (v.type == Type::string) return component.set_text(v.reference, text);
    return component.set_bytes(v.reference, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  if (v.size == 0) return;
  const std::span reference(&v.reference, 1);
  const std::byte* const cell = column.cells.data() + row * v.size * column.number_size;
  if (!v.is_continuous || time <= times_[row] || row + 1 == times_.size())
    return component.set(v.type, reference, cell, v.size);
  const double passed = time - times_[row], whole = times_[row + 1] - times_[row];
  with_fmi_type(v.type, description_.version, [&]<class T>(T) {
    if constexpr (std::is_floating_point_v<T>) {
      const T* const from = reinterpret_cast<const T*>(cell);
      T* const to = reinterpret_cast<T*>(room.data());
      for (std::size_t i = 0; i < v.size; ++i) {
        const double begin = from[i], end = from[v.size + i];
        const double value = begin + passed * (end - begin) / whole;
        const double part = passed / whole;  // used when the difference is too large for a double
        to[i] = T(std::isfinite(value) ? value : begin * (1 - part) + end * part);
      }
      component.set(v.type, reference, to, v.size);
    }
  });
}

}  // namespace muro::fmu
