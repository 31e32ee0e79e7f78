// SPDX-License-Identifier: MIT
#include "setup.hpp"

#include <algorithm>

#include "method.hpp"
#include "muro/base/did_you_mean.hpp"
#include "plugins/common/text/glob.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::jsonrpc {

namespace {

/// Calls `visit` with each property of the scene and its name, "object:property".
template <class Visit>
void each_property(const Connector& c, Visit visit) {
  for (std::uint32_t o = 0; o < c.object_count(); ++o) {
    const std::string object = std::string(c.object_name(ObjectId{o})) + ":";
    const Rows<FoundProperty> found = c.properties(ObjectId{o});
    const std::vector<FoundProperty> all(found.begin(), found.end());
    for (const FoundProperty& p : all) visit(p, object + std::string(p.key->name));
  }
}

[[noreturn]] void refuse_pattern(const Connector& c, const char* parameter, std::string_view pattern) {
  std::vector<std::string> names;
  each_property(c, [&](const FoundProperty&, const std::string& name) {
    if (names.size() < 5000) names.push_back(name);
  });
  throw Error("`" + std::string(parameter) + "`: no property matches " + quote(pattern) + did_you_mean(pattern, names) +
              "; write \"object:property\", such as \"*:command.*\"; `muro describe` lists all");
}

void check_call(std::string_view pattern, std::string_view method) {
  std::vector<std::string> names;
  for (const Method& m : methods()) {
    if (!m.is_granted) continue;
    if (matches(method, m.name)) return;
    names.emplace_back(m.name);
  }
  throw Error("`write`: no call matches " + quote(pattern) + did_you_mean(method, names) + "; calls are " +
              quoted_list(names) + "; all others need no grant");
}

}  // namespace

void read_tls(const Connector& c, std::span<const std::string_view> texts, stream::Address& address) {
  for (const std::string_view text : texts) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string_view key = text.substr(0, equals), value = text.substr(std::min(equals + 1, text.size()));
    if ((key != "certificate" && key != "key") || value.empty())
      throw Error("`tls` is a map {certificate: FILE, key: FILE}, not " + quote(text));
    (key == "key" ? address.key : address.certificate) = c.resolve_path(value);
  }
  if (address.key.empty() != address.certificate.empty())
    throw Error("`tls` needs both a `certificate` and its `key`, files in PEM format");
  if (!address.key.empty() && address.kind != stream::Address::Kind::tcp_server)
    throw Error("`tls` is for TCP servers; " + address.text() + " is none");
}

void require_protection(const stream::Address& address, bool has_token) {
  if (address.is_loopback() || (has_token && !address.certificate.empty())) return;
  const std::string port = std::to_string(address.port);
  throw Error("`stream`: " + address.text() +
              " can be reached from other machines, where what is said can be read and changed by others; listen on "
              "127.0.0.1 or on a Unix socket, and let clients on other machines come through an SSH tunnel (ssh -L " +
              port + ":127.0.0.1:" + port +
              " HOST), or give both `tls: {certificate: FILE, key: FILE}` and `token: {file: FILE}`");
}

Grants read_grants(const Connector& c, std::span<const std::string_view> patterns) {
  for (const std::string_view pattern : patterns) {
    std::string_view method;
    if (is_for_calls(pattern, method)) {
      check_call(pattern, method);
      continue;
    }
    bool is_matched = false;
    each_property(c, [&](const FoundProperty&, const std::string& name) { is_matched |= matches(pattern, name); });
    if (!is_matched) refuse_pattern(c, "write", pattern);
  }
  return Grants(patterns);
}

void refresh(Connector& c, std::span<const std::string_view> patterns, bool is_strict, SceneNames& scene) {
  std::vector<bool> is_matched(patterns.size());
  each_property(c, [&](const FoundProperty& p, const std::string& name) {
    bool is_wanted = false;
    for (std::size_t i = 0; i < patterns.size(); ++i)
      if (matches(patterns[i], name)) is_matched[i] = is_wanted = true;
    if (!is_wanted || p.is_constant || p.key->name.starts_with("state.")) return;
    const void* const handle = c.read_any(p);
    if (p.is_sum && p.key->type->scalar == Scalar::f64)
      scene.add_sum(p.object, *p.key, static_cast<const SumHeader*>(handle));
  });
  const auto missing = std::find(is_matched.begin(), is_matched.end(), false);
  if (is_strict && missing != is_matched.end())
    refuse_pattern(c, "refresh", patterns[std::size_t(missing - is_matched.begin())]);
}

}  // namespace muro::jsonrpc
