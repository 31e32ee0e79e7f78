// SPDX-License-Identifier: MIT
#include "csv_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <random>
#include <thread>

#include "muro/algorithm.hpp"
#include "plugins/common/text/glob.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::complaint_of;
using test::ScratchFolder;
using test::text_of;

void add_row(CsvFile& file, std::int64_t time, double value) {
  file.time(time);
  file.number(Scalar::f64, &value);
  file.end_row();
}

TEST(Glob, StarsAndQuestionMarksStandForCharacters) {
  EXPECT_TRUE(matches("rover_*/base_link:pose", "rover_12/base_link:pose"));
  EXPECT_TRUE(matches("*:pose", "a/b:pose"));
  EXPECT_TRUE(matches("a?c", "abc"));
  EXPECT_TRUE(matches("*a*b*", "xxaxxbxx"));
  EXPECT_FALSE(matches("*a*b", "xxaxxbxx"));
  EXPECT_FALSE(matches("a?c", "ac"));
  EXPECT_FALSE(matches("", "a"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("a*?", "ab"));
  EXPECT_FALSE(matches("a*?", "a"));
}

/// Matches `*` and `?` by their definition: tries every split.
bool matches_by_definition(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern[0] == '*')
    return matches_by_definition(pattern.substr(1), text) ||
           (!text.empty() && matches_by_definition(pattern, text.substr(1)));
  return !text.empty() && (pattern[0] == '?' || pattern[0] == text[0]) &&
         matches_by_definition(pattern.substr(1), text.substr(1));
}

TEST(Glob, AgreesWithItsDefinitionOnRandomTexts) {
  std::mt19937 engine(3);
  const auto word = [&](std::string_view letters) {
    std::string w(engine() % 8, ' ');
    for (char& c : w) c = letters[engine() % letters.size()];
    return w;
  };
  int fitting = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string pattern = word("ab*?"), text = word("ab");
    EXPECT_EQ(matches(pattern, text), matches_by_definition(pattern, text)) << pattern << " " << text;
    fitting += matches(pattern, text) ? 1 : 0;
  }
  EXPECT_GT(fitting, 1000);
}

TEST(CsvFile, QuotesAsRfc4180Says) {
  const ScratchFolder folder;
  CsvFile file(folder.path("a.csv"));
  for (const char* field : {"plain", "a,b", "say \"no\"", "two\nlines", "", " spaces "}) file.text(field);
  file.end_row();
  file.publish();
  EXPECT_EQ(text_of(folder.path("a.csv")), "plain,\"a,b\",\"say \"\"no\"\"\",\"two\nlines\",, spaces \r\n");
}

TEST(CsvFile, WritesTheShortestNumbersThatReadBackToTheBit) {
  const ScratchFolder folder;
  std::mt19937_64 engine(5);
  std::vector<double> numbers{0.0, -0.0, 0.1, 1e300, 5e-324, 1.0 / 3};
  while (numbers.size() < 1000) {
    const std::uint64_t bits = engine();
    double d = 0;
    std::memcpy(&d, &bits, sizeof d);
    if (std::isfinite(d)) numbers.push_back(d);
  }
  CsvFile file(folder.path("a.csv"));
  for (const double d : numbers) file.number(Scalar::f64, &d);
  file.publish();
  const std::string text = text_of(folder.path("a.csv"));
  EXPECT_EQ(text.substr(0, 13), "0,-0,0.1,1e+3");
  const char* at = text.data();
  for (const double d : numbers) {
    char* end = nullptr;
    const double back = std::strtod(at, &end);
    EXPECT_EQ(std::memcmp(&back, &d, sizeof d), 0) << d;
    at = end + 1;
  }
}

TEST(CsvFile, WritesEveryTypeOfNumber) {
  const ScratchFolder folder;
  CsvFile file(folder.path("a.csv"));
  const float f = 0.1f;
  const std::int64_t i64 = INT64_MIN;
  const std::uint64_t u64 = UINT64_MAX;
  const std::int32_t i32 = -7;
  const std::uint32_t u32 = 4000000000u;
  const std::uint8_t u8 = 200;
  const double none = std::nan(""), endless = -HUGE_VAL;
  file.number(Scalar::f32, &f);
  file.number(Scalar::i64, &i64);
  file.number(Scalar::u64, &u64);
  file.number(Scalar::i32, &i32);
  file.number(Scalar::u32, &u32);
  file.number(Scalar::u8, &u8);
  file.number(Scalar::f64, &none);
  file.number(Scalar::f64, &endless);
  file.end_row();
  file.publish();
  EXPECT_EQ(text_of(folder.path("a.csv")),
            "0.1,-9223372036854775808,18446744073709551615,-7,4000000000,200,nan,-inf\r\n");
}

