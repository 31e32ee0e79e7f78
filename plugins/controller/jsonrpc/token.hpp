// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace muro::jsonrpc {

/// The place of a secret that clients have to know. The secret is in no message, log or recording.
struct TokenSource {
  std::string file;
  std::string environment;  ///< name of an environment variable
  bool is_given() const { return !file.empty() || !environment.empty(); }
};

/// Reads the parameter `token`, a map with one of these. Throws muro::Error. [setup]
TokenSource read_token_source(std::span<const std::string_view> texts);

/// Returns the secret: at least 16 bytes, without white space around it. Throws muro::Error when there is none, or when
/// other users can read its file.
std::string read_token(const TokenSource& source);

/// Compares two texts in a time that does not depend on the place of a difference.
bool is_same_token(std::string_view given, std::string_view wanted);

}  // namespace muro::jsonrpc
