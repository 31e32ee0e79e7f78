// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace muro::host {

/// Returns `json` as text, indented by two, or on one line when `indent` is -1. Names may be any bytes: bytes that are
/// not UTF-8 become U+FFFD, the replacement character.
std::string json_text(const nlohmann::ordered_json& json, int indent = 2);

}  // namespace muro::host
