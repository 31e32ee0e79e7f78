// SPDX-License-Identifier: MIT
#include "part_file.hpp"

#include <gtest/gtest.h>

#include "muro/algorithm.hpp"

namespace muro {
namespace {

TEST(PartFile, HasSectionsNumbersAndTexts) {
  const PartFile f = PartFile::parse(
      "# of a motor\nsource: \"a # sheet\"  # not this\nunit: N m\r\n\nm1:\n  kt: 1.5 # N m/A\n  r: -2e-3\nm4:\n  kt: "
      "2\nlast: 1",
      "f");
  EXPECT_EQ(f.find("", "source")->value, "a # sheet");
  EXPECT_EQ(f.find("", "unit")->value, "N m");
  EXPECT_EQ(f.number("m1", "kt"), 1.5);
  EXPECT_EQ(f.number("m1", "r"), -2e-3);
  EXPECT_EQ(f.number("m4", "kt"), 2);
  EXPECT_EQ(f.number("", "last"), 1);
  EXPECT_EQ(f.number("m4", "r"), std::nullopt);
  EXPECT_EQ(f.sections(), (std::vector<std::string>{"m1", "m4"}));
}

std::string complaint_about(const std::string& text) {
  try {
    const PartFile f = PartFile::parse(text, "my.yaml");
    f.check_names("m1", std::vector<std::string_view>{"kt", "resistance"});
    f.number("m1", "kt");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(PartFile, MistakesAreNamedWithLineAndColumn) {
  const std::pair<std::string, std::string> cases[] = {
      {"a: 1\n= 2\n", "my.yaml:2:1: a line of a part file is"},
      {"a: 1\nb 2\n", "my.yaml:2:2: a `:` is missing after `b`"},
      {"a: \"open\n", "my.yaml:1:4: the quote is not closed"},
      {"a: \"b\" c\n", "my.yaml:1:8: there is more after the value of `a`"},
      {"m1:\n  kt: 1\n  kt: 2\n", "my.yaml:3:8: `kt` stands in line 2 already"},
      {"m1:\n  kt:\n", "my.yaml:2:6: `kt` has no value"},
      {"m1:\n  kt: 1,5\n", "my.yaml:2:7: `kt` is `1,5`, which is no number"},
      {"m1:\n  kt: nan\n", "my.yaml:2:7: `kt` is `nan`, which is no number"},
      {"m1:\n  resistence: 1\n", "my.yaml:2:3: there is no parameter `resistence` (did you mean `resistance`?)"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_NE(complaint_about(text).find(message), std::string::npos) << text << complaint_about(text);
}

TEST(PartFile, NumbersMayStandInBrackets) {
  const PartFile f = PartFile::parse("a: [1, -2e3 ,3]  # three\nb: 4\nc: [1, x]\nd: [1\ne: []\n", "my.yaml");
  EXPECT_EQ(f.numbers(*f.find("", "a")), (std::vector<double>{1, -2e3, 3}));
  EXPECT_EQ(f.numbers(*f.find("", "b")), (std::vector<double>{4}));
  for (const auto& [name, message] :
       {std::pair("c", "my.yaml:3:4: `c` is `x`, which is no number"),
        std::pair("d", "my.yaml:4:4: `]` is missing: a list of numbers stands in one line"),
        std::pair("e", "my.yaml:5:4: `e` is ``, which is no number")}) {
    try {
      f.numbers(*f.find("", name));
      ADD_FAILURE() << name;
    } catch (const Error& e) {
      EXPECT_STREQ(e.what(), message);
    }
  }
}

TEST(PartFile, AnUnknownPartIsToldWithThoseThatAreReady) {
  constexpr ReadyPart ready[] = {{"mx28", "a: 1"}, {"mx64", "a: 2"}};
  EXPECT_EQ(find_part("mx64", "", ready).number("", "a"), 2);
  try {
    find_part("mx63", "", ready);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("ready are `mx28`, `mx64`"), std::string::npos) << e.what();
  }
  EXPECT_THROW(find_part("none.yaml", "/nowhere/none.yaml", ready), Error);
}

}  // namespace
}  // namespace muro
