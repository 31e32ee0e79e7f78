// SPDX-License-Identifier: MIT
// The clients, and the session of docs/guide/sil.md, with the scenario beside them.
#include <gtest/gtest.h>

#include <cstdio>
#include <regex>

#include "tests/support/files.hpp"
#include "tests/support/peer.hpp"

namespace muro {
namespace {

using test::run_command;
using test::text_of;

const std::string root = MURO_TEST_SOURCE_DIR "/";
const std::string run_remote =
    "cd " + root + " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " run examples/clients/remote.yaml";

/// A run of remote.yaml on a free port.
class RemoteRun {
 public:
  explicit RemoteRun(const std::string& options)
      : pipe_(popen((run_remote + " --set algorithms.remote.stream.tcp=0 " + options + " 2>&1").c_str(), "r")) {
    char line[4096];
    while (port_.empty() && std::fgets(line, sizeof line, pipe_)) {
      output_ += line;
      if (const std::uint16_t port = test::tcp_port_in(output_); port != 0) port_ = std::to_string(port);
    }
    EXPECT_NE(port_, "") << output_;
  }
  ~RemoteRun() {
    if (pipe_) finish();
  }
  RemoteRun(const RemoteRun&) = delete;
  RemoteRun& operator=(const RemoteRun&) = delete;

  const std::string& port() const { return port_; }
  /// Waits for its end, and returns its output.
  std::string finish() {
    char line[4096];
    while (std::fgets(line, sizeof line, pipe_)) output_ += line;
    EXPECT_EQ(pclose(pipe_), 0) << output_;
    pipe_ = nullptr;
    return output_;
  }

