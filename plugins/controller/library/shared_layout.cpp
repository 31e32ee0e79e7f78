// SPDX-License-Identifier: MIT
#include "shared_layout.hpp"

namespace muro::control {

SharedLayout::SharedLayout(const ControlTable& table, std::span<const std::uint32_t> input_sizes,
                           std::span<const std::uint32_t> output_sizes)
    : input_sizes_(input_sizes.begin(), input_sizes.end()), output_sizes_(output_sizes.begin(), output_sizes.end()) {
  const auto bytes_of = [](const muro_port& port, std::uint32_t size) {
    return std::size_t(size) * (type_of(port) == PortType::text ? 1 : 8);
  };
  sizes_ = add(input_sizes.size() * sizeof(std::uint32_t));
  for (std::size_t i = 0; i < input_sizes.size(); ++i)
    inputs_.push_back(add(bytes_of(table.inputs[i], input_sizes[i])));
  for (std::size_t i = 0; i < output_sizes.size(); ++i)
    outputs_.push_back(add(bytes_of(table.outputs[i], output_sizes[i])));
  state_ = add(table.state_size);
}

/// Adds an area. Each begins at a cache line, so the state has the alignment that the C header promises.
std::size_t SharedLayout::add(std::size_t bytes) {
  constexpr std::size_t line = 64;
  const std::size_t place = (size_ + line - 1) / line * line;
  size_ = place + bytes;
  return place;
}

InstanceMemory SharedLayout::memory(std::byte* begin) const {
  InstanceMemory m;
  for (const std::size_t place : inputs_) m.inputs.push_back(begin + place);
  for (const std::size_t place : outputs_) m.outputs.push_back(begin + place);
  m.input_sizes = input_sizes_;
  m.output_sizes = output_sizes_;
  m.state = begin + state_;
  m.saved_size = &reinterpret_cast<SharedHeader*>(begin)->saved_size;
  return m;
}

std::uint32_t* SharedLayout::input_sizes_in(std::byte* begin) const {
  return reinterpret_cast<std::uint32_t*>(begin + sizes_);
}

}  // namespace muro::control
