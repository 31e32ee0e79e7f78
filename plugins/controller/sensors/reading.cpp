// SPDX-License-Identifier: MIT
#include "reading.hpp"

#include <cstring>

#include "plugins/common/text/with_scalar.hpp"

namespace muro::sensors {

namespace {

double number_at(Scalar scalar, const void* place) {
  return with_scalar(scalar, [&]<class T>(T number) {
    std::memcpy(&number, place, sizeof number);
    return double(number);
  });
}

}  // namespace

Reading::Reading(Connector& connector, const FoundProperty& property, std::string name)
    : name_(std::move(name)),
      unit_(property.key->unit),
      type_(*property.key->type),
      is_array_(property.multiplicity == Multiplicity::array),
      is_sum_(property.is_sum),
      data_(connector.read_any(property)) {}

std::string Reading::why_unreadable(const FoundProperty& property) {
  const Scalar scalar = property.key->type->scalar;
  if (property.multiplicity == Multiplicity::list) return "is a list, whose length changes";
  if (size_of(scalar) == 0) return "is of type " + std::string(property.key->type->name) + ", which has no numbers";
  if (property.is_sum && scalar != Scalar::f64) return "is a sum of what is not real numbers (f64)";
  return "";
}

std::string Reading::labels() const {
  std::string text;
  for (const std::string_view label : type_.labels) text.append(text.empty() ? "" : ",").append(label);
  return text.empty() ? "-" : text;
}

std::size_t Reading::size() const {
  return (is_array_ ? std::size_t(static_cast<const ArrayHeader*>(data_)->size) : 1) * type_.scalars();
}

void Reading::add_scalars(const void* first, std::uint64_t elements, std::vector<double>& out) const {
  const auto* place = static_cast<const unsigned char*>(first);
  for (std::uint64_t i = elements * type_.scalars(); i > 0; --i, place += size_of(type_.scalar))
    out.push_back(number_at(type_.scalar, place));
}

void Reading::add_to(std::vector<double>& out) const {
  if (is_sum_) {
    const auto* const sum = static_cast<const SumHeader*>(data_);
    for (std::uint32_t i = 0; i < type_.scalars(); ++i) {
      double total = 0;
      for (std::uint64_t k = 0; k < sum->size; ++k) total += static_cast<const double*>(sum->slots[k])[i];
      out.push_back(total);
    }
  } else if (is_array_) {
    const auto* const array = static_cast<const ArrayHeader*>(data_);
    add_scalars(array->data, array->size, out);
  } else {
    add_scalars(data_, 1, out);
  }
}

}  // namespace muro::sensors