 private:
  FILE* pipe_;
  std::string port_, output_;
};

/// Returns the replies when all of `lines` is pasted at once, as into nc.
std::string paste(const std::string& port, const std::string& lines) {
  test::Peer client = test::Peer::tcp(std::uint16_t(std::stoi(port)));
  EXPECT_TRUE(client.say(lines));
  client.end();
  return client.hear_all();
}

std::string state_hash_in(const std::string& output) {
  std::smatch found;
  return std::regex_search(output, found, std::regex("state hash ([0-9a-f]{16})")) ? found[1].str() : "none";
}

TEST(RemotePage, ShowsASessionThatCanBePasted) {
  const std::string page = text_of(root + "docs/guide/sil.md");
  std::smatch requests, replies;
  ASSERT_TRUE(std::regex_search(page, requests, std::regex("```json-rpc\n([^`]*)```")));
  const std::string rest = requests.suffix();
  ASSERT_TRUE(std::regex_search(rest, replies, std::regex("```json-rpc\n((?:[^`]|`[^`])*?)```")));
  RemoteRun run("--speed 20");
  EXPECT_EQ(paste(run.port(), requests[1]), replies[1].str());
  paste(run.port(), "{\"jsonrpc\":\"2.0\",\"method\":\"stop\"}\n");
}

TEST(CppClient, DrivesToTheWall) {
  RemoteRun run("--speed 50");
  const auto client = run_command(MURO_CLIENT " " + run.port());
  EXPECT_EQ(client.exit_code, 0);
  EXPECT_EQ(client.output, "the rover stands at x = 1.84 m, y = 0.50 m\n");
  paste(run.port(), "{\"jsonrpc\":\"2.0\",\"method\":\"stop\"}\n");
}

TEST(CppClient, SaysThatNobodyIsThere) {
  const auto client = run_command(MURO_CLIENT " 1");
  EXPECT_EQ(client.exit_code, 1);
  EXPECT_EQ(client.output, "nobody serves on port 1: Connection refused\n");
}

#ifdef PYTHON3
test::CommandResult python_client(const std::string& port, const std::string& command) {
  return run_command(PYTHON3 " " + root + "examples/clients/muro_client.py 127.0.0.1:" + port + " " + command);
}

TEST(PythonClient, DoesAllFromItsCommandLine) {
  RemoteRun run("--speed 20");
  const auto say = [&](const std::string& command) { return python_client(run.port(), command).output; };
  EXPECT_EQ(say("list 'rover/base_link:command*'"), "rover/base_link:command.twist\n");
  EXPECT_EQ(say("call pause").find("{\"time\": "), 0u);
  EXPECT_EQ(say("call reset"), "{\"time\": 0, \"seconds\": 0.0}\n");
  EXPECT_EQ(say("set rover/base_link:command.twist '{\"vx\": 0.5}'"), "{\"time\": 0, \"seconds\": 0.0}\n");
  EXPECT_EQ(say("get rover/base_link:command.twist"),
            "{\"time\": 0, \"values\": {\"rover/base_link:command.twist\": [0.5, 0.0, 0.0, 0.0, 0.0, 0.0]}}\n");
  EXPECT_EQ(say("call step '{\"seconds\": 0.5}'"), "{\"time\": 500000000, \"seconds\": 0.5}\n");
  EXPECT_NE(say("describe rover/base_link:pose").find("\"qx\", \"qy\", \"qz\", \"qw\""), std::string::npos);
  EXPECT_EQ(say("call resume").find("{\"time\": "), 0u);
  const std::string watched = say("watch 'crate/body:pose' --rate 50 --count 3");
  EXPECT_EQ(std::count(watched.begin(), watched.end(), '\n'), 3) << watched;
  const auto wrong = python_client(run.port(), "get rovr/base_link:pose");
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_EQ(wrong.output, "there is no object `rovr/base_link` (did you mean rover/base_link?)\n");
  const test::ScratchFolder folder;
  const std::string headed =
      say("watch 'crate/body:pose' --rate 50 --count 200 2>" + folder.path("said") + " | head -n 1");
  EXPECT_EQ(std::count(headed.begin(), headed.end(), '\n'), 1) << headed;
  EXPECT_EQ(text_of(folder.path("said")), "") << "who reads no more ends it quietly";
  EXPECT_NE(say("set crate/body:pose '[0]'").find("may not be set"), std::string::npos);
  say("call stop");
}

TEST(PythonClient, IsALibraryToo) {
  const test::ScratchFolder folder;
  RemoteRun run("--speed 20");
  const std::string script = folder.file("script.py", R"(
import sys
from muro_client import Client, MuroError
with Client(sys.argv[1]) as muro:
    muro.call("pause")
    muro.call("reset")
    number = muro.subscribe("rover/base_link:command.twist", rate=10)
    muro.set("rover/base_link:command.twist", {"vx": 0.25}, unit="m/s, rad/s")
    muro.batch(("step", {"seconds": 1}), ("time", {}))
    times = [muro.update()["time"] // 10**6 for i in range(10)]
    assert times == [100 * i for i in range(10)], times
    assert muro.get("rover/base_link:command.twist")[0] == 0.25
    assert len(muro.get("rover/*_joint:joint.velocity")) == 4
    assert muro.get_array("rover/laser:ranges").tolist() == muro.get("rover/laser:ranges")
    try:
        muro.set("rover/base_link:command.twist", {"vx": 1}, unit="km/h")
        assert False
    except MuroError as error:
        assert error.code == -32602 and error.data["unit"] == "m/s, rad/s", error
    muro.call("stop")
print("fine")
)");
  const auto said =
      run_command("PYTHONPATH=" + root + "examples/clients " PYTHON3 " -B " + script + " 127.0.0.1:" + run.port());
  EXPECT_EQ(said.output, "fine\n");
  EXPECT_EQ(said.exit_code, 0);
}

TEST(PythonClient, IsNotNeededToRepeatARun) {
  const test::ScratchFolder folder;
  const std::string recording = folder.path("inputs.csv");
  RemoteRun run("--duration 3 --speed 0.6 --record " + recording);  // 5 s for the clients to come
  python_client(run.port(), "call pause");
  python_client(run.port(), "call place '{\"object\": \"rover\", \"x\": -1, \"y\": 0.5, \"yaw\": 1}'");
  python_client(run.port(), "set rover/base_link:command.twist '{\"vx\": 0.5, \"wz\": 0.3}'");
  python_client(run.port(), "call resume");
  const std::string first = run.finish();
  const auto again =
      run_command(run_remote + " --set algorithms.remote.stream.tcp=0 --duration 3 --replay " + recording);
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(again.output.find("serves on"), std::string::npos) << "nothing is opened";
  EXPECT_EQ(state_hash_in(again.output), state_hash_in(first)) << first << again.output;
  EXPECT_NE(state_hash_in(first), "none");
  const auto without = run_command(run_remote + " --set algorithms.remote.stream.tcp=0 --duration 3");
  EXPECT_NE(state_hash_in(without.output), state_hash_in(first)) << "the client made a difference";
}

#ifdef OPENSSL
/// A server for other machines, with a certificate of its own, and the options of a client that may connect to it.
struct Guarded {
  Guarded() {
    const auto made = run_command(OPENSSL
                                  " req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj "
                                  "/CN=muro -addext subjectAltName=IP:127.0.0.1 -keyout " +
                                  folder.path("key.pem") + " -out " + folder.path("certificate.pem"));
    EXPECT_EQ(made.exit_code, 0) << made.output;
    folder.file("token", "0123456789abcdef0123456789abcdef\n");
    folder.file("wrong", "1123456789abcdef0123456789abcdef\n");
    run_command("chmod 600 " + folder.path("token"));
  }
  std::string options() const {
    return "--speed 20 --set algorithms.remote.stream.tcp=0.0.0.0:0 --set 'algorithms.remote.tls={certificate: " +
           folder.path("certificate.pem") + ", key: " + folder.path("key.pem") +
           "}' --set 'algorithms.remote.token={file: " + folder.path("token") + "}'";
  }
  std::string client(const std::string& token) const {
    return "--tls " + folder.path("certificate.pem") + " --token-file " + folder.path(token) + " ";
  }
  test::ScratchFolder folder;
};

TEST(PythonClient, TalksToAServerForOtherMachinesByTlsAndToken) {
  const Guarded guarded;
  RemoteRun run(guarded.options());
  const auto say = [&](const std::string& options, const std::string& command) {
    return run_command(PYTHON3 " " + root + "examples/clients/muro_client.py " + options + "127.0.0.1:" + run.port() +
                       " " + command);
  };
  EXPECT_EQ(say(guarded.client("token"), "list 'rover/base_link:command*'").output, "rover/base_link:command.twist\n");
  const std::string script = guarded.folder.file("script.py", R"(
import sys
from muro_client import Client
with Client(sys.argv[1], tls=sys.argv[2], token=open(sys.argv[3]).read().strip()) as muro:
    results = muro.batch(*[("get", {"properties": ["*:*"] * 200})] * 100)  # many records of TLS, both ways
    assert all(len(r["values"]) == len(results[0]["values"]) > 50 for r in results)
print("fine")
)");
  const auto said =
      run_command("PYTHONPATH=" + root + "examples/clients " PYTHON3 " -B " + script + " 127.0.0.1:" + run.port() +
                  " " + guarded.folder.path("certificate.pem") + " " + guarded.folder.path("token"));
  EXPECT_EQ(said.output, "fine\n");
  EXPECT_EQ(say(guarded.client("wrong"), "list").output, "this is not the token\n");
  EXPECT_EQ(say("--tls " + guarded.folder.path("certificate.pem") + " ", "list").output,
            "say `authenticate` with the token first\n");
  EXPECT_EQ(say("", "list").exit_code, 1) << "it does not encrypt";
  say(guarded.client("token"), "call stop");
  EXPECT_EQ(run.finish().find("0123456789abcdef"), std::string::npos) << "the token is in no log";
}
#endif
#endif

}  // namespace
}  // namespace muro
