// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace muro::host {

/// As text, indented by two, or in one line where `indent` is -1. Names may be any bytes: what is no UTF-8 becomes
/// U+FFFD, the replacement character.
std::string json_text(const nlohmann::ordered_json& json, int indent = 2);

}  // namespace muro::host
