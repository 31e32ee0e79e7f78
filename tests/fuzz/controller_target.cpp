// SPDX-License-Identifier: MIT
// Control libraries: their tables, the ports of a scenario, and their files.
#include <deque>
#include <sstream>

#include "muro/algorithm.hpp"
#include "muro/base/whole_library.hpp"
#include "plugins/controller/library/connections.hpp"
#include "plugins/controller/library/control_table.hpp"
#include "plugins/controller/library/table_check.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

int no_step(void*, const muro_controller_step*, char*, std::size_t) { return 0; }
void* no_instance(const muro_controller_setup*, char*, std::size_t) { return nullptr; }
void no_end(void*) {}

/// A table that points to memory of its own. Wrong addresses, which no check can find, are left out.
class Table {
 public:
  explicit Table(const std::string& text) {
    table_.abi = MURO_CONTROLLER_ABI;
    table_.table_size = sizeof table_;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) read(line);
    table_.inputs = inputs_.empty() ? nullptr : inputs_.data();
    table_.outputs = outputs_.empty() ? nullptr : outputs_.data();
    // a larger count than that of ports would be a wrong address
    if (table_.inputs) table_.input_count = std::uint32_t(inputs_.size());
    if (table_.outputs) table_.output_count = std::uint32_t(outputs_.size());
    table_.tunables = tunables_.empty() ? nullptr : tunables_.data();
    table_.tasks = tasks_.empty() ? nullptr : tasks_.data();
    if (table_.tunables) table_.tunable_count = std::uint32_t(tunables_.size());
    if (table_.tasks) table_.task_count = std::uint32_t(tasks_.size());
  }
  const muro_controller_table& get() const { return table_; }
  std::span<const muro_port> inputs() const { return inputs_; }
  const std::vector<std::string_view>& connections() const { return connections_; }
  const std::vector<std::string_view>& settings() const { return settings_; }

 private:
  /// "FIELD VALUE", "input SIZE FLAGS NAME UNIT", "tunable DEFAULT MIN MAX NAME", or "task RATE NAME".
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
    } else if (field == "set") {
      settings_.push_back(texts_.emplace_back(line.substr(std::min(line.size(), field.size() + 1))));
    } else if (field == "tunable") {
      muro_tunable tunable{};
      words >> tunable.default_value >> tunable.min >> tunable.max >> name;
      tunable.name = name.empty() ? nullptr : texts_.emplace_back(name).c_str();
      tunables_.push_back(tunable);
    } else if (field == "task") {
      muro_task task{};
      words >> task.rate >> name;
      task.name = name.empty() ? nullptr : texts_.emplace_back(name).c_str();
      if (task.rate < 1000) task.step = no_step;
      tasks_.push_back(task);
    } else if (field == "instances") {
      table_.instantiate = no_instance;
      table_.destroy = no_end;
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
      if (field == "save_size") table_.save_size = number;
      if (field == "tunable_count") table_.tunable_count = std::uint32_t(number);
      if (field == "task_count") table_.task_count = std::uint32_t(number);
      if (field == "input_count") table_.input_count = std::uint32_t(number);
      if (field == "output_count") table_.output_count = std::uint32_t(number);
    }
  }

  muro_controller_table table_{};
  std::deque<std::string> texts_;
  std::vector<muro_port> inputs_, outputs_;
  std::vector<muro_tunable> tunables_;
  std::vector<muro_task> tasks_;
  std::vector<std::string_view> connections_, settings_;
};

}  // namespace

/// The bytes are a table in text: a line for each field, each port and each connection.
void read_as_controller(Bytes bytes) {
  const Table table(text_of(bytes));
  try {
    control::check_table(&table.get(), "table.so");
    const auto read = control::read_connections("inputs", table.connections(), table.inputs(), table.get().name);
    require(read.size() <= table.inputs().size(), "more ports are connected than there are");
    const control::ControlTable described = control::describe(table.get());
    const std::vector<double> tunables = control::read_tunables(table.settings(), described);
    require(tunables.size() == described.tunables.size(), "not every tunable has one value");
    for (std::size_t i = 0; i < tunables.size(); ++i) {
      const control::ControlTable::Tunable& t = described.tunables[i];
      require(!t.is_bounded() || (tunables[i] >= t.min && tunables[i] <= t.max), "a tunable is out of its range");
    }
  } catch (const Error& e) {
    outcome(e.what());
  }
}

/// Reads the file of a control library or plugin: checks that it has all parts that the loader would read.
void read_as_library(Bytes bytes) {
  const std::string missing = missing_part_of_library(file_with(bytes, "library.so"));
  if (!missing.empty()) outcome(missing);
}

}  // namespace muro::fuzz
