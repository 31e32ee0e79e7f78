// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/address.hpp"

#include <charconv>
#include <filesystem>
#include <optional>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/base/number_text.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/baud_rates.hpp"

namespace muro::stream {

namespace {

constexpr std::size_t longest_socket_path = 107;  // sockaddr_un

/// Returns the number at the end of a name: bots_7: 7.
std::string number_at_end(std::string_view name) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  if (digits == name.size()) return "0";
  const std::string_view number = name.substr(digits);
  return std::string(number.substr(std::min(number.find_first_not_of('0'), number.size() - 1)));
}

[[noreturn]] void refuse(std::string_view key, std::string_view value, const std::string& why) {
  throw Error("`" + std::string(key) + "` of parameter `stream` is " + quote(value) + ": " + why);
}

/// Replaces {robot} and {index}.
std::string expand(std::string_view key, std::string_view text, const Item& item) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '{') {
      out += text[i++];
      continue;
    }
    const std::string_view name = text.substr(i + 1, text.find('}', i) - i - 1);
    if (name != "robot" && name != "index")
      refuse(key, text, quote("{" + std::string(name) + "}") + " stands for nothing; allowed are {robot} and {index}");
    if (!item.robot)
      refuse(key, text, "{" + std::string(name) + "} is that of a robot, and this stream belongs to none");
    out += name == "robot" ? std::string(item.robot->name) : number_at_end(item.robot->name);
    i += name.size() + 2;
  }
  return out;
}

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [used, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc{} || used != end) return std::nullopt;
  return value;
}

/// Reads a port: a number, or a sum of several.
std::uint16_t port_of(std::string_view key, std::string_view value, std::string_view text) {
  std::uint64_t sum = 0;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    const auto summand = number<std::uint32_t>(text.substr(begin, end - begin));
    if (!summand)
      refuse(key, value,
             quote(text) +
                 " is no port; allowed is a number from 0 to 65535 or a sum such as \"4001+{index}\", where 0 "
                 "takes any port that is free");
    sum += *summand;
    begin = end + 1;
  }
  if (sum > 65535) refuse(key, value, "port " + std::to_string(sum) + " is above 65535");
  return std::uint16_t(sum);
}

/// Reads "PORT", "HOST:PORT" or "[IPV6]:PORT".
void read_host_and_port(std::string_view key, std::string_view text, bool needs_host, Address& out) {
  const std::size_t colon = text.rfind(':');
  if (colon == text.npos) {
    if (needs_host) refuse(key, text, "it needs a host and a port, \"192.168.0.7:4001\"");
    out.host = "127.0.0.1";
    out.port = port_of(key, text, text);
    return;
  }
  std::string_view host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']')
    host = host.substr(1, host.size() - 2);
  else if (host.find_first_of(":[]") != host.npos)
    refuse(key, text, "an IPv6 address stands in brackets, \"[::1]:4001\"");
  if (host.empty()) refuse(key, text, "it begins with a host, \"127.0.0.1:4001\"; \"0.0.0.0\" is all interfaces");
  out.host = host;
  out.port = port_of(key, text, text.substr(colon + 1));
}

std::string absolute(std::string_view key, const std::string& path) {
  if (path.empty() || path.back() == '/') refuse(key, path, "it must be the path of a file");
  if (path.find('\0') != path.npos) refuse(key, path, "a path has no zero byte");
  return std::filesystem::absolute(path).lexically_normal().string();
}

bool truth(std::string_view key, std::string_view value) {
  if (value == "true") return true;
  if (value != "false") refuse(key, value, "it must be true or false");
  return false;
}

template <class T>
T within(std::string_view key, std::string_view value, T low, T high, const char* unit) {
  const auto found = number<T>(value);
  if (!found || !(*found >= low && *found <= high)) {
    const auto words = [](T x) {
      if constexpr (std::is_integral_v<T>)
        return std::to_string(x);
      else
        return number_text(x);
    };
    refuse(key, value, "it must be a number from " + words(low) + " to " + words(high) + unit);
  }
  return *found;
}

/// A key and its value, from one text.
struct Entry {
  std::string_view key, value;
};

std::vector<Entry> split(std::span<const std::string_view> texts) {
  static const std::vector<std::string> keys = {"tcp",   "connect", "unix",     "pty",     "serial",    "baud",
                                                "timed", "clients", "lockstep", "timeout", "on_timeout"};
  std::vector<Entry> entries;
  for (const std::string_view text : texts) {
    const std::size_t equals = text.find('=');
    const Entry entry{text.substr(0, equals), equals == text.npos ? "" : text.substr(equals + 1)};
    if (equals == text.npos)
      throw Error("parameter `stream` has " + quote(text) + ", but it is a map, such as {tcp: 4001}");
    if (std::find(keys.begin(), keys.end(), entry.key) == keys.end())
      throw Error("parameter `stream` has an unknown key " + quote(entry.key) + did_you_mean(entry.key, keys) +
                  "; allowed are " + quoted_list(std::span(keys).first(5)) + " for where it is, and " +
                  quoted_list(std::span(keys).subspan(5)));
    for (const Entry& e : entries)
      if (e.key == entry.key) throw Error("parameter `stream` has `" + std::string(e.key) + "` twice");
    entries.push_back(entry);
  }
  return entries;
}

