// SPDX-License-Identifier: MIT
#include "joint_group.hpp"

#include "plugins/common/text/counted.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/fault.hpp"
#include "plugins/controller/common/wire_protocol/number_text.hpp"

namespace muro::joints {

/// Writes the number of axes. Then for each axis: name, unit of the reading, quantity that is set, its unit, its lower
/// and its upper limit.
void JointGroup::describe(Quantity quantity, std::string& out) const {
  const bool is_standard = quantity == Quantity::standard || quantity == Quantity::setpoint;
  const auto add_word = [&](std::string_view word) { out.append(1, ' ').append(word.empty() ? "-" : word); };
  add_word(std::to_string(axes_.size()));
  for (const Axis* axis : axes_) {
    const Quantity by = is_standard ? axis->standard_target() : quantity;
    const Target& target = axis->target(by);
    add_word(axis->name());
    add_word(axis->unit_of_reading(is_standard ? axis->standard_reading() : quantity));
    add_word(target.place ? wire::name_of(by) : "none");
    add_word(target.unit);
    for (const double limit : {target.lower, target.upper}) {
      out += ' ';
      wire::add_number(out, limit);
    }
  }
}

void JointGroup::read(Quantity quantity, std::vector<double>& out) const {
  out.clear();
  for (const Axis* axis : axes_) out.push_back(axis->read(quantity));
}

void JointGroup::set(Quantity quantity, std::span<const double> values, wire::Origin origin) {
  if (values.size() != axes_.size())
    throw wire::Fault{wire::FaultCode::wrong_fields, "group " + quote(name()) + " has " +
                                                         counted(axes_.size(), "number") + ", not " +
                                                         std::to_string(values.size())};
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i]->check(quantity, values[i]);
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i]->set(quantity, values[i], origin);
}

void JointGroup::stop() {
  for (Axis* axis : axes_) axis->stop();
}

}  // namespace muro::joints
