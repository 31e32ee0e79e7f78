// SPDX-License-Identifier: MIT
#include "reading_group.hpp"

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/fault.hpp"
#include "plugins/controller/common/wire_protocol/number_text.hpp"

namespace muro::sensors {

namespace {

[[noreturn]] void refuse(const std::string& group, const char* why) {
  throw wire::Fault{wire::FaultCode::not_available, "group " + quote(group) + why};
}

}  // namespace

std::size_t ReadingGroup::size() const {
  std::size_t size = 0;
  for (const Reading& r : readings_) size += r.size();
  return size;
}

/// Writes the number of properties. Then for each: name, unit, number of values, labels of the values of an element.
void ReadingGroup::describe(wire::Quantity, std::string& out) const {
  out.append(1, ' ').append(std::to_string(readings_.size()));
  for (const Reading& r : readings_) {
    out.append(1, ' ').append(r.name()).append(1, ' ');
    wire::add_unit(out, r.unit());
    out.append(1, ' ').append(std::to_string(r.size())).append(1, ' ').append(r.labels());
  }
}

void ReadingGroup::read(wire::Quantity quantity, std::vector<double>& out) const {
  if (quantity != wire::Quantity::standard) refuse(name(), " is read without a quantity");
  out.clear();
  for (const Reading& r : readings_) r.add_to(out);
}

void ReadingGroup::set(wire::Quantity, std::span<const double>, wire::Origin) {
  refuse(name(), " is a group of readings, which are not set");
}

void ReadingGroup::stop() { refuse(name(), " is a group of readings, which do not stop"); }

}  // namespace muro::sensors
