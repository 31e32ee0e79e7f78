// SPDX-License-Identifier: MIT
// Errors of the Open Dynamics Engine, which otherwise end the process.
#include <gtest/gtest.h>
#include <ode/ode.h>

#include "error_trap.hpp"
#include "muro/algorithm.hpp"
#include "ode_library.hpp"
#include "tests/support/complaint.hpp"

namespace muro::ode {
namespace {

struct Log final : Host {
  std::string text;
  void log(LogLevel, std::string_view line) noexcept override { text += std::string(line) + "\n"; }
};

/// Fails an assertion of ODE: a box must not have a negative length.
void fail_an_assertion() { dGeomDestroy(dCreateBox(nullptr, -1, 1, 1)); }

TEST(OdeErrors, AreExceptionsWhileATrapLives) {
  start_library();
  Log log;
  MessageLog messages(log, "motion.ode");
  const std::string text = test::complaint_of<Error>([&] {
    const ErrorTrap trap(messages);
    fail_an_assertion();
  });
  EXPECT_SAYS(text, "ODE: ");
  EXPECT_SAYS(text, "dxBox");
  const std::string error = test::complaint_of<Error>([&] {
    const ErrorTrap trap(messages);
    dError(7, "a table of %d rows", 12);
  });
  EXPECT_EQ(error, "ODE: a table of 12 rows");
}

TEST(OdeErrors, OfOthersEndTheProcessAsBefore) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(
      {
        start_library();
        fail_an_assertion();
      },
      "ODE INTERNAL ERROR");
}

TEST(OdeMessages, AreToldOnceThroughTheLog) {
  start_library();
  Log log;
  MessageLog messages(log, "motion.ode");
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  for (int i = 0; i < 3; ++i) {
    const ErrorTrap trap(messages);
    dMessage(1, "%d rows are too many", 10 + i);
    dMessage(1, "and so are %d columns", i);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(log.text,
            "motion.ode: ODE says once or more often: 10 rows are too many\n"
            "motion.ode: ODE says once or more often: and so are 0 columns\n");
}

}  // namespace
}  // namespace muro::ode
