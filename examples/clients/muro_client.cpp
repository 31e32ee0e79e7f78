// SPDX-License-Identifier: MIT
// A client of muro's controller.jsonrpc in one file: POSIX sockets and nlohmann-json. It puts the rover of remote.yaml
// in front of the wall, drives it until its laser sees the wall a metre ahead, and controls how time passes.
//
//     c++ -std=c++20 -o muro_client muro_client.cpp
//     ./muro_client 4010
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

using Json = nlohmann::json;

/// A connection. Every call waits for its reply; updates that come in between are kept.
class MuroClient {
 public:
  /// Connects to a port of this machine.
  explicit MuroClient(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in server{};
    server.sin_family = AF_INET;
    server.sin_port = htons(port);
    server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&server), sizeof server) != 0)
      throw std::runtime_error("nobody serves on port " + std::to_string(port) + ": " + std::strerror(errno));
  }
  ~MuroClient() { ::close(socket_); }
  MuroClient(const MuroClient&) = delete;
  MuroClient& operator=(const MuroClient&) = delete;

  /// Returns the result of a method. Throws the message of the server when there is no result.
  Json call(const std::string& method, const Json& params = Json::object()) {
    send({{"jsonrpc", "2.0"}, {"id", ++last_id_}, {"method", method}, {"params", params}});
    for (;;) {
      const Json message = receive();
      if (message.contains("method")) {
        updates_.push_back(message["params"]);
      } else if (message.contains("error")) {
        throw std::runtime_error(method + ": " + message["error"]["message"].get<std::string>());
      } else if (message["id"] == last_id_) {
        return message["result"];
      }
    }
  }
  Json get(const std::string& property) { return call("get", {{"properties", property}})["values"].front(); }
  void set(const std::string& property, const Json& value) { call("set", {{"property", property}, {"value", value}}); }

  /// Returns the next update of a subscription.
  Json update() {
    while (updates_.empty()) updates_.push_back(receive()["params"]);
    Json first = updates_.front();
    updates_.pop_front();
    return first;
  }

 private:
  void send(const Json& message) {
    const std::string line = message.dump() + "\n";
    for (std::size_t sent = 0; sent < line.size();) {
      const ssize_t size = ::send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
      if (size <= 0) throw std::runtime_error("the server has closed the connection");
      sent += std::size_t(size);
    }
  }
  Json receive() {
    for (;;) {
      if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
        const Json message = Json::parse(received_.substr(0, end));
        received_.erase(0, end + 1);
        return message;
      }
      char buffer[65536];
      const ssize_t size = ::recv(socket_, buffer, sizeof buffer, 0);
      if (size <= 0) throw std::runtime_error("the server has closed the connection");
      received_.append(buffer, std::size_t(size));
    }
  }

  int socket_;
  int last_id_ = 0;
  std::string received_;
  std::deque<Json> updates_;
};

int main(int argc, char** argv) {
  try {
    MuroClient muro(std::uint16_t(argc > 1 ? std::atoi(argv[1]) : 4010));
    muro.call("pause");
    muro.call("reset");  // so that all runs of this program are alike
    muro.call("place", {{"object", "rover"}, {"x", -1}, {"y", 0.5}, {"yaw", 0}});
    muro.call("step", {{"seconds", 0.2}});  // the laser has scanned from there
    for (int i = 0; i < 200; ++i) {
      const Json ranges = muro.get("rover/laser:ranges");
      const double ahead = ranges[ranges.size() / 2];
      if (ahead < 1) break;
      muro.set("rover/base_link:command.twist", {{"vx", std::min(0.5, ahead - 0.8)}});
      muro.call("step", {{"seconds", 0.1}});
    }
    muro.set("rover/base_link:command.twist", {{"vx", 0}});
    muro.call("step", {{"seconds", 1}});
    const Json pose = muro.get("rover/base_link:pose");
    std::printf("the rover stands at x = %.2f m, y = %.2f m\n", pose[0].get<double>(), pose[1].get<double>());
    muro.call("resume");
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
