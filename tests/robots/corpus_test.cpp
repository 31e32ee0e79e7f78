// SPDX-License-Identifier: MIT
#include "tests/robots/corpus.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "tests/robots/trial.hpp"
#include "tests/support/files.hpp"

namespace muro::robots {
namespace {

TEST(Isolation, TellsACrashFromATextFromALoop) {
  EXPECT_EQ(isolated([] { return std::string("done"); }, 10).text, "done");
  const Isolated crash = isolated([]() -> std::string { abort(); }, 10);
  EXPECT_TRUE(crash.crashed);
  EXPECT_EQ(crash.text, "failed: crashed, signal 6");
  const Isolated endless = isolated(
      []() -> std::string {
        for (;;) pause();
      },
      0.2);
  EXPECT_TRUE(endless.too_long);
  EXPECT_EQ(endless.text, "failed: not done after 0.2 s");
  EXPECT_EQ(isolated([] { return std::string(100'000, 'x'); }, 10).text.size(), 100'000u);
}

TEST(Corpus, GoesOnBehindADescriptionThatCannotBeRead) {
  test::ScratchFolder folder;
  folder.file("a/failure.urdf", "<robot name=\"failure\"><link");
  folder.file("b/ball.urdf", test::text_of(MURO_TEST_SOURCE_DIR "/tests/robots/balancer.urdf"));
  std::ostringstream table;
  const CorpusCount count = run_corpus(folder.path("."), 0.1, 30, table);
  EXPECT_EQ(count.refused, int(motions().size())) << table.str();
  EXPECT_EQ(count.fine, int(motions().size())) << table.str();
  EXPECT_EQ(count.failed, 0) << table.str();
  EXPECT_NE(table.str().find("a/failure.urdf"), std::string::npos);
}

/// MURO_ROBOT_CORPUS names the folder; see README.md.
TEST(Corpus, OfTheUserRunsInEveryMotionOrIsRefused) {
  const char* given = std::getenv("MURO_ROBOT_CORPUS");
  const std::string folder = given ? given : MURO_TEST_SOURCE_DIR "/examples/models";
  const CorpusCount count = run_corpus(folder, given ? 1.0 : 0.1, 60, std::cout);
  EXPECT_EQ(count.failed, 0) << "see the table";
  EXPECT_GT(count.fine + count.odd + count.refused, 0) << "no .urdf in " << folder;
}

}  // namespace
}  // namespace muro::robots