TEST(CsvFile, WritesTimeAsExactDecimals) {
  const ScratchFolder folder;
  CsvFile file(folder.path("a.csv"));
  for (const std::int64_t t : {0L, 1L, 100'000'000L, 33'333'333L, 1'000'000'000L, 3'600'000'000'500L, 1'020'000'000L})
    file.time(t);
  file.publish();
  EXPECT_EQ(text_of(folder.path("a.csv")), "0,0.000000001,0.1,0.033333333,1,3600.0000005,1.02");
}

TEST(CsvFile, KeepsWhatWasThereUntilTheNewFileIsWhole) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.csv", "old");
  {
    CsvFile file(path);
    add_row(file, 0, 1);
    EXPECT_EQ(text_of(path), "old");
  }
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(text_of(path + ".part"), "0,1\r\n") << "of a run that failed";
  CsvFile file(path);
  add_row(file, 0, 2);
  file.publish();
  EXPECT_EQ(text_of(path), "0,2\r\n");
  EXPECT_EQ(text_of(path + ".part"), "0,1\r\n") << "nobody else touches it";
  EXPECT_FALSE(std::filesystem::exists(path + ".part2"));
  add_row(file, 1'000'000'000, 3);
  file.publish();
  EXPECT_EQ(text_of(path), "0,2\r\n1,3\r\n") << "the run went on";
}

TEST(CsvFile, CutsBackToATime) {
  const ScratchFolder folder;
  const std::string path = folder.path("a.csv");
  for (const bool published : {false, true}) {
    CsvFile file(path);
    file.text("time");
    file.text("1.5\n");  // a line within a field is no time
    file.end_row();
    for (int i = 0; i < 20000; ++i) add_row(file, i * 50'000'000L, i);
    if (published) file.publish();
    file.cut_back(149'999'999);
    add_row(file, 149'999'999, 0.25);
    file.publish();
    EXPECT_EQ(text_of(path), "time,\"1.5\n\"\r\n0,0\r\n0.05,1\r\n0.1,2\r\n0.149999999,0.25\r\n") << published;
  }
}

TEST(CsvFile, SaysWhyItCannotBeWritten) {
  EXPECT_EQ(complaint_of<Error>([] { CsvFile("/nowhere/at/all.csv"); }),
            "file /nowhere/at/all.csv cannot be written: No such file or directory");
  const ScratchFolder folder;
  EXPECT_EQ(complaint_of<Error>([&] { CsvFile(folder.path("")); }),
            "file " + folder.path("") + " cannot be written: Is a directory");
  EXPECT_EQ(complaint_of<Error>([] {
              CsvFile full("/dev/full");
              full.text("x");
              full.publish();
            }),
            "file /dev/full cannot be written: No space left on device");
}

TEST(CsvFile, TwoCannotWriteOneFile) {
  const ScratchFolder folder;
  const std::string path = folder.path("a.csv");
  CsvFile first(path);
  add_row(first, 0, 1);
  EXPECT_EQ(complaint_of<Error>([&] { CsvFile second(path); }),
            "file " + path + " is being written by another recorder or run; give each a file of its own");
  first.publish();
  EXPECT_EQ(text_of(path), "0,1\r\n");
}

TEST(CsvFile, WritesAPipeToItsReader) {
  const ScratchFolder folder;
  const std::string path = folder.path("pipe");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::string seen;
  std::thread reader([&] { seen = text_of(path); });
  {
    CsvFile file(path);
    add_row(file, 0, 1);
    file.publish();
    EXPECT_TRUE(std::filesystem::is_fifo(path));
  }
  reader.join();
  EXPECT_EQ(seen, "0,1\r\n");
}

/// A limit on file sizes replaces a full disk. It holds for the whole process, so this test runs in one of its own.
TEST(CsvFile, OnAFullDiskKeepsItsWholeRows) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.csv", "old");
  const auto fill = [&] {
    const rlimit limit{100'000, 100'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    std::string said;
    {
      CsvFile file(path);
      said = complaint_of<Error>([&] {
        for (int i = 0; i < 100'000; ++i) add_row(file, i * 1'000'000L, 0.1);
      });
      file.publish();  // the failure has been reported
    }
    std::_Exit(said == "file " + path + " cannot be written: File too large" ? 0 : 1);
  };
  EXPECT_EXIT(fill(), ::testing::ExitedWithCode(0), "");
  EXPECT_EQ(text_of(path), "old");
  const std::string part = text_of(path + ".part");
  EXPECT_GT(part.size(), 99'900u);
  EXPECT_EQ(part.substr(part.size() - 6), ",0.1\r\n");
}

}  // namespace
}  // namespace muro
