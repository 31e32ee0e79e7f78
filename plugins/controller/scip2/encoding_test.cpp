// SPDX-License-Identifier: MIT
#include "encoding.hpp"

#include "scip2_testing.hpp"

namespace muro::scip2 {
namespace {

std::string encoded(std::uint32_t value, int characters) {
  std::string text;
  ReplyWriter(text).value(value, characters);
  return text;
}

TEST(Scip2Encoding, SumsOfStatusesAreThoseOfRealDevices) {
  const std::pair<const char*, char> known[] = {{"00", 'P'}, {"99", 'b'}, {"02", 'R'}, {"03", 'S'},
                                                {"10", 'Q'}, {"0A", 'a'}, {"0E", 'e'}, {"0C", 'c'}};
  for (const auto& [status, sum] : known) EXPECT_EQ(sum_of(status), sum) << status;
}

TEST(Scip2Encoding, ValuesAreThoseOfTheSpecification) {
  EXPECT_EQ(encoded(1234, 2), "CB");
  EXPECT_EQ(encoded(5432, 3), "1Dh");
  EXPECT_EQ(encoded(16000000, 4), "m2@0");
  for (const auto& [value, characters] : {std::pair{4095u, 2}, {262143u, 3}, {16777215u, 4}, {0u, 3}})
    EXPECT_EQ(decoded(encoded(value, characters)), long(value));
}

TEST(Scip2Encoding, ALineOfSixtyFourCharactersIsFollowedByNoEmptyOne) {
  std::string text;
  ReplyWriter r(text);
  r.begin_block();
  for (int i = 0; i < 32; ++i) r.value(1234, 2);
  r.end_block();
  EXPECT_EQ(text.size(), 66u);
  EXPECT_EQ(text.find('\n'), 65u);
}

TEST(Scip2Encoding, AValueOfThreeCharactersMayStraddleTwoLines) {
  std::string text;
  ReplyWriter r(text);
  r.begin_block();
  for (int i = 0; i < 22; ++i) r.value(5432, 3);
  r.end_block();
  EXPECT_EQ(text.substr(63, 1), "1");
  EXPECT_EQ(text.substr(64, 2), std::string(1, expected_sum(text.substr(0, 64))) + "\n");
  EXPECT_EQ(text.substr(66, 2), "Dh");
}

}  // namespace
}  // namespace muro::scip2
