// SPDX-License-Identifier: MIT
// Checks the parameters of the controller against the scene.
#pragma once

#include "grants.hpp"
#include "muro/algorithm.hpp"
#include "plugins/controller/common/stream/address.hpp"
#include "scene_names.hpp"

namespace muro::jsonrpc {

/// Reads the parameter `tls`, a map with the files of the certificate and its key, into the address. Throws Error.
void read_tls(const Connector& connector, std::span<const std::string_view> texts, stream::Address& address);

/// Throws Error when other machines can reach the server, unless it has both encryption and a token.
void require_protection(const stream::Address& address, bool has_token);

/// Reads the patterns of `write`. Throws Error when one matches nothing in the scene.
Grants read_grants(const Connector& connector, std::span<const std::string_view> patterns);

/// Binds the matching properties, so that algorithms on demand update them for each step. Adds sums to `scene`. When
/// `is_strict`, a pattern that matches nothing is an error.
void refresh(Connector& connector, std::span<const std::string_view> patterns, bool is_strict, SceneNames& scene);

}  // namespace muro::jsonrpc
