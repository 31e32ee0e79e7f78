// SPDX-License-Identifier: MIT
#include "exchange.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

#include "muro/algorithm.hpp"
#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

namespace {

/// Calls `visit` with a null pointer to the type of C in which numbers of a type of FMI go.
template <class Visit>
auto with_fmi_type(Type type, int version, Visit visit) {
  switch (type) {
    case Type::float32:
      return visit(static_cast<float*>(nullptr));
    case Type::int64:
      return visit(static_cast<std::int64_t*>(nullptr));
    case Type::uint64:
      return visit(static_cast<std::uint64_t*>(nullptr));
    case Type::int32:
      return visit(static_cast<std::int32_t*>(nullptr));
    case Type::uint32:
      return visit(static_cast<std::uint32_t*>(nullptr));
    case Type::int16:
      return visit(static_cast<std::int16_t*>(nullptr));
    case Type::uint16:
      return visit(static_cast<std::uint16_t*>(nullptr));
    case Type::int8:
      return visit(static_cast<std::int8_t*>(nullptr));
    case Type::uint8:
      return visit(static_cast<std::uint8_t*>(nullptr));
    case Type::boolean:
      return version == 2 ? visit(static_cast<std::int32_t*>(nullptr)) : visit(static_cast<std::uint8_t*>(nullptr));
    case Type::enumeration:
      return version == 2 ? visit(static_cast<std::int32_t*>(nullptr)) : visit(static_cast<std::int64_t*>(nullptr));
    case Type::float64:
    case Type::string:
    case Type::binary:
      break;
  }
  return visit(static_cast<double*>(nullptr));
}

template <class Visit>
auto with_property_type(Scalar scalar, Visit visit) {
  switch (scalar) {
    case Scalar::f32:
      return visit(static_cast<float*>(nullptr));
    case Scalar::i64:
      return visit(static_cast<std::int64_t*>(nullptr));
    case Scalar::i32:
      return visit(static_cast<std::int32_t*>(nullptr));
    case Scalar::u64:
      return visit(static_cast<std::uint64_t*>(nullptr));
    case Scalar::u32:
      return visit(static_cast<std::uint32_t*>(nullptr));
    case Scalar::u8:
      return visit(static_cast<std::uint8_t*>(nullptr));
    case Scalar::f64:
    case Scalar::opaque:
    case Scalar::transient:
      break;  // the last two are refused when they are connected
  }
  return visit(static_cast<double*>(nullptr));
}

/// `value` as T, whole numbers rounded; false when it does not fit. A long double holds all numbers of 64 bits.
template <class T>
bool fits(long double value, T& result) {
  if constexpr (std::is_floating_point_v<T>) {
    result = T(value);
    return std::isfinite(result) || !std::isfinite(value);
  } else {
    using Limits = std::numeric_limits<T>;
    const long double whole = std::nearbyint(value);
    if (!(whole >= static_cast<long double>(Limits::min()) && whole <= static_cast<long double>(Limits::max())))
      return false;
    result = T(whole);
    return true;
  }
}

std::string text_of(long double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.17Lg", value);
  return text;
}

std::uint32_t scalar_in_element(const Run& run, std::uint64_t i) {
  return std::uint32_t((run.first + i) % run.type->scalars());
}

const Conversion* conversion_of(const Run& run, std::uint64_t i) {
  return run.conversions.empty() ? nullptr : &run.conversions[scalar_in_element(run, i)];
}

[[noreturn]] void fail(const Variable& variable, std::uint64_t element, const std::string& what) {
  throw Error("variable " + quote(variable.name) +
              (variable.size > 1 ? ", element " + std::to_string(element) + "," : "") + " " + what);
}

/// From the properties of `run` to numbers of type T.
template <class T>
void read_run(const Variable& variable, const Run& run, T* to, std::uint64_t begin) {
  with_property_type(run.type->scalar, [&](auto* type) {
    const auto* from = reinterpret_cast<decltype(type)>(run.data);
    for (std::uint64_t i = 0; i < run.count; ++i) {
      auto value = static_cast<long double>(from[i]);
      if (const Conversion* c = conversion_of(run, i)) value = c->to_fmu(double(from[i]));
      if (variable.type == Type::boolean) value = value != 0 ? 1 : 0;
      if (!fits(value, to[i]))
        fail(variable, begin + i, "does not take " + text_of(value) + ", which " + run.name + " is now");
    }
  });
}

/// From numbers of type T to the properties of `run`.
template <class T>
void write_run(const Variable& variable, const Run& run, const T* from, std::uint64_t begin) {
  with_property_type(run.type->scalar, [&](auto* type) {
    auto* to = reinterpret_cast<decltype(type)>(run.data);
    for (std::uint64_t i = 0; i < run.count; ++i) {
      auto value = static_cast<long double>(from[i]);
      if (const Conversion* c = conversion_of(run, i)) value = c->to_property(double(from[i]));
      if (!std::isfinite(value)) fail(variable, begin + i, "is " + text_of(value) + "; outputs must be finite numbers");
      if (!fits(value, to[i]))
        fail(variable, begin + i, "is " + text_of(value) + ", which does not fit into " + run.name);
    }
  });
}

std::optional<std::vector<std::uint8_t>> bytes_of_hexadecimal(std::string_view text) {
  std::vector<std::uint8_t> bytes(text.size() / 2);
  if (text.size() % 2 != 0) return std::nullopt;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char* const begin = text.data() + 2 * i;
    const auto [end, code] = std::from_chars(begin, begin + 2, bytes[i], 16);
    if (code != std::errc() || end != begin + 2) return std::nullopt;
  }
  return bytes;
}

std::uint64_t count_of(const std::vector<Run>& runs) {
  std::uint64_t count = 0;
  for (const Run& r : runs) count += r.count;
  return count;
}

}  // namespace