/// Reads the key that names the place of the stream. Returns false when the entry has another key.
bool read_place(const Entry& entry, const Item& item, Address& out) {
  const std::string_view key = entry.key;
  constexpr std::string_view kinds[] = {"tcp", "connect", "unix", "pty", "serial"};  // order as in Address::Kind
  const auto found = std::find(std::begin(kinds), std::end(kinds), key);
  if (found == std::end(kinds)) return false;
  const std::string value = expand(key, entry.value, item);
  out.kind = Address::Kind(found - std::begin(kinds));
  if (key == "tcp" || key == "connect") {
    read_host_and_port(key, value, key == "connect", out);
    if (key == "connect" && out.port == 0) refuse(key, value, "a client cannot connect to port 0");
    return true;
  }
  out.path = absolute(key, value);
  if (key == "unix" && out.path.size() > longest_socket_path)
    refuse(key, value,
           "as an absolute path it has " + std::to_string(out.path.size()) +
               " bytes, but that of a Unix socket has at "
               "most 107; choose a shorter one, such as /tmp/muro-{index}.sock");
  return true;
}

void read_option(const Entry& entry, const Item& item, Address& out) {
  const auto [key, value] = entry;
  if (key == "baud") {
    out.baud = within<std::uint32_t>(key, value, 1, 100'000'000, " bit/s");
  } else if (key == "timed") {
    out.is_timed = truth(key, value);
  } else if (key == "clients") {
    out.clients = within<std::uint32_t>(key, value, 1, 1000, "");
  } else if (key == "lockstep") {
    out.lockstep = expand(key, value, item);
    if (out.lockstep.empty()) refuse(key, value, "it must be the name of a client, which its streams have in common");
  } else if (key == "timeout") {
    out.timeout = within<double>(key, value, 0.001, 86400, " s");
  } else {
    if (value != "end" && value != "go_on")
      refuse(key, value, "it must be end (the run ends with an error) or go_on (time goes on without the client)");
    out.ends_on_timeout = value == "end";
  }
}

/// Throws when entries do not fit together.
void check(const std::vector<Entry>& entries, const Address& a) {
  const auto value = [&](std::string_view key) -> std::optional<std::string_view> {
    for (const Entry& e : entries)
      if (e.key == key) return e.value;
    return std::nullopt;
  };
  if (a.is_timed && a.baud == 0)
    throw Error("`timed` of parameter `stream` needs `baud`, the bit rate by which bytes take their time");
  if (a.kind == Address::Kind::serial) {
    if (a.baud != 0 && !is_standard_rate(a.baud))
      refuse("baud", *value("baud"), "it is no rate of serial devices; allowed are " + standard_rates());
  } else if (a.baud != 0 && !a.is_timed) {
    refuse("baud", *value("baud"),
           "it is the rate of a serial device; for bytes that take their time on another stream, add timed: true");
  }
  const bool has_one = a.kind == Address::Kind::pty || a.kind == Address::Kind::serial || a.is_timed ||
                       a.kind == Address::Kind::tcp_client;
  if (has_one && value("clients") && a.clients != 1)
    refuse("clients", *value("clients"),
           a.is_timed ? "a stream whose bytes take their time is a line to one client" : "this stream has one client");
  for (const std::string_view key : {"timeout", "on_timeout"})
    if (value(key) && a.lockstep.empty())
      refuse(key, *value(key), "it needs `lockstep`, the name of the client for which time waits");
}

}  // namespace

bool Address::is_loopback() const {
  if (kind != Kind::tcp_server && kind != Kind::tcp_client) return true;
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

std::string Address::text() const {
  switch (kind) {
    case Kind::tcp_server:
    case Kind::tcp_client: {
      const std::string where = host.find(':') == host.npos ? host : "[" + host + "]";
      return (kind == Kind::tcp_server ? "tcp " : "connect ") + where + ":" + std::to_string(port);
    }
    case Kind::unix_server:
      return "unix " + path;
    case Kind::pty:
      return "pty " + path;
    case Kind::serial:
      return "serial " + path;
  }
  return path;
}

Address read_address(const Connector& connector, std::uint32_t item, std::span<const std::string_view> texts) {
  const Item& served = connector.items()[item];
  const std::vector<Entry> entries = split(texts);
  Address out;
  std::string_view place;
  for (const Entry& entry : entries) {
    if (!read_place(entry, served, out)) {
      read_option(entry, served, out);
      continue;
    }
    if (!place.empty())
      throw Error("parameter `stream` has both " + quote(place) + " and " + quote(entry.key) +
                  ", but a stream is in one place");
    place = entry.key;
  }
  if (place.empty())
    throw Error(
        "parameter `stream` does not say where clients are served: {tcp: PORT}, {connect: \"HOST:PORT\"}, {unix: "
        "PATH}, {pty: PATH} or {serial: DEVICE, baud: RATE}");
  check(entries, out);
  if (out.is_timed || out.kind == Address::Kind::pty || out.kind == Address::Kind::serial ||
      out.kind == Address::Kind::tcp_client)
    out.clients = 1;
  return out;
}

}  // namespace muro::stream
