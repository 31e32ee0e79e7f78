// SPDX-License-Identifier: MIT
// Uses child_testing.cpp as the child.
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <cstddef>
#include <filesystem>

#include "as_child.hpp"
#include "child_process.hpp"
#include "own_folder.hpp"
#include "tests/support/processes.hpp"

namespace muro {
namespace {

using namespace std::chrono_literals;
using Transfer = ChildProcess::Transfer;

ChildProcess::Setup child_that(const std::string& does) { return {own_folder() + "/child_for_tests", {does}}; }

/// Returns all that the child writes until its end.
std::string words_of(const ChildProcess::Setup& setup) {
  ChildProcess child;
  EXPECT_EQ(child.start(setup), 0);
  EXPECT_TRUE(child.ends_within(20s));
  return child.take_rest(4096);
}

int number_from(ChildProcess& child) {
  int number = 0;
  EXPECT_EQ(child.receive(&number, sizeof number, ChildProcess::Clock::now() + 20s), Transfer::whole);
  return number;
}

TEST(ChildProcess, HasTheFilesThatItIsGivenAndNoOthers) {
  const Descriptor low(dup(0)), high(fcntl(0, F_DUPFD, 100));  // exec does not close these
  ASSERT_TRUE(low && high);
  ChildProcess::Setup setup = child_that("descriptors");
  EXPECT_EQ(words_of(setup), "0 1 2 3 ");
  setup.files = {{high.get(), 6}, {low.get(), 4}, {low.get(), 1}};
  EXPECT_EQ(words_of(setup), "0 1 2 3 4 6 ");
}

TEST(ChildProcess, HasTheSignalsOfANewProgram) {
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, SIGTERM);
  sigprocmask(SIG_BLOCK, &one, nullptr);
  signal(SIGUSR1, SIG_IGN);
  EXPECT_EQ(words_of(child_that("signals")), "free default");
  sigprocmask(SIG_UNBLOCK, &one, nullptr);
  signal(SIGUSR1, SIG_DFL);
}

TEST(ChildProcess, HasOurEnvironmentButWhatIsReplaced) {
  setenv("MURO_TEST_A", "ours", 1);
  setenv("MURO_TEST_B", "ours", 1);
  ChildProcess::Setup setup = child_that("environment");
  setup.environment = {"MURO_TEST_B=its own"};
  EXPECT_EQ(words_of(setup), "ours its own");
}

TEST(ChildProcess, SaysHowItHasEnded) {
  ChildProcess child;
  EXPECT_EQ(child.start({"/nowhere/at all"}), ENOENT);
  EXPECT_FALSE(child);
  ASSERT_EQ(child.start(child_that("leave")), 0);
  const ChildProcess::End left = child.end(20s);
  EXPECT_TRUE(left.exit_code == 5 && left.signal == 0 && !left.was_ours);
  ASSERT_EQ(child.start(child_that("wait")), 0);
  EXPECT_TRUE(child.is_running());
  child.signal(SIGUSR1);
  const ChildProcess::End died = child.end(20s);
  EXPECT_FALSE(died.may_be_from_outside() || left.may_be_from_outside());
  EXPECT_TRUE(died.signal == SIGUSR1 && died.exit_code == -1 && !died.was_ours);
  ASSERT_EQ(child.start(child_that("wait")), 0);
  const ChildProcess::End killed = child.end();
  EXPECT_TRUE(killed.signal == SIGKILL && killed.was_ours && !killed.may_be_from_outside());
  ASSERT_EQ(child.start(child_that("wait")), 0);
  child.signal(SIGKILL);
  EXPECT_TRUE(child.end(20s).may_be_from_outside());
  EXPECT_FALSE(child.is_running());
  EXPECT_EQ(name_of_signal(SIGKILL), "SIGKILL");
  EXPECT_TRUE(test::child_processes().empty());
}

TEST(ChildProcess, SaysHowItHasEndedWhereItsSocketTellsFirst) {
  for (const int number : {SIGKILL, SIGTERM, SIGUSR1})
    for (int i = 0; i < 50; ++i) {
      ChildProcess child;
      ASSERT_EQ(child.start(child_that("say_and_wait")), 0);
      int found = number_from(child);
      child.signal(number);
      ASSERT_EQ(child.receive(&found, sizeof found), Transfer::broken);
      const ChildProcess::End how = child.end();
      ASSERT_EQ(how.signal, number);
      ASSERT_FALSE(how.was_ours);
      ASSERT_EQ(how.may_be_from_outside(), number != SIGUSR1);
    }
}

/// Makes the system report from now on that it has no descriptors of processes.
bool forbid_descriptors_of_processes() {
  sock_filter program[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                           BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_pidfd_open, 0, 1),
                           BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
                           BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog filter{std::size(program), program};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

/// Returns a number for what goes wrong; 0: nothing.
int without_descriptors_of_processes() {
  if (!forbid_descriptors_of_processes()) return 1;
  ChildProcess child;
  if (child.start(child_that("leave")) != 0) return 2;
  const ChildProcess::End left = child.end(20s);
  if (left.exit_code != 5 || left.was_ours) return 3;
  if (child.start(child_that("say_and_wait")) != 0) return 4;
  int number = 0;
  if (child.receive(&number, sizeof number, ChildProcess::Clock::now() + 20s) != Transfer::whole) return 5;
  if (child.receive(&number, sizeof number, ChildProcess::Clock::now() + 20ms) != Transfer::late) return 6;
  if (!child.is_running()) return 7;
  child.signal(SIGUSR1);
  if (child.receive(&number, sizeof number, ChildProcess::Clock::now() + 20s) != Transfer::broken) return 8;
  if (const ChildProcess::End died = child.end(20s); died.signal != SIGUSR1 || died.was_ours) return 9;
  if (child.start(child_that("wait")) != 0) return 10;
  if (!child.end().was_ours) return 11;
  return test::child_processes().empty() ? 0 : 12;
}

TEST(ChildProcess, NeedsNoDescriptorsOfProcesses) {
  EXPECT_EXIT(_exit(without_descriptors_of_processes()), ::testing::ExitedWithCode(0), "");
}

TEST(ChildProcess, IsWaitedForAsLongAsIsSaid) {
  ChildProcess child;
  ASSERT_EQ(child.start(child_that("wait")), 0);
  std::string much;
  much.resize(10'000'000, 'x');
  int number = 0;
  EXPECT_EQ(child.send(much.data(), much.size(), ChildProcess::Clock::now() + 50ms), Transfer::late);
  EXPECT_EQ(child.receive(&number, sizeof number, ChildProcess::Clock::now() + 50ms), Transfer::late);
  EXPECT_FALSE(child.ends_within(50ms));
}

TEST(ChildProcess, TakesItsChildrenAlong) {
  for (const char* does : {"another", "another_and_wait", "another_and_crash"}) {
    ChildProcess child;
    ASSERT_EQ(child.start(child_that(does)), 0);
    const pid_t other = number_from(child);
    EXPECT_TRUE(test::is_running(other));
    child.end();
    EXPECT_TRUE(test::ends_soon(other)) << does;
  }
}

TEST(ChildProcess, IsFoundGoneWhereOneOfItsChildrenHasItsSocket) {
  ChildProcess child;
  ASSERT_EQ(child.start(child_that("another_and_crash")), 0);
  const pid_t other = number_from(child);
  int number = 0;
  EXPECT_EQ(child.receive(&number, sizeof number), Transfer::broken);
  EXPECT_TRUE(test::is_running(other));
}

TEST(ChildProcess, EndsWithItsParentWhateverItHasClosed) {
  for (const char* does : {"close_all", "another_and_wait"}) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t parent = fork();
    if (parent == 0) {
      ChildProcess child;
      const int told = child.start(child_that(does)) == 0 ? number_from(child) : 0;
      _exit(write(ends[1], &told, sizeof told) == sizeof told ? 0 : 1);  // without a destructor
    }
    pid_t told = 0;
    EXPECT_EQ(read(ends[0], &told, sizeof told), ssize_t(sizeof told));
    EXPECT_EQ(waitpid(parent, nullptr, 0), parent);
    EXPECT_GT(told, 0);
    EXPECT_TRUE(test::ends_soon(told)) << does;
    close(ends[0]);
    close(ends[1]);
  }
}

TEST(ChildProcess, GoesOnWithoutItsDescriptorsAlsoWhereItWasStopped) {
  ChildProcess child;
  ASSERT_EQ(child.start(child_that("close_all")), 0);
  const pid_t pid = number_from(child);
  const std::string descriptors = "/proc/" + std::to_string(pid) + "/fd";
  for (int i = 0; i < 1000 && !std::filesystem::is_empty(descriptors); ++i) usleep(10'000);
  for (const int number : {SIGSTOP, SIGCONT}) {
    child.signal(number);
    EXPECT_TRUE(test::comes_to(pid, number == SIGSTOP ? "T" : "SR"));
  }
  EXPECT_FALSE(child.ends_within(100ms));
}

TEST(ChildProcess, ThatHasClosedItsSocketSaysSoWhenItIsToSaySomething) {
  ChildProcess child;
  ASSERT_EQ(child.start(child_that("close_all_and_say")), 0);
  EXPECT_EQ(child.end(20s).exit_code, as_child::exit_without_socket);
}

TEST(ChildProcess, IsNoMatterOfAForkOfItsParent) {
  ChildProcess child;
  ASSERT_EQ(child.start(child_that("wait")), 0);
  const pid_t fork_of_us = fork();
  if (fork_of_us == 0) {
    const bool is_theirs = bool(child);
    child.end();
    _exit(is_theirs ? 1 : 0);
  }
  int status = 1;
  ASSERT_EQ(waitpid(fork_of_us, &status, 0), fork_of_us);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(child.is_running());
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ChildProcess, TellsOfACrashAlsoWhereItsStackIsUsedUp) {
  ChildProcess child;
  ASSERT_EQ(child.start(child_that("recurse")), 0);
  EXPECT_EQ(number_from(child), SIGSEGV);
  EXPECT_EQ(child.end(20s).signal, SIGSEGV);
}
#endif

}  // namespace
}  // namespace muro
