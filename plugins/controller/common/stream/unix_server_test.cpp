// SPDX-License-Identifier: MIT
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>

#include "plugins/controller/common/stream/echo_testing.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::stream {

namespace {

struct UnixSocket : testing::Test {
  test::ScratchFolder folder;
  const std::string path = folder.path("rover_3.sock");
  const std::string text = "unix=" + folder.path("{robot}.sock");
  bool is_there() const {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0;
  }
  /// Leaves a socket at the path that nobody serves.
  void leave_behind() const { Peer(test::bound_to_unix(path)).close(); }
};

TEST_F(UnixSocket, AnswersClientsOfItsUserAlone) {
  const mode_t mask = ::umask(0);
  std::optional<Echo> echo(std::in_place, std::vector<std::string_view>{text});
  ::umask(mask);
  struct stat status {};
  ASSERT_EQ(::lstat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode, mode_t(S_IFSOCK | 0600));
  Peer one = Peer::unix_socket(path);
  Peer two = Peer::unix_socket(path);
  EXPECT_TRUE(one.say("one\n") && two.say("two\n"));
  EXPECT_TRUE(echo->run_until([&] { return one.hear() == "one\n" && two.hear() == "two\n"; }));
  echo.reset();
  EXPECT_FALSE(is_there());
}

TEST_F(UnixSocket, ReplacesOneThatIsLeftBehind) {
  leave_behind();
  Echo echo({text});
  Peer peer = Peer::unix_socket(path);
  EXPECT_TRUE(peer.say("a\n"));
  EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "a\n"; }));
}

TEST_F(UnixSocket, ReplacesThatOfAProcessThatWasKilled) {
  const pid_t child = ::fork();
  if (child == 0) {
    Echo echo({text});
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && is_there());
  Echo echo({text});
  Peer peer = Peer::unix_socket(path);
  EXPECT_TRUE(peer.say("a\n"));
  EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "a\n"; }));
}

TEST_F(UnixSocket, LeavesThoseOfOthers) {
  Peer other(test::bound_to_unix(path));
  ::listen(other.fd, 1);
  EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({text}); }), "another program serves on it");
  EXPECT_TRUE(is_there());
  other.close();
  ::unlink(path.c_str());

  std::ofstream(path) << "precious";
  const std::string complaint = test::complaint_of<Error>([&] { Echo({text}); });
  EXPECT_SAYS(complaint, path);
  EXPECT_SAYS(complaint, "is no socket");
  EXPECT_EQ(test::text_of(path), "precious");
}

TEST_F(UnixSocket, IsThatOfOneStream) {
  Echo echo({text});
  EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({text}); }), "another stream has it");
  Peer peer = Peer::unix_socket(path);
  EXPECT_TRUE(peer.say("a\n"));
  EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "a\n"; }));
}

TEST_F(UnixSocket, LeavesWhatHasTakenItsPlace) {
  {
    Echo echo({text});
    ::unlink(path.c_str());
    std::ofstream(path) << "another";
  }
  EXPECT_EQ(test::text_of(path), "another");
}

TEST_F(UnixSocket, TellsOfAFolderThatIsNotThere) {
  EXPECT_SAYS(
      test::complaint_of<Error>([&] { Echo({"unix=/no/such/folder/socket"}); }),
      "cannot serve on Unix socket `/no/such/folder/socket`: there is no folder `/no/such/folder`; create it, or "
      "choose another path");
}

}  // namespace

}  // namespace muro::stream
