// SPDX-License-Identifier: MIT
// Control libraries: their tables, what a scenario says about their ports, and their files.
#include <deque>
#include <sstream>

#include "muro/algorithm.hpp"
#include "muro/toolkit/whole_library.hpp"
#include "plugins/controller/library/connections.hpp"
#include "plugins/controller/library/control_library.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

int no_step(void*, const muro_controller_step*, char*, std::size_t) { return 0; }

/// A table that points to memory of its own: what no check can see, an address that is wrong, is left out.
class Table {
 public:
  explicit Table(const std::string& text) {
    table_.abi = MURO_CONTROLLER_ABI;
    table_.table_size = sizeof table_;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) read(line);
    table_.inputs = inputs_.empty() ? nullptr : inputs_.data();
    table_.outputs = outputs_.empty() ? nullptr : outputs_.data();
    // more ports than there are would be read as such
    if (table_.inputs) table_.input_count = std::uint32_t(inputs_.size());
    if (table_.outputs) table_.output_count = std::uint32_t(outputs_.size());
  }
  const muro_controller_table& get() const { return table_; }
  std::span<const muro_port> inputs() const { return inputs_; }
  const std::vector<std::string_view>& connections() const { return connections_; }

 private:
  /// "FIELD VALUE", or "input SIZE FLAGS NAME UNIT".
  void read(const std::string& line) {
    std::istringstream words(line);
    std::string field, name, unit;
    words >> field;
    if (field == "connect") {
      connections_.push_back(texts_.emplace_back(line.substr(std::min(line.size(), field.size() + 1))));
    } else if (field == "input" || field == "output") {
      muro_port port{};
      words >> port.size >> port.flags >> name;
      port.name = name.empty() ? nullptr : texts_.emplace_back(name).c_str();
      if (words >> unit) port.unit = texts_.emplace_back(unit).c_str();
      (field == "input" ? inputs_ : outputs_).push_back(port);
    } else if (field == "name") {
      words >> name;
      table_.name = texts_.emplace_back(name).c_str();
    } else if (field == "step") {
      table_.step = no_step;
    } else {
      std::uint64_t number = 0;
      words >> number;
      if (field == "abi") table_.abi = std::uint32_t(number);
      if (field == "table_size") table_.table_size = std::uint32_t(number);
      if (field == "state_size") table_.state_size = number;
      if (field == "input_count") table_.input_count = std::uint32_t(number);
      if (field == "output_count") table_.output_count = std::uint32_t(number);
    }
  }

  muro_controller_table table_{};
  std::deque<std::string> texts_;
  std::vector<muro_port> inputs_, outputs_;
  std::vector<std::string_view> connections_;
};

}  // namespace

/// The bytes are a table in text: a line for each field, each port and each connection.
void read_as_controller(Bytes bytes) {
  const Table table(text_of(bytes));
  try {
    control::check_table(&table.get(), "table.so");
    const auto read = control::read_connections("inputs", table.connections(), table.inputs(), table.get().name);
    require(read.size() <= table.inputs().size(), "more ports are connected than there are");
  } catch (const Error& e) {
    outcome(e.what());
  }
}

/// Of plugins as of control code: whether all of the file is there that the loader would read.
void read_as_library(Bytes bytes) {
  const std::string missing = missing_part_of_library(file_with(bytes, "library.so"));
  if (!missing.empty()) outcome(missing);
}

}  // namespace muro::fuzz
