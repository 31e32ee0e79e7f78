// SPDX-License-Identifier: MIT
#include "component.hpp"

#include <mutex>

#include "muro/algorithm.hpp"
#include "number.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

void Component::fail(const char* name, Status status) {
  static constexpr const char* names[] = {"OK", "Warning", "Discard", "Error", "Fatal", "Pending"};
  is_running_ = false;
  if (status == Status::fatal) is_corrupt_ = true;
  const bool is_known = status >= Status::ok && status <= Status::pending;
  const std::string prefix = "fmi" + std::to_string(setup_.description->version);
  const std::string said = setup_.log->take_reason();
  throw Error("`" + std::string(name) + "` fails with " +
              (is_known ? prefix + names[int(status)] : "the unknown status " + std::to_string(int(status))) +
              (said.empty() ? ", and the FMU gives no reason" : ": " + said));
}

void Component::abandon(void* something) {
  static std::mutex mutex;
  static std::vector<void*>& all = *new std::vector<void*>;  // kept until the process ends
  const std::lock_guard lock(mutex);
  all.push_back(something);
}

void Component::check_version(const char* function, std::string_view expected) {
  const char* (*version_of)() = nullptr;
  setup_.binary->get(version_of, function);
  const char* const version = version_of();
  if (!version || !std::string_view(version).starts_with(expected))
    throw Error("`" + std::string(function) + "` of its library says " + quote(version ? version : "") +
                ", and the model description is of FMI " + std::to_string(setup_.description->version) +
                ", where that begins with " + quote(expected) + "; export it anew");
}

std::size_t bytes_of(Type type, int version) {
  return with_fmi_type(type, version, [](auto zero) { return sizeof zero; });
}

std::unique_ptr<Component> make_component(const Component::Setup& setup) {
  return setup.description->version == 2 ? make_component_2(setup) : make_component_3(setup);
}

}  // namespace muro::fmu
