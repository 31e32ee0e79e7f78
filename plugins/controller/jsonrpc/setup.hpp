// SPDX-License-Identifier: MIT
// What the parameters of the controller say, held against the scene.
#pragma once

#include "grants.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/stream/address.hpp"

namespace muro::jsonrpc {

/// Throws Error where others than this machine could reach it.
void require_local(const stream::Address& address);

/// The patterns of `write`. Throws Error where one matches nothing that there is.
Grants read_grants(const Connector& connector, std::span<const std::string_view> patterns);

/// Binds what matches, so that algorithms that run on demand bring it up to date for each step. A pattern that matches
/// nothing is an error where `is_strict`.
void refresh(Connector& connector, std::span<const std::string_view> patterns, bool is_strict);

}  // namespace muro::jsonrpc
