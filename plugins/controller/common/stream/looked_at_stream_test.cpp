// SPDX-License-Identifier: MIT
// Messages of `muro check` about streams. The check does not open them.
#include "plugins/controller/common/stream/looked_at_stream.hpp"

#include <filesystem>
#include <vector>

#include "plugins/controller/common/stream/echo_testing.hpp"
#include "plugins/controller/common/stream/fake_host_testing.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::stream {

namespace {

struct AStreamThatIsOnlyLookedAt : testing::Test {
  AStreamThatIsOnlyLookedAt() { inputs.opens = false; }
  test::ScratchFolder folder;
  FakeInputs inputs;

  /// Returns the error when streams are checked one after the other and exist together.
  std::string complaint(const std::vector<std::string>& addresses) const {
    std::vector<std::unique_ptr<LookedAtStream>> all;
    return test::complaint_of<Error>([&] {
      for (const std::string& text : addresses) {
        const FakeConnector connector;
        const std::string_view texts[] = {text};
        all.push_back(std::make_unique<LookedAtStream>("laser", read_address(connector, 0, texts)));
      }
    });
  }
};

TEST_F(AStreamThatIsOnlyLookedAt, OpensNothing) {
  EXPECT_EQ(complaint({"unix=" + folder.path("a.sock"), "pty=" + folder.path("b.laser"), "tcp=0", "tcp=0"}),
            "no complaint");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
}

TEST_F(AStreamThatIsOnlyLookedAt, HasAPortOfItsOwn) {
  EXPECT_EQ(complaint({"tcp=4001", "tcp=4002"}), "no complaint");
  EXPECT_SAYS(complaint({"tcp=4001", "tcp=4002", "tcp=4001"}),
              "stream `laser` cannot serve on tcp 127.0.0.1:4001: port 4001 is taken, by another program or by another "
              "stream of this scenario; choose another one");
}

TEST_F(AStreamThatIsOnlyLookedAt, HasAFolderForItsSocketOrTerminal) {
  const std::string gone = folder.path("gone");
  for (const char* kind : {"unix=", "pty="})
    EXPECT_SAYS(complaint({kind + gone + "/a"}),
                "there is no folder `" + gone + "`; create it, or choose another path");
  const std::string file = folder.file("plain.txt", "");
  EXPECT_SAYS(complaint({"unix=" + file}), "there is a file of this name that is no socket");
  EXPECT_SAYS(complaint({"pty=" + file}), "there is a file of this name that is no link to a terminal");
  EXPECT_SAYS(complaint({"unix=" + folder.path("a"), "unix=" + folder.path("a")}), "another stream has it");
}

TEST_F(AStreamThatIsOnlyLookedAt, KnowsTheKindsOfARecording) {
  FakeConnector connector;
  connector.fake_host.inputs = &inputs;
  inputs.replays = true;
  inputs.inputs = {{-1, 0, 0, ""}, {-1, 1, 0, "BM"}, {-1, 4, 0, ""}};  // the host shows all inputs
  const std::string_view texts[] = {"tcp=4001"};
  Stream stream(connector, "laser", read_address(connector, 0, texts), {});
  EXPECT_SAYS(test::complaint_of<Error>([&] { stream.open(); }),
              "the recording cannot be replayed: kind 4 of stream `laser` is none of 0 to 3");
}

}  // namespace

}  // namespace muro::stream