void Run::resolve() {
  std::uint64_t all = type->scalars();
  data = static_cast<std::byte*>(handle);
  if (multiplicity == Multiplicity::array) {
    const auto* array = static_cast<const ArrayHeader*>(handle);
    data = static_cast<std::byte*>(array->data);
    all *= array->size;
  }
  count = wanted ? *wanted : all - std::min(all, first);
  if (first + count > all)
    throw Error(name + " has " + std::to_string(all) + " scalars, [0] to [" + std::to_string(all - 1) + "]; number " +
                std::to_string(first + count - 1) + " is not among them");
  data += first * size_of(type->scalar);
}

void check_size(const Variable& v, std::uint64_t count, const std::string& name) {
  if (v.type == Type::binary || count == v.size) return;
  throw Error("variable " + quote(v.name) + " has " + std::to_string(v.size) + (v.size == 1 ? " number" : " numbers") +
              ", and what it is connected to has " + std::to_string(count) + ": " + name +
              "; choose some by [0], [vx] or [0..2] behind its name");
}

void Exchange::add(const Variable& variable, std::vector<Run> runs, int version) {
  version_ = version;
  if (variable.type == Type::binary) {
    binaries_.push_back({&variable, std::move(runs)});
    return;
  }
  Group& g = groups_[variable.type];
  g.references.push_back(variable.reference);
  g.entries.push_back({&variable, std::move(runs), g.count});
  g.count += variable.size;
  g.buffer.resize(g.count);
}

void Exchange::resolve() {
  const auto check = [](Entry& e) {
    for (Run& r : e.runs) r.resolve();
    check_size(*e.variable, count_of(e.runs), e.runs.front().name + (e.runs.size() > 1 ? " and others" : ""));
  };
  for (auto& [type, group] : groups_)
    for (Entry& e : group.entries) check(e);
  for (Entry& e : binaries_) check(e);
}

void Exchange::set(Component& component) {
  for (auto& [type, group] : groups_) {
    with_fmi_type(type, version_, [&, &g = group](auto* zero) {
      auto* const numbers = reinterpret_cast<decltype(zero)>(g.buffer.data());
      for (const Entry& e : g.entries) {
        std::uint64_t begin = 0;
        for (const Run& r : e.runs) {
          read_run(*e.variable, r, numbers + e.offset + begin, begin);
          begin += r.count;
        }
      }
    });
    component.set(type, group.references, group.buffer.data(), group.count);
  }
  for (const Entry& e : binaries_) {
    bytes_.clear();
    for (const Run& r : e.runs) {
      const auto* from = reinterpret_cast<const std::uint8_t*>(r.data);
      bytes_.insert(bytes_.end(), from, from + r.count);
    }
    component.set_bytes(e.variable->reference, bytes_);
  }
}

void Exchange::get(Component& component) {
  for (auto& [type, group] : groups_) {
    component.get(type, group.references, group.buffer.data(), group.count);
    with_fmi_type(type, version_, [&, &g = group](auto* zero) {
      const auto* const numbers = reinterpret_cast<decltype(zero)>(g.buffer.data());
      for (const Entry& e : g.entries) {
        std::uint64_t begin = 0;
        for (const Run& r : e.runs) {
          write_run(*e.variable, r, numbers + e.offset + begin, begin);
          begin += r.count;
        }
      }
    });
  }
  for (const Entry& e : binaries_) {
    std::span<const std::uint8_t> bytes = component.get_bytes(e.variable->reference);
    if (bytes.size() != count_of(e.runs))
      throw Error("variable " + quote(e.variable->name) + " has " + std::to_string(bytes.size()) +
                  " bytes, and what it is connected to has " + std::to_string(count_of(e.runs)) + ": " +
                  e.runs.front().name);
    for (const Run& r : e.runs) {
      std::copy_n(bytes.data(), r.count, reinterpret_cast<std::uint8_t*>(r.data));
      bytes = bytes.subspan(r.count);
    }
  }
}

void set_start_value(Component& component, const Variable& v, const std::string& text, int version) {
  const std::string about = "`parameters`: value " + quote(text) + " of " + quote(v.name) + " ";
  if (v.type == Type::binary) {
    const auto bytes = bytes_of_hexadecimal(text);
    if (!bytes) throw Error(about + "is not made of two hexadecimal digits a byte, such as 00ff");
    return component.set_bytes(v.reference, *bytes);
  }
  if (v.type == Type::string && v.size == 1) return component.set_text(v.reference, text);
  if (v.type == Type::string) throw Error(about + "cannot be given: it is an array of texts");
  std::string problem;
  std::vector<double> numbers;
  if (v.type == Type::boolean && (text == "true" || text == "false")) {
    numbers.push_back(text == "true" ? 1 : 0);
  } else {
    numbers = model_file::parse_numbers(text, problem);
    if (problem.empty() && numbers.size() != v.size)
      problem = "has " + std::to_string(numbers.size()) + " numbers, and needs " + std::to_string(v.size) +
                (v.size > 1 ? " separated by blanks" : "");
    if (!problem.empty()) throw Error(about + problem + (v.type == Type::boolean ? ", or true or false" : ""));
  }
  with_fmi_type(v.type, version, [&](auto* zero) {
    using T = std::remove_pointer_t<decltype(zero)>;
    std::vector<T> values(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (!fits(static_cast<long double>(numbers[i]), values[i]) ||
          (!std::is_floating_point_v<T> && numbers[i] != std::nearbyint(numbers[i])))
        throw Error(about + "does not fit into its type, " + std::string(name_of(v.type, version)));
    component.set(v.type, std::span(&v.reference, 1), values.data(), values.size());
  });
}

}  // namespace muro::fmu
