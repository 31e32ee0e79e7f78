// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <gtest/gtest.h>

#include "muro/algorithm.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::inputs {
namespace {

class ARecording : public testing::Test {
 protected:
  std::string write(const std::string& text) { return folder_.file("inputs.csv", text); }
  std::string complaint(const std::string& text) {
    const std::string path = write(text);
    return test::complaint_of<Error>([&] { read_recording(path); });
  }
  test::ScratchFolder folder_;
};

const std::string header = "muro external inputs,1,0123456789abcdef\nepoch,time,channel,kind,source,bytes\n";

TEST_F(ARecording, ReadsBackWhatWasWritten) {
  std::string all_bytes;
  for (int i = 0; i < 256; ++i) all_bytes += char(i);
  const RecordedInput inputs[] = {{"rovers_0/laser", 0, 0, {1, 7, "BM\n"}},
                                  {"a,b%\n", 0, 123456789012345, {2, 0, all_bytes}},
                                  {"simulation", 3, 5, {0, 4294967295u, ""}}};
  std::string text = header_line(0xfeed);
  for (const RecordedInput& i : inputs) add_line(text, i);
  text += end_line({3, 99, ~0ull});
  const Recording read = read_recording(write(text));
  EXPECT_EQ(read.initial_hash, 0xfeedu);
  EXPECT_EQ(read.end, (RunEnd{3, 99, ~0ull}));
  ASSERT_EQ(read.inputs.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.inputs[i].channel, inputs[i].channel);
    EXPECT_EQ(read.inputs[i].epoch, inputs[i].epoch);
    EXPECT_EQ(read.inputs[i].time, inputs[i].time);
    EXPECT_EQ(read.inputs[i].input.kind, inputs[i].input.kind);
    EXPECT_EQ(read.inputs[i].input.source, inputs[i].input.source);
    EXPECT_EQ(read.inputs[i].input.bytes, inputs[i].input.bytes);
  }
}

TEST_F(ARecording, IsTextThatAPersonCanReadAndWrite) {
  const Recording read = read_recording(write(header + "0,100000000,rovers_0/laser,1,0,MD0044072501000%0A\n"));
  EXPECT_FALSE(read.end);
  ASSERT_EQ(read.inputs.size(), 1u);
  EXPECT_EQ(read.inputs[0].input.bytes, "MD0044072501000\n");
}

TEST_F(ARecording, NamesThePlaceOfWhatIsWrong) {
  EXPECT_SAYS(complaint(""), ":1:1: this is no recording");
  EXPECT_SAYS(complaint("time,x\n"), "this is no recording of recorder.inputs");
  EXPECT_SAYS(complaint("muro external inputs,2,00\n"), "has version `2`, and this muro reads version 1");
  EXPECT_SAYS(complaint("muro external inputs,1,00\nfoo\n"), ":2:1: this line must be `epoch,time");
  EXPECT_SAYS(complaint(header + "0,-5,a,1,0,\n"), ":3:3: time is `-5` but must be 0 or more");
  EXPECT_SAYS(complaint(header + "0,5,a,x,0,\n"), ":3:7: kind is `x` but must be a whole number");
  EXPECT_SAYS(complaint(header + "0,5,a,1,0,%4\n"), "after % there must be two hexadecimal digits");
  EXPECT_SAYS(complaint(header + "0,5,a,1,0,b,c\n"), "more than the columns");
  EXPECT_SAYS(complaint(header + "0,5,a,1,0,b\n0,4,a,1,0,b\n"), ":4:5: epoch and time are smaller");
  EXPECT_SAYS(complaint(header + "0,5,a,1,0,b"), "the last line is cut short");
  EXPECT_SAYS(complaint(header + "end,0,5,00\n0,5,a,1,0,b\n"), "nothing may follow");
  EXPECT_SAYS(complaint(header + "0,99999999999999999999,a,1,0,b\n"), "time is `99999999999999999999`");
  EXPECT_SAYS(test::complaint_of<Error>([&] { read_recording(folder_.path("none.csv")); }), "No such file");
}

}  // namespace
}  // namespace muro::inputs
