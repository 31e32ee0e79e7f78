// SPDX-License-Identifier: MIT
// controller.jsonrpc in real simulations, with clients on sockets.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <mutex>
#include <thread>

#include "core/external/input_log.hpp"
#include "json.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/peer.hpp"
#include "tests/support/scene.hpp"

namespace muro::jsonrpc {
namespace {

using test::Peer;
using Texts = std::vector<std::string>;

/// A ball that moves as commanded, 1 m above the ground, and a server at 50 Hz on any free port.
struct Served : test::Scene {
  explicit Served(std::map<std::string, ParameterInput> settings = {}) {
    if (!settings.contains("stream")) settings["stream"] = Texts{"tcp=0"};
    if (!settings.contains("write")) settings["write"] = Texts{"*:command.*", "call:*"};
    set_log([this](LogLevel, std::string_view line) {
      const std::lock_guard lock(mutex);
      log += std::string(line) + "\n";
    });
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("controller.jsonrpc", 50, {}, std::move(settings));
  }
  ~Served() { stop(); }

  /// Runs at this speed; 0: as fast as possible.
  Served& run(double speed = 0) {
    build();
    set_pacing({speed});
    thread = std::thread([this] {
      try {
        run_until(3'600'000'000'000'000, [this] { return stops.load(); });
      } catch (const std::exception& e) {
        failure = e.what();
      }
    });
    return *this;
  }
  void stop() {
    stops = true;
    if (thread.joinable()) thread.join();
  }
  std::uint16_t port() {
    const std::lock_guard lock(mutex);
    return test::tcp_port_in(log);
  }

  std::mutex mutex;
  std::string log, failure;
  const RobotView& ball = add("ball", test::ball(1, 0.1, 0.5), {{0, 0, 1}, Quat::Identity()});
  std::atomic<bool> stops{false};
  std::thread thread;
};

/// One client that waits for its replies.
struct Client {
  explicit Client(std::uint16_t port) : peer(Peer::tcp(port)) {}
  explicit Client(Peer&& its_peer) : peer(std::move(its_peer)) {}

