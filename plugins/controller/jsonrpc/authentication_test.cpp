// SPDX-License-Identifier: MIT
// Servers with a token: a client that does not give it gets nothing.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "muro/algorithm.hpp"
#include "service_testing.hpp"
#include "token.hpp"

namespace muro::jsonrpc {
namespace {

using testing::Dialogue;
using testing::request;

const std::string secret = "0123456789abcdef-0123456789abcdef";

/// A client of a server with a token.
struct Guarded : Dialogue {
  Guarded() {
    service.set_token(secret);
    service.connected(7);
  }
  std::string say_token(const std::string& token) { return say(request("authenticate", "[\"" + token + "\"]"), 7); }
};

TEST(Authentication, ComesBeforeEverythingElse) {
  Guarded d;
  for (const char* method : {"time", "list", "set", "step", "nothing"}) {
    const Json reply = Json::parse(d.say(request(method), 7));
    EXPECT_EQ(reply["error"]["code"], -32004) << method;
  }
  EXPECT_NE(d.say_token(secret).find(R"("result":{"authenticated":true})"), std::string::npos);
  EXPECT_NE(d.say(request("time"), 7).find("result"), std::string::npos);
}

TEST(Authentication, EndsTheConnectionAfterThreeWrongTokens) {
  Guarded d;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(Json::parse(d.say_token(secret + "x"))["error"]["code"], -32004);
  EXPECT_TRUE(d.outlet.ended.empty());
  const std::string reply = d.say_token(secret.substr(1));
  EXPECT_EQ(reply.find(secret.substr(1)), std::string::npos) << "what was said is not repeated";
  EXPECT_EQ(d.outlet.ended, std::vector<std::uint32_t>{7});
  EXPECT_EQ(d.say_token(secret), "") << "nobody listens any more";
}

TEST(Authentication, DoesNotTryMoreThanThreeOfABatch) {
  Guarded d;
  std::string batch = "[";
  for (int i = 0; i < 3; ++i) batch += R"({"jsonrpc":"2.0","id":1,"method":"authenticate","params":["x"]},)";
  batch += R"({"jsonrpc":"2.0","id":2,"method":"authenticate","params":[")" + secret + "\"]}]\n";
  EXPECT_EQ(d.say(batch, 7).find("result"), std::string::npos);
  EXPECT_EQ(d.outlet.ended, std::vector<std::uint32_t>{7});
}

TEST(Authentication, ComparesAllOfTheToken) {
  EXPECT_TRUE(is_same_token(secret, secret));
  for (std::size_t i = 0; i < secret.size(); ++i) {
    std::string wrong = secret;
    wrong[i] ^= 1;
    EXPECT_FALSE(is_same_token(wrong, secret)) << i;
    EXPECT_FALSE(is_same_token(secret.substr(0, i), secret)) << i;
  }
  EXPECT_FALSE(is_same_token(secret + secret, secret));
}

std::string complaint(const TokenSource& source) {
  try {
    return "read " + read_token(source);
  } catch (const Error& e) {
    return e.what();
  }
}

TEST(Token, ComesFromAFileOfItsUserAloneOrTheEnvironment) {
  const std::string path = ::testing::TempDir() + "muro_token_" + std::to_string(getpid());
  std::ofstream(path) << "  " << secret << "\r\n";
  ::chmod(path.c_str(), 0640);
  EXPECT_NE(complaint({path, ""}).find("can be read or written by others; chmod 600 it"), std::string::npos);
  ::chmod(path.c_str(), 0600);
  EXPECT_EQ(complaint({path, ""}), "read " + secret);
  std::ofstream(path) << "short";
  EXPECT_NE(complaint({path, ""}).find("must hold a secret of 16 to 4096 bytes"), std::string::npos);
  EXPECT_EQ(complaint({path, ""}).find("short"), std::string::npos) << "no message has it";
  std::filesystem::remove(path);
  EXPECT_NE(complaint({path, ""}).find("cannot be read"), std::string::npos);
  ::setenv("MURO_TEST_TOKEN", secret.c_str(), 1);
  EXPECT_EQ(complaint({"", "MURO_TEST_TOKEN"}), "read " + secret);
  ::unsetenv("MURO_TEST_TOKEN");
  EXPECT_NE(complaint({"", "MURO_TEST_TOKEN"}).find("the environment's `MURO_TEST_TOKEN` must hold"),
            std::string::npos);
}

TEST(Token, IsNeverInAScenario) {
  const std::string_view itself[] = {"0123456789abcdef"}, both[] = {"file=a", "environment=B"};
  EXPECT_THROW(read_token_source(itself), Error);
  EXPECT_THROW(read_token_source(both), Error);
  const std::string_view file[] = {"file=a=b"};
  EXPECT_EQ(read_token_source(file).file, "a=b");
}

}  // namespace
}  // namespace muro::jsonrpc
