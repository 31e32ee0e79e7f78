// SPDX-License-Identifier: MIT
#include "process_protocol.hpp"

namespace muro::control {

namespace {

void write_ports(std::span<const muro_port> ports, Writer& to) {
  to.value(std::uint64_t(ports.size()));
  for (const muro_port& p : ports) {
    to.text(p.name);
    to.value(p.unit != nullptr);
    to.text(p.unit ? p.unit : "");
    to.value(p.size);
    to.value(p.flags);
  }
}

void read_ports(Reader& from, ControlTable& table, std::vector<muro_port>& ports) {
  for (auto left = from.value<std::uint64_t>(); left > 0; --left) {
    const std::string name = from.text();
    const bool has_unit = from.value<bool>();
    const std::string unit = from.text();
    const auto size = from.value<std::uint32_t>();
    table.add_port(ports, name, has_unit ? unit.c_str() : nullptr, size, from.value<std::uint32_t>());
  }
}

}  // namespace

void write(const ControlTable& table, Writer& to) {
  to.text(table.name);
  to.text(table.version);
  write_ports(table.inputs, to);
  write_ports(table.outputs, to);
  to.value(table.state_size);
  to.value(table.has_instances);
  to.value(table.can_save);
  to.value(std::uint64_t(table.tunables.size()));
  for (const ControlTable::Tunable& t : table.tunables) {
    to.text(t.name), to.text(t.unit), to.text(t.doc);
    to.value(t.default_value), to.value(t.min), to.value(t.max);
  }
  to.value(std::uint64_t(table.tasks.size()));
  for (const ControlTable::Task& t : table.tasks) to.text(t.name), to.value(t.rate);
}

ControlTable read_table(Reader& from) {
  ControlTable table;
  table.name = from.text();
  table.version = from.text();
  read_ports(from, table, table.inputs);
  read_ports(from, table, table.outputs);
  table.state_size = from.value<std::uint64_t>();
  table.has_instances = from.value<bool>();
  table.can_save = from.value<bool>();
  for (auto left = from.value<std::uint64_t>(); left > 0; --left) {
    ControlTable::Tunable& t = table.tunables.emplace_back();
    t.name = from.text(), t.unit = from.text(), t.doc = from.text();
    t.default_value = from.value<double>(), t.min = from.value<double>(), t.max = from.value<double>();
  }
  for (auto left = from.value<std::uint64_t>(); left > 0; --left) {
    ControlTable::Task& t = table.tasks.emplace_back();
    t.name = from.text(), t.rate = from.value<double>();
  }
  return table;
}

void write(const Preparation& p, Writer& to) {
  to.text(p.setup.robot);
  to.value(p.setup.index);
  to.value(p.setup.count);
  to.value(std::uint64_t(p.setup.arguments.size()));
  for (const std::string& text : p.setup.arguments) to.text(text);
  to.list(std::span<const double>(p.setup.tunables));
  to.list(std::span<const double>(p.setup.task_rates));
  to.list(std::span<const std::uint32_t>(p.input_sizes));
  to.list(std::span<const std::uint32_t>(p.output_sizes));
  to.value(p.memory);
  to.value(p.spin_nanoseconds);
}

Preparation read_preparation(Reader& from) {
  Preparation p;
  p.setup.robot = from.text();
  p.setup.index = from.value<std::uint32_t>();
  p.setup.count = from.value<std::uint32_t>();
  for (auto left = from.value<std::uint64_t>(); left > 0; --left) p.setup.arguments.push_back(from.text());
  p.setup.tunables = from.list<double>();
  p.setup.task_rates = from.list<double>();
  p.input_sizes = from.list<std::uint32_t>();
  p.output_sizes = from.list<std::uint32_t>();
  p.memory = from.value<std::uint64_t>();
  p.spin_nanoseconds = from.value<std::uint64_t>();
  return p;
}

}  // namespace muro::control
