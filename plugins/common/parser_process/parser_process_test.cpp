// SPDX-License-Identifier: MIT
// Tests with a parser process that hangs, crashes and uses up memory on request (services_testing.cpp). It is in the
// folder that this program searches first.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <thread>

#include "ask.hpp"
#include "tests/support/processes.hpp"

namespace muro::parser_process {
namespace {

Answer ask_for(const char* service, const std::string& text = "") {
  setenv("MURO_PARSER_SECONDS", "1", 1);
  Writer request;
  request.text(text);
  return ask({.service = service, .subject = "thing /a/b", .needs = "libthing-dev", .advice = "look at it"},
             request.bytes());
}

std::string echo_of(const std::string& text) { return ask_for("echo", text).reader().text(); }

pid_t process() { return ask_for("pid").reader().value<pid_t>(); }

std::string complaint_about(const char* service, const std::string& text = "") {
  try {
    ask_for(service, text);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(ParserProcess, AnswersAnyNumberOfRequestsWithOneProcess) {
  const pid_t first = process();
  EXPECT_NE(first, getpid());
  std::string long_text;
  long_text.resize(20'000'000, 'y');
  for (const std::string& text : {std::string(), std::string("x"), long_text}) EXPECT_EQ(echo_of(text), text);
  EXPECT_EQ(process(), first);
}

TEST(ParserProcess, AnswersThreadsOneAfterTheOther) {
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([t, &right] {
      for (int i = 0; i < 50; ++i) right += echo_of(std::to_string(100 * t + i)) == std::to_string(100 * t + i);
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(right, 400);
}

TEST(ParserProcess, SaysWhatTheServiceSays) {
  EXPECT_EQ(complaint_about("refuse", "thing /a/b is blue; make it red"), "thing /a/b is blue; make it red");
  EXPECT_EQ(complaint_about("unheard of"),
            "thing /a/b cannot be read: this muro was built without; install libthing-dev, configure and build again");
}

TEST(ParserProcess, EndsWithAnErrorWhereItDiesAndIsStartedAgain) {
  const std::vector<std::pair<const char*, std::string>> deaths {
    {"hang", "that took more than 1 s, which is too long for its size (MURO_PARSER_SECONDS=SECONDS allows more)"},
        {"crash", "its reader crashed (SIGSEGV)"}, {"abort", "its reader crashed (SIGABRT: corrupted \\x1b[31m list)"},
        {"leave", "its reader ended with exit code 5"},
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
        {"eat",
         "that needed more than 512 MiB of memory, which is too much for its size (MURO_PARSER_MEMORY=MIB allows "
         "more)"},
#endif
  };
  for (const auto& [service, reason] : deaths) {
    const pid_t before = process();
    EXPECT_EQ(complaint_about(service), "thing /a/b cannot be read: " + reason + "; look at it");
    EXPECT_EQ(echo_of("again"), "again");
    EXPECT_NE(process(), before) << service;
    EXPECT_FALSE(test::is_running(before)) << service;
  }
}

TEST(ParserProcess, IsStartedAgainWhereSomebodyEndedItMeanwhile) {
  const pid_t before = process();
  kill(before, SIGKILL);
  EXPECT_EQ(complaint_about("pid").find("thing /a/b cannot be read: its reader was killed"), 0u);
  EXPECT_NE(process(), before);
}

TEST(ParserProcess, PrintsNothingIntoTheProgramAndHasNoHome) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(ask_for("chatter").reader().text(), "/dev/null");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ParserProcess, IsNotSharedWithAForkAndEndsWithItsProgram) {
  const pid_t ours = process();
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const pid_t theirs = process();
    _exit(write(ends[1], &theirs, sizeof theirs) == sizeof theirs ? 0 : 1);
  }
  pid_t theirs = 0;
  ASSERT_EQ(read(ends[0], &theirs, sizeof theirs), ssize_t(sizeof theirs));
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_NE(theirs, ours);
  EXPECT_EQ(process(), ours);
  EXPECT_TRUE(test::ends_soon(theirs));
  close(ends[0]);
  close(ends[1]);
}

}  // namespace
}  // namespace muro::parser_process