  std::string line() { return peer.wait_line(); }
  /// Returns the result or the error of a request.
  Json ask(const std::string& method, const std::string& params = "{}") {
    EXPECT_TRUE(peer.say(R"({"jsonrpc":"2.0","id":1,"method":")" + method + R"(","params":)" + params + "}\n"));
    for (;;) {
      const std::string text = line();
      const Json reply = Json::parse(text, nullptr, false);
      if (!reply.is_object()) return text;
      if (reply.contains("id")) return reply.contains("result") ? reply["result"] : reply["error"];
      updates.push_back(reply);
    }
  }
  Peer peer;
  std::vector<Json> updates;
};

TEST(JsonRpc, DrivesARobotFromOutside) {
  Served s;
  s.run();
  Client c(s.port());
  c.ask("pause");
  EXPECT_EQ(c.ask("set", R"(["ball/body:command.twist",[1,0,0,0,0,0]])").value("code", 0), 0);
  const double before = c.ask("get", R"(["ball/body:pose"])")["values"]["ball/body:pose"][0];
  const std::int64_t begin = c.ask("time")["time"];
  const Json after_step = c.ask("step", R"({"seconds":2})");
  EXPECT_EQ(after_step["time"].get<std::int64_t>() - begin, 2'000'000'000);
  const double after = c.ask("get", R"(["ball/body:pose"])")["values"]["ball/body:pose"][0];
  EXPECT_NEAR(after - before, 2, 1e-9);
  s.stop();
  ASSERT_EQ(s.inputs().reasons().size(), 1u) << "without lockstep such a run cannot be repeated from its scenario";
  EXPECT_SAYS(s.inputs().reasons()[0], "clients of `world/jsonrpc:0` have changed the state");
}

TEST(JsonRpc, PutsARobotSomewhereElse) {
  Served s;
  s.run();
  Client c(s.port());
  c.ask("pause");
  EXPECT_TRUE(c.ask("place", R"({"object":"ball","x":3,"y":-4,"yaw":0.5})").contains("time"));
  const Json pose = c.ask("get", R"(["ball:pose"])")["values"]["ball/body:pose"];
  EXPECT_EQ(pose[0], 3);
  EXPECT_EQ(pose[1], -4);
  EXPECT_EQ(pose[2], 1);
  EXPECT_NEAR(pose[5].get<double>(), std::sin(0.25), 1e-15);
  const Json refused = c.ask("place", R"({"object":"ball","x":3e8,"y":-4})");
  EXPECT_EQ(refused["code"], -32002);
  EXPECT_EQ(refused["message"], "the pose for `ball/body` has a coordinate that is not from -1e8 to 1e8 m");
}

TEST(JsonRpc, AddsUpWhatSeveralContribute) {
  test::Scene s;
  const RobotView& ball = s.add("ball", test::ball(1, 0.1, 0.5));
  s.use("motion.simplified", 100, s.all_robots());
  s.push(ball) = {{1, 2, 9}, {0, 0, 5}};
  s.push(ball) = {{-1, -2, 0.81}, {0, 0, -5}};  // the two forces hold it in the air
  const test::ScratchFolder folder;
  const std::string path = folder.path("muro.sock");
  s.use("controller.jsonrpc", 50, {}, {{"stream", Texts{"unix=" + path}}, {"refresh", Texts{"*:pose", "*:wrench.*"}}});
  s.build();
  std::atomic<bool> stops{false};
  std::thread thread([&] { s.run_until(3'600'000'000'000'000, [&] { return stops.load(); }); });
  {
    Client c(Peer::unix_socket(path));
    EXPECT_EQ(c.ask("get", R"(["ball:wrench.external"])")["values"]["ball/body:wrench.external"],
              Json::parse("[0,0,9.81,0,0,0]"));
    EXPECT_EQ(c.ask("describe", R"(["ball:wrench.external"])")["unit"], "N, N m");
    EXPECT_EQ(c.ask("list", R"(["*:wrench.e*"])")["properties"].size(), 1u);
  }
  stops = true;
  thread.join();
}

TEST(JsonRpc, GoesBackToASnapshotAndToTheBegin) {
  Served s;
  s.run();
  Client c(s.port());
  c.ask("pause");
  c.ask("set", R"(["ball:command.twist",{"vx":1}])");
  c.ask("snapshot", R"(["here"])");
  const Json hash = c.ask("hash"), time = c.ask("time");
  EXPECT_EQ(hash["hash"].get<std::string>().size(), 16u);
  c.ask("step", R"({"seconds":1})");
  EXPECT_NE(c.ask("hash")["hash"], hash["hash"]);
  c.ask("restore", R"(["here"])");
  EXPECT_EQ(c.ask("hash")["hash"], hash["hash"]);
  EXPECT_EQ(c.ask("time")["time"], time["time"]);
  EXPECT_EQ(c.ask("reset")["time"], 0);
  EXPECT_EQ(c.ask("get", R"(["ball:pose"])")["values"]["ball/body:pose"][0], 0);
}

TEST(JsonRpc, SendsUpdatesAtTheirTimes) {
  Served s;
  s.run();
  Client c(s.port());
  c.ask("pause");
  c.ask("reset");
  c.ask("subscribe", R"({"properties":["ball:pose"],"rate":10})");
  c.ask("set", R"(["ball:command.twist",{"vx":1}])");
  c.ask("step", R"({"seconds":1})");
  c.ask("unsubscribe", "[1]");
  ASSERT_EQ(c.updates.size(), 10u) << "at the begin and every tenth of a second, but not at its end, which is to come";
  for (std::size_t i = 0; i < c.updates.size(); ++i) {
    const Json& p = c.updates[i]["params"];
    EXPECT_EQ(p["time"], std::int64_t(i) * 100'000'000);
    EXPECT_NEAR(p["values"]["ball/body:pose"][0].get<double>(), 0.1 * double(i), 1e-9);
  }
}

TEST(JsonRpc, AnswersAClientThatHasSaidAll) {
  Served s;
  s.run();
  Client c(s.port());
  c.peer.say(
      "{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"wait\",\"params\":[0.5]}\r\n\r\n"
      "{\"jsonrpc\":\"2.0\",\"id\":2,\"method\":\"time\"}\n");
  c.peer.end();
  EXPECT_EQ(Json::parse(c.line())["id"], 1);
  EXPECT_EQ(Json::parse(c.line())["id"], 2);
  EXPECT_EQ(c.line(), "");
  EXPECT_TRUE(c.peer.is_closed);
}

TEST(JsonRpc, HangsUpOnWhoeverSpeaksAnotherProtocol) {
  Served s;
  s.run();
  for (const char* words :
       {"POST / HTTP/1.1\r\nContent-Type: text/plain\r\n\r\n{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"time\"}\n",
        "GET / HTTP/1.1\r\n\r\n", "\n", "\x16\x03\x01", "hello\n"}) {
    Client c(s.port());
    c.peer.say(words);
    EXPECT_EQ(c.line(), "") << words;
    EXPECT_TRUE(c.peer.is_closed) << words;
  }
  Client c(s.port());
  EXPECT_TRUE(c.ask("time").contains("time")) << "others are served";
  c.peer.say("no json\n");
  EXPECT_EQ(Json::parse(c.line())["error"]["code"], -32700) << "who has begun well is answered";
}

TEST(JsonRpc, EndsARunAlsoWhileItIsPaused) {
  for (const bool is_paused : {false, true}) {
    Served s;
    s.run();
    Client c(s.port());
    if (is_paused) c.ask("pause");
    EXPECT_TRUE(c.ask("stop").contains("time"));
    s.thread.join();
    EXPECT_TRUE(s.stopped());
  }
}

TEST(JsonRpc, HangsUpOnALineWithoutEnd) {
  Served s;
  s.run();
  Client c(s.port());
  const std::string endless = "{" + std::string(100'000, ' ');
  for (int i = 0; i < 30; ++i)
    if (!c.peer.say(endless)) break;
  EXPECT_EQ(c.line(), "");
  EXPECT_TRUE(c.peer.is_closed);
}

TEST(JsonRpc, TellsAClientThatReadsTooLateWhatItHasLost) {
  Served s;
  const std::vector<double> many(20'000, 0.123456789);
  s.world().set_array(s.ball.base(), Key<double>{"many", "1", ""}, std::span<const double>(many));
  s.run();
  Client c(s.port());
  c.ask("subscribe", R"({"properties":["ball:many"],"rate":50})");
  Client other(s.port());
  other.ask("wait", "[3]");  // 150 updates of 240 kB each
  EXPECT_TRUE(c.peer.say(R"({"jsonrpc":"2.0","id":7,"method":"time"})"
                         "\n"))
      << "replies have room";
  std::uint64_t dropped = 0;
  bool is_answered = false;
  for (int i = 0; i < 1000 && (dropped == 0 || !is_answered); ++i) {
    const Json message = Json::parse(c.line(), nullptr, false);
    ASSERT_TRUE(message.is_object());
    is_answered |= message.contains("id") && message["id"] == 7;
    if (message.contains("params")) dropped = message["params"].value("dropped", dropped);
  }
  EXPECT_TRUE(is_answered);
  EXPECT_GT(dropped, 10u);
}

TEST(JsonRpc, ServesOnAUnixSocketOfItsUserAlone) {
  const test::ScratchFolder folder;
  const std::string path = folder.path("muro.sock");
  Served s({{"stream", Texts{"unix=" + path}}});
  s.run();
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  Client c(Peer::unix_socket(path));
  EXPECT_TRUE(c.ask("time").contains("time"));
}

TEST(JsonRpc, ServesSeveralDoorsWithGrantsOfTheirOwn) {
  const test::ScratchFolder folder;
  const std::string path = folder.path("muro.sock");
  Served s;
  s.use("controller.jsonrpc", 20, {{&s.ball, s.ball.base()}}, {{"stream", Texts{"unix=" + path}}});
  s.run();
  Client all(s.port()), looker(Peer::unix_socket(path));
  EXPECT_TRUE(all.ask("pause").contains("time"));
  EXPECT_EQ(looker.ask("resume")["code"], -32000);
  EXPECT_EQ(looker.ask("time")["paused"], true) << "in a pause, all are served";
  EXPECT_EQ(looker.ask("get", R"(["ball:pose"])")["values"].size(), 1u);
  EXPECT_TRUE(all.ask("resume").contains("time"));
  EXPECT_EQ(looker.ask("wait", "[0.1]")["time"].get<std::int64_t>() % 50'000'000, 0);
}

TEST(JsonRpc, IsNotOpenedOffThisMachineWithoutProtection) {
  const auto complaint = [](std::map<std::string, ParameterInput> settings) {
    Served s(std::move(settings));
    return test::complaint_of([&] { s.build(); });
  };
  for (const char* address : {"tcp=0.0.0.0:0", "connect=192.0.2.1:4010"}) {
    const std::string said = complaint({{"stream", Texts{address}}});
    EXPECT_SAYS(said, "can be reached from other machines");
    EXPECT_SAYS(said, "ssh -L");
  }
  const Texts everywhere{"tcp=0.0.0.0:0"}, token{"environment=MURO_TEST_TOKEN"}, tls{"certificate=/a", "key=/b"};
  EXPECT_SAYS(complaint({{"stream", everywhere}, {"token", token}}), "can be reached from other machines");
  EXPECT_SAYS(complaint({{"stream", everywhere}, {"tls", tls}}), "can be reached from other machines");
  EXPECT_SAYS(complaint({{"stream", everywhere}, {"tls", tls}, {"token", token}}), "must hold a secret");
  EXPECT_SAYS(complaint({{"tls", Texts{"certificate=/a"}}}), "needs both a `certificate` and its `key`");
  ::setenv("MURO_TEST_TOKEN", "0123456789abcdef", 1);
  EXPECT_SAYS(complaint({{"tls", tls}, {"token", token}}), "the certificate `/a` cannot be used");
  ::unsetenv("MURO_TEST_TOKEN");
}

TEST(JsonRpc, AsksForATokenAndHangsUpOnWhoeverHasNone) {
  ::setenv("MURO_TEST_TOKEN", "0123456789abcdef", 1);
  Served s({{"token", Texts{"environment=MURO_TEST_TOKEN"}}});
  s.run();
  ::unsetenv("MURO_TEST_TOKEN");
  Client c(s.port()), silent(s.port());
  EXPECT_EQ(c.ask("time")["code"], -32004);
  EXPECT_EQ(c.ask("authenticate", R"(["0123456789abcdef"])"), Json::parse(R"({"authenticated":true})"));
  EXPECT_TRUE(c.ask("time").contains("time"));
  EXPECT_EQ(silent.line(), "") << "after 5 s";
  EXPECT_TRUE(silent.peer.is_closed);
  s.stop();
  EXPECT_EQ(s.log.find("0123456789abcdef"), std::string::npos);
}

TEST(JsonRpc, RefusesGrantsOfWhatIsNotThere) {
  const auto complaint = [](const char* pattern) {
    Served s({{"write", Texts{pattern}}});
    return test::complaint_of([&] { s.build(); });
  };
  EXPECT_SAYS(complaint("ball/body:comand.twist"), "did you mean `ball/body:command.twist`?");
  EXPECT_SAYS(complaint("call:stpo"), "did you mean `stop`?");
  EXPECT_SAYS(complaint("call:get"), "all others need no grant");
}

/// Returns the replies of a session in which each request is sent after the answer to the one before.
std::string session_in_lockstep(double pause_of_client) {
  Served s({{"stream", Texts{"tcp=0", "lockstep=pilot"}}});
  s.run();
  Client c(s.port());
  std::string all;
  for (int i = 0; i < 20; ++i) {
    all += c.ask("get", R"(["ball:pose"])").dump() + c.ask("time")["time"].dump() + "\n";
    c.peer.say(R"([{"jsonrpc":"2.0","method":"set","params":["ball:command.twist",{"vx":)" + std::to_string(i) +
               R"(}]},{"jsonrpc":"2.0","id":1,"method":"wait","params":[0.1]}])"
               "\n");
    all += c.line() + "\n";
    usleep(useconds_t(1e6 * pause_of_client));
  }
  s.stop();
  EXPECT_EQ(s.failure, "");
  EXPECT_TRUE(s.inputs().reasons().empty());
  return all;
}

TEST(JsonRpc, GivesTheSameBitsInLockstepHoweverSlowTheClient) {
  const std::string quick = session_in_lockstep(0), slow = session_in_lockstep(0.01);
  EXPECT_EQ(quick, slow);
  EXPECT_NE(quick.find("\"time\":1900000000"), std::string::npos) << quick;
}

}  // namespace
}  // namespace muro::jsonrpc
