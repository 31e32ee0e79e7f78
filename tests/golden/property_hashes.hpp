// SPDX-License-Identifier: MIT
// One hash for each property: shows whether two versions of muro, or two machines, compute the same.
#pragma once

#include <map>
#include <string>

#include "core/world.hpp"

namespace muro::test {

/// Returns "CLASS HASH" of the present value of each "object:key"; CLASS is constant, variable or derived. Transient
/// values are left out, since they hold addresses. A place in memory with several names has an entry for each.
std::map<std::string, std::string> property_hashes(const World& world);

/// Returns one entry "CLASSES HASH" for each key, over all objects that have a property of this name.
std::map<std::string, std::string> hashes_by_key(const std::map<std::string, std::string>& of_properties);

}  // namespace muro::test
