// SPDX-License-Identifier: MIT
#include "table_check.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "control_table.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::control {

namespace {

static_assert(offsetof(muro_controller_table, tunables) == first_table_size);

constexpr std::uint32_t all_flags =
    MURO_PORT_OPTIONAL | MURO_PORT_INTEGER | MURO_PORT_TEXT | MURO_PORT_LIST | MURO_PORT_OWN;

/// Checks that the elements have names, and that all names differ.
template <class Element>
void check_names(const char* what, const Element* elements, std::uint32_t count, const std::string& library) {
  if (count > 0 && !elements)
    throw Error(library + " has " + std::to_string(count) + " " + what + "s, but its table points to none");
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!elements[i].name || !*elements[i].name)
      throw Error(library + ": " + what + " " + std::to_string(i) + " has no name");
    for (std::uint32_t k = 0; k < i; ++k)
      if (std::string_view(elements[i].name) == elements[k].name)
        throw Error(library + " has two " + what + "s named " + quote(elements[i].name) + "; names are unique");
  }
}

void check_flags(const char* what, const muro_port& port, bool input, const std::string& library) {
  const std::string subject = library + ": " + what + " " + quote(port.name);
  if ((port.flags & ~all_flags) != 0)
    throw Error(subject + " has flags that this muro does not know: " + std::to_string(port.flags));
  if (has_flag(port, MURO_PORT_TEXT) && has_flag(port, MURO_PORT_INTEGER))
    throw Error(subject + " is of texts and of integers; a port has one type");
  const bool is_of_numbers = (port.flags & (MURO_PORT_TEXT | MURO_PORT_INTEGER)) == 0;
  if (has_flag(port, MURO_PORT_LIST) && (!input || port.size == 0 || !is_of_numbers))
    throw Error(subject + " is a list; only inputs of numbers are, and their size is the most that they take");
  if (has_flag(port, MURO_PORT_OWN) && (input || port.size == 0))
    throw Error(subject + " is to be a property of its own; only outputs are, and they have a size");
  if (has_flag(port, MURO_PORT_TEXT) && !input && port.size == 0)
    throw Error(subject + " is a text without a size; it says how many bytes the text has with its closing zero");
}

void check_outputs(const muro_controller_table& table, bool may_be_open, const std::string& library) {
  for (std::uint32_t i = 0; i < table.output_count && !may_be_open; ++i)
    if (table.outputs[i].size == 0)
      throw Error(library + ": output " + quote(table.outputs[i].name) +
                  " has size 0; only inputs may leave their size open");
}

void check_tunables(const muro_controller_table& table, const std::string& library) {
  check_names("tunable", table.tunables, table.tunable_count, library);
  for (std::uint32_t i = 0; i < table.tunable_count; ++i) {
    const muro_tunable& t = table.tunables[i];
    const bool bounded = t.min != t.max;
    if (!std::isfinite(t.default_value) || (bounded && !(t.default_value >= t.min && t.default_value <= t.max)))
      throw Error(library + ": tunable " + quote(t.name) + " has a default that is not from its min to its max");
  }
}

void check_tasks(const muro_controller_table& table, const std::string& library) {
  check_names("task", table.tasks, table.task_count, library);
  for (std::uint32_t i = 0; i < table.task_count; ++i) {
    if (!table.tasks[i].step) throw Error(library + ": task " + quote(table.tasks[i].name) + " has no function `step`");
    if (!(table.tasks[i].rate > 0) || !std::isfinite(table.tasks[i].rate))
      throw Error(library + ": task " + quote(table.tasks[i].name) + " has no rate above 0 Hz");
  }
}

void check_instances(const muro_controller_table& table, const std::string& library) {
  if (!table.instantiate) {
    if (table.destroy || table.save || table.load)
      throw Error(library + ": its table has a function `destroy`, `save` or `load`, but no `instantiate`");
    return;
  }
  if (!table.destroy) throw Error(library + ": its table has a function `instantiate`, but no `destroy`");
  if (table.create || table.state_size > 0)
    throw Error(library +
                ": its instances have memory of their own (`instantiate`), so it has no `create` and state_size 0");
  if (!table.save != !table.load)
    throw Error(library + ": its table has one of the functions `save` and `load`; it needs both or none");
  if (table.save && table.save_size == 0)
    throw Error(library + ": save_size is 0; it is the most bytes that `save` writes");
}

}  // namespace

void check_table(const muro_controller_table* given, const std::string& path) {
  const std::string library = "library " + path;
  if (!given) throw Error(library + ": `muro_controller` returns no table");
  const std::string advice = "; build it with the muro_controller.h of this muro";
  if (given->abi != MURO_CONTROLLER_ABI)  // the first field; all others depend on it
    throw Error(library + ": abi is " + std::to_string(given->abi) + ", this muro has " +
                std::to_string(MURO_CONTROLLER_ABI) + advice);
  if (given->table_size != first_table_size && given->table_size != sizeof(muro_controller_table))
    throw Error(library + ": table_size is " + std::to_string(given->table_size) + ", this muro has " +
                std::to_string(sizeof(muro_controller_table)) + ", and older headers have " +
                std::to_string(first_table_size) + advice);
  const muro_controller_table table = complete(*given);
  if (!table.name || !*table.name) throw Error(library + ": its table has no name");
  if (!table.step) throw Error(library + ": its table has no function `step`");
  for (const auto& [field, size] : {std::pair{"state_size", table.state_size}, {"save_size", table.save_size}})
    if (size > std::numeric_limits<std::uint32_t>::max() / 2)
      throw Error(library + ": " + field + " is " + std::to_string(size) + " bytes; at most 2147483647 are allowed");
  check_names("input", table.inputs, table.input_count, library);
  check_names("output", table.outputs, table.output_count, library);
  for (std::uint32_t i = 0; i < table.input_count; ++i) check_flags("input", table.inputs[i], true, library);
  for (std::uint32_t i = 0; i < table.output_count; ++i) check_flags("output", table.outputs[i], false, library);
  check_outputs(table, given->table_size > first_table_size, library);
  check_tunables(table, library);
  check_tasks(table, library);
  check_instances(table, library);
}

}  // namespace muro::control
