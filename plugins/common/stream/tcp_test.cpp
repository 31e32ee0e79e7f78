// SPDX-License-Identifier: MIT
#include "plugins/common/stream/echo_testing.hpp"

namespace muro::stream {

namespace {

TEST(TcpServer, AnswersEachOfItsClients) {
  Echo echo({"tcp=0"});
  ASSERT_NE(echo.stream.address().port, 0);
  std::vector<Peer> peers;
  for (int i = 0; i < 8; ++i) {
    peers.push_back(Peer::tcp(echo.stream.address().port));
    EXPECT_TRUE(peers.back().say("I am " + std::to_string(i) + "\n"));
  }
  for (int i = 0; i < 8; ++i) {
    const std::string text = "I am " + std::to_string(i) + "\n";
    EXPECT_TRUE(echo.run_until([&] { return peers[std::size_t(i)].hear() == text; })) << peers[std::size_t(i)].heard;
  }
  const Statistics s = echo.stream.statistics();
  EXPECT_EQ(s.clients, 8);
  EXPECT_EQ(s.messages, 8);
  EXPECT_EQ(s.bytes_in, 8 * 7);
  EXPECT_EQ(s.bytes_out, 8 * 7);
}

}  // namespace

}  // namespace muro::stream
