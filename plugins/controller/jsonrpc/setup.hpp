// SPDX-License-Identifier: MIT
// What the parameters of the controller say, held against the scene.
#pragma once

#include "grants.hpp"
#include "muro/algorithm.hpp"
#include "plugins/controller/common/stream/address.hpp"
#include "scene_names.hpp"

namespace muro::jsonrpc {

/// The parameter `tls`, a map: files of the certificate and its key, put into the address. Throws Error.
void read_tls(const Connector& connector, std::span<const std::string_view> texts, stream::Address& address);

/// Throws Error where others than this machine could reach it, unless it is encrypted and they have to say a token.
void require_protection(const stream::Address& address, bool has_token);

/// The patterns of `write`. Throws Error where one matches nothing that there is.
Grants read_grants(const Connector& connector, std::span<const std::string_view> patterns);

/// Binds what matches, so that algorithms that run on demand bring it up to date for each step; sums are added to
/// `scene`. A pattern that matches nothing is an error where `is_strict`.
void refresh(Connector& connector, std::span<const std::string_view> patterns, bool is_strict, SceneNames& scene);

}  // namespace muro::jsonrpc
