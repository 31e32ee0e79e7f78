// SPDX-License-Identifier: MIT
// Messages for users who have made a mistake.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace muro::test {

/// Returns the message of the Failure that ends `work`.
template <class Failure = SetupError, class Work>
std::string complaint_of(const Work& work) {
  try {
    work();
  } catch (const Failure& e) {
    return e.what();
  }
  return "no complaint";
}

}  // namespace muro::test

#define EXPECT_SAYS(TEXT, PART) EXPECT_NE((TEXT).find(PART), std::string::npos) << (TEXT)
