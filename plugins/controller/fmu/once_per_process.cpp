// SPDX-License-Identifier: MIT
#include "once_per_process.hpp"

#include <mutex>
#include <set>

namespace muro::fmu {

namespace {

std::mutex claims_mutex;

std::set<std::string>& claims() {
  static std::set<std::string> all;
  return all;
}

}  // namespace

ProcessClaim::~ProcessClaim() {
  const std::lock_guard lock(claims_mutex);
  if (!name_.empty()) claims().erase(name_);
}

bool ProcessClaim::claim(const std::string& name) {
  const std::lock_guard lock(claims_mutex);
  if (!claims().insert(name).second) return false;
  name_ = name;
  return true;
}

}  // namespace muro::fmu
