// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace muro::jsonrpc {

/// Where a secret comes from that clients have to know. It stands in no message, log or recording.
struct TokenSource {
  std::string file;
  std::string environment;  ///< name of a variable
  bool is_given() const { return !file.empty() || !environment.empty(); }
};

/// From the parameter `token`, a map with one of these. Throws muro::Error. [setup]
TokenSource read_token_source(std::span<const std::string_view> texts);

/// The secret, at least 16 bytes, without white space around it. Throws muro::Error where there is none, or where its
/// file can be read by others.
std::string read_token(const TokenSource& source);

/// Takes as long wherever two texts of these lengths differ.
bool is_same_token(std::string_view given, std::string_view wanted);

}  // namespace muro::jsonrpc
