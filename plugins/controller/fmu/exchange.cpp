// SPDX-License-Identifier: MIT
#include "exchange.hpp"

#include <cmath>

#include "muro/algorithm.hpp"
#include "number.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/common/text/with_scalar.hpp"

namespace muro::fmu {

namespace {

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

/// Reads the properties of `run` into numbers of type T.
template <class T>
void read_run(const Variable& variable, const Run& run, T* to, std::uint64_t begin) {
  with_scalar(run.type->scalar, [&](auto zero) {
    const auto* from = reinterpret_cast<const decltype(zero)*>(run.data);
    for (std::uint64_t i = 0; i < run.count; ++i) {
      const Conversion* const c = conversion_of(run, i);
      const bool fits = variable.type == Type::boolean ? convert(from[i] != 0 ? 1 : 0, to[i])
                        : c                            ? convert(c->to_fmu(double(from[i])), to[i])
                                                       : convert(from[i], to[i]);
      if (!fits)
        fail(variable, begin + i, "does not take " + text_of_number(from[i]) + ", which " + run.name + " is now");
    }
  });
}

/// Writes numbers of type T to the properties of `run`.
template <class T>
void write_run(const Variable& variable, const Run& run, const T* from, std::uint64_t begin) {
  with_scalar(run.type->scalar, [&](auto zero) {
    auto* to = reinterpret_cast<decltype(zero)*>(run.data);
    for (std::uint64_t i = 0; i < run.count; ++i) {
      if (!std::isfinite(double(from[i])))
        fail(variable, begin + i,
             "is " + (std::isnan(double(from[i])) ? "not a number" : text_of_number(from[i])) +
                 "; outputs must be finite numbers");
      const Conversion* const c = conversion_of(run, i);
      if (!(c ? convert(c->to_property(double(from[i])), to[i]) : convert(from[i], to[i])))
        fail(variable, begin + i, "is " + text_of_number(from[i]) + ", which does not fit into " + run.name);
    }
  });
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
    with_fmi_type(type, version_, [&, &g = group](auto zero) {
      auto* const numbers = reinterpret_cast<decltype(zero)*>(g.buffer.data());
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
    with_fmi_type(type, version_, [&, &g = group](auto zero) {
      const auto* const numbers = reinterpret_cast<const decltype(zero)*>(g.buffer.data());
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

}  // namespace muro::fmu
