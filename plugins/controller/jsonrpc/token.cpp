// SPDX-License-Identifier: MIT
#include "token.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::jsonrpc {

namespace {

constexpr std::size_t shortest_token = 16, longest_token = 4096;  // bytes
constexpr std::string_view blank = " \t\r\n";

std::string text_of_file(const std::string& path) {
  struct stat status {};
  std::ifstream file(path, std::ios::binary);
  if (!file || ::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
    throw Error("`token`: the file " + quote(path) + " cannot be read");
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw Error("`token`: the file " + quote(path) + " can be read or written by others; chmod 600 it");
  std::string text(longest_token + 1, '\0');
  file.read(text.data(), std::streamsize(text.size()));
  text.resize(std::size_t(file.gcount()));
  return text;
}

}  // namespace

TokenSource read_token_source(std::span<const std::string_view> texts) {
  TokenSource source;
  for (const std::string_view text : texts) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string_view key = text.substr(0, equals), value = text.substr(std::min(equals + 1, text.size()));
    if (key == "file" && !value.empty())
      source.file = value;
    else if (key == "environment" && !value.empty())
      source.environment = value;
    else
      throw Error(
          "`token` is a map with one of {file: PATH} and {environment: NAME}; the secret itself never stands in "
          "a scenario");
  }
  if (!source.file.empty() && !source.environment.empty())
    throw Error("`token` has both `file` and `environment`; give one");
  return source;
}

std::string read_token(const TokenSource& source) {
  const char* const variable = source.file.empty() ? std::getenv(source.environment.c_str()) : nullptr;
  std::string token = source.file.empty() ? (variable ? variable : "") : text_of_file(source.file);
  token.erase(0, std::min(token.find_first_not_of(blank), token.size()));
  token.erase(token.find_last_not_of(blank) + 1);
  const std::string where =
      source.file.empty() ? "the environment's " + quote(source.environment) : "the file " + quote(source.file);
  if (token.size() < shortest_token || token.size() > longest_token)
    throw Error("`token`: " + where + " must hold a secret of " + std::to_string(shortest_token) + " to " +
                std::to_string(longest_token) + " bytes, such as `openssl rand -hex 16` writes");
  return token;
}

bool is_same_token(std::string_view given, std::string_view wanted) {
  volatile unsigned char difference = given.size() == wanted.size() ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i)
    difference = static_cast<unsigned char>(
        difference | (static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(wanted[i % wanted.size()])));
  return difference == 0;
}

}  // namespace muro::jsonrpc
