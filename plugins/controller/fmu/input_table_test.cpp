// SPDX-License-Identifier: MIT
// Values of inputs from a CSV file. A communication step from t to t + h gets the values at t, as in fmusim and FMPy,
// so outputs at t + h show these values.
#include <cmath>

#include "fmu_testing.hpp"

namespace muro::fmu {
namespace {

constexpr Key<double> speed{"test.speed", "m/s", ""}, turn{"test.turn", "rad/s", ""}, choice{"test.choice", "1", ""};
constexpr Key<std::int32_t> whole{"test.whole", "1", ""};
constexpr Key<std::uint8_t> flag{"test.flag", "1", ""};

struct Way {
  int version;
  bool is_isolated;
};

class FmuInputFile : public ::testing::TestWithParam<Way> {
 protected:
  struct Bench : fmu::Bench {
    explicit Bench(int robots = 1) : fmu::Bench(robots) { is_isolated = GetParam().is_isolated; }
  };
  FmuInputFile() { write_fmu(fmu_, version(), version() == 2 ? able_2 : able_3); }
  int version() const { return GetParam().version; }
  /// `values`: start values, also of inputs that the file has.
  void control(Bench& bench, const std::string& table, const Texts& outputs, const Texts& values = {}) {
    bench.control(fmu_, version(), {{"outputs", outputs}, {"input_file", scratch_.file("in.csv", table)}}, values);
  }
  test::ScratchFolder scratch_;
  const std::string fmu_ = scratch_.path("x.fmu");
};

/// `speed` is -u when gain is 1 and goal is 0.
TEST_P(FmuInputFile, InterpolatesContinuousInputsAndHoldsOthers) {
  Bench bench;
  const double& v = bench.sink(speed);
  const double& w = bench.sink(turn);
  const std::int32_t& n = bench.sink(whole);
  const std::uint8_t& b = bench.sink(flag);
  const double& c = bench.sink(choice);
  control(bench,
          "time,u,angle,int_in,bool_in,choice_in\r\n"
          "0.2,1,90,-5,true,a\r\n"
          "0.4,3,180,7,0,2\r\n"
          "0.4,-2,180,8,0,2\r\n"
          "0.6,-4,270,9,1,a\r\n",
          {"speed=test.speed", "turn=test.turn", "int_out=test.whole", "bool_out=test.flag", "choice_out=test.choice"},
          {"gain=1", "goal=0"});
  bench.build();
  struct Moment {
    double u, angle;
    int whole, is_true, choice;
  };
  const Moment before{1, 90, -5, 1, 1}, middle{2, 90, -5, 1, 1}, jump{-2, 180, 8, 0, 2}, after{-4, 270, 9, 1, 1};
  // at t = 0, 0.1, ...; from 0.1 on the inputs are from the instant before
  const Moment expected[] = {before, before, before, before, middle, jump, {-3, 180, 8, 0, 2}, after, after, after};
  bench.run_for(0.05);
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    SCOPED_TRACE(i);
    const Moment& e = expected[i];
    EXPECT_NEAR(v, -e.u, 1e-12);
    EXPECT_NEAR(w, -e.angle * M_PI / 180, 1e-12);
    EXPECT_EQ(n, e.whole);
    EXPECT_EQ(b, 1 - e.is_true) << "it says the opposite";
    EXPECT_EQ(c, e.choice);
    bench.run_for(0.1);
  }
}

TEST_P(FmuInputFile, GoesOnAfterResetsAndFromSnapshotsOnAnyNumberOfThreads) {
  const auto build = [&](Bench& bench) {
    control(bench, "time,u,gain\n0,0,1\n1,5,1\n1.5,2,3\n3,0,3\n", {"speed=command.twist[vx]"});
    bench.build();
  };
  Bench one(4), many(4);
  build(one), build(many);
  many.set_threads(4);
  one.run_for(0.75);
  const Snapshot middle = one.snapshot();
  one.run_for(1.5);
  const std::uint64_t end = one.state_hash();
  one.restore(middle);
  one.run_for(1.5);
  EXPECT_EQ(one.state_hash(), end);
  one.reset();
  one.run_for(2.25);
  EXPECT_EQ(one.state_hash(), end);
  many.run_for(2.25);
  EXPECT_EQ(many.state_hash(), end);
}

TEST_P(FmuInputFile, MeetsItsTimesWherePeriodsAreNoBinaryNumbers) {
  Bench bench;
  const std::int32_t& n = bench.sink(whole);
  std::string table = "time,int_in\n";
  for (int i = 0; i <= 100; ++i) {
    char row[32];
    std::snprintf(row, sizeof row, "%.2f,%d\n", i / 100.0, i);
    table += row;
  }
  bench.control(fmu_, version(),
                {{"outputs", Texts{"int_out=test.whole"}}, {"input_file", scratch_.file("in.csv", table)}}, {}, 100);
  bench.build();
  bench.run_for(0.005);
  for (int i = 1; i <= 100; ++i) {
    bench.run_for(0.01);
    EXPECT_EQ(n, i - 1);
  }
}

TEST_P(FmuInputFile, GivesTexts) {
  const std::string label = R"(name="label" valueReference="14" causality="parameter" variability="fixed")";
  std::string text = description(version(), version() == 2 ? able_2 : able_3);
  ASSERT_NE(text.find(label), text.npos);
  text.replace(text.find(label), label.size(), R"(name="label" valueReference="14" causality="input")");
  write_archive(fmu_, {{"modelDescription.xml", text},
                       {"binaries/" + platform_of[version()] + "/model.so",
                        test::text_of(parts + "model" + std::to_string(version()) + ".so")}});
  Bench bench;
  constexpr int warns = 11;
  control(bench, "time,\"label\"\n0,one\n0.1,\"a \"\"b\"\", c\"\n", {"speed=command.twist[vx]"},
          {"fault=" + std::to_string(warns)});
  bench.build();
  bench.run_for(0.25);
  EXPECT_SAYS(bench.said, "robot `a`: FMU: beware at t = 0.1, label 'one'");
  EXPECT_SAYS(bench.said, "robot `a`: FMU: beware at t = 0.2, label 'a \"b\", c'");
}

INSTANTIATE_TEST_SUITE_P(OfFmi, FmuInputFile,
                         ::testing::Values(Way{2, false}, Way{3, false}, Way{2, true}, Way{3, true}),
                         [](const auto& test) {
                           return std::to_string(test.param.version) +
                                  (test.param.is_isolated ? "InAProcessOfItsOwn" : "");
                         });

TEST(FmuInputFileOfFmi3, GivesNumbersOfAllTypesArraysAndBytes) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), 3, able_3);
  static constexpr Key<double> f32{"test.f32", "1", ""};
  static constexpr Key<std::uint64_t> u64{"test.u64", "1", ""};
  static constexpr Key<std::int64_t> i64{"test.i64", "1", ""};
  static constexpr Key<Vec3> vector{"test.vector", "1", ""};
  static constexpr Key<std::uint8_t> bytes{"test.bytes", "1", ""};
  Bench bench;
  const double& f32_is = bench.sink(f32);
  const std::uint64_t& u64_is = bench.sink(u64);
  const std::int64_t& i64_is = bench.sink(i64);
  const Vec3& vector_is = bench.sink(vector);
  PropertyStore& store = bench.world().store();
  const auto* bytes_are = static_cast<const ArrayHeader*>(store.bind(
      store.add_accessor("the test"), bench.a->base(), bytes, usage::input, Multiplicity::array, 6, nullptr));
  bench.control(scratch.path("x.fmu"), 3,
                {{"outputs", Texts{"f32_out=test.f32", "u64_out=test.u64", "i64_out=test.i64", "vector_out=test.vector",
                                   "bytes_out=test.bytes"}},
                 {"input_file", scratch.file("in.csv",
                                             "time, f32_in, u64_in, i64_in, vector_in, bytes_in\n"
                                             "0, 0, 18446744073709551615, -9223372036854775808, 1 2 3, 616263646566\n"
                                             "\n"
                                             "1, 1, 0, 0, 2 4 -1.7e308, 000000000000\n")}});
  bench.build();
  bench.run_for(0.65);
  EXPECT_EQ(f32_is, double(float(0.5)));
  EXPECT_EQ(u64_is, 18446744073709551615u);
  EXPECT_EQ(i64_is, -9223372036854775807 - 1);
  EXPECT_NEAR(vector_is.x(), -1.5, 1e-12);
  EXPECT_NEAR(vector_is.y(), -3, 1e-12);
  EXPECT_NEAR(vector_is.z(), 0.85e308, 1e295);
  EXPECT_EQ(std::string(static_cast<const char*>(bytes_are->data), 6), "fedcba");
}

/// Returns the error message for a file, given as its bytes or by its path.
std::string refusal_of(const std::string& bytes, const std::string& path = "") {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), 3, able_3);
  Bench bench;
  const std::string file = path.empty() ? scratch.file("in.csv", bytes) : path;
  bench.control(scratch.path("x.fmu"), 3, Settings{{"input_file", file}});
  std::string said = refusal(bench);
  if (const std::size_t at = said.find(scratch.path("")); at != said.npos) said.erase(at, scratch.path("").size());
  return said;
}

TEST(FmuInputFileOfFmi3, SaysWhatIsWrongAndWhere) {
  const std::string names = "; what may stand here: `u`, `gain`, `angle`, `int_in`, `bool_in`, `choice_in`, ";
  EXPECT_SAYS(refusal_of(""), "in.csv is empty; its first line is to name the columns: time,INPUT,...");
  EXPECT_SAYS(refusal_of("t,u\n"), "in.csv:1:1: the first column is called `t`; it must be `time`, in s");
  EXPECT_SAYS(refusal_of("time;u\n"),
              "in.csv:1:1: the first column is called `time;u`; it must be `time`, in s, and "
              "commas separate columns");
  EXPECT_SAYS(refusal_of("time\n0\n"), "in.csv:1:5: there is no column beside `time`" + names);
  EXPECT_SAYS(refusal_of("time,u,bool_im\n"),
              "in.csv:1:8: the FMU has no variable `bool_im` (did you mean `bool_in`?)" + names);
  EXPECT_SAYS(refusal_of("time,speed\n"), "in.csv:1:6: `speed` is not an input or a tunable parameter" + names);
  EXPECT_SAYS(refusal_of("time,length\n"), "in.csv:1:6: `length` is a structural parameter, which keeps its value");
  EXPECT_SAYS(refusal_of("time,u,u\n"), "in.csv:1:8: `u` is there twice");
  EXPECT_SAYS(refusal_of("time,u\n\n"), "in.csv has no row behind its header; at least one is needed");
  EXPECT_SAYS(refusal_of("time,u\n0,1\n1,x\n"), "in.csv:3:3: `x` in column `u` is no number; write it like 0.05");
  EXPECT_SAYS(refusal_of("time,u\n0,nan\n"), "in.csv:2:3: `nan` in column `u` is not finite");
  EXPECT_SAYS(refusal_of("time,u\n0,\n"), "in.csv:2:3: an empty cell in column `u` has 0 numbers, and needs 1");
  EXPECT_SAYS(refusal_of("time,u\n,1\n"), "in.csv:2:1: time `` has 0 numbers, and needs 1");
  EXPECT_SAYS(refusal_of("time,u\n1 s,1\n"), "in.csv:2:1: time `1 s` is no number");
  EXPECT_SAYS(refusal_of("time,int_in\n0,0.5\n"),
              "in.csv:2:3: `0.5` in column `int_in` does not fit into its type, Int32");
  EXPECT_SAYS(refusal_of("time,bool_in\n0,2\n"),
              "in.csv:2:3: `2` in column `bool_in` does not fit into its type, Boolean");
  EXPECT_SAYS(refusal_of("time,choice_in\n0,c\n"), "items of its type are `a`, `b`");
  EXPECT_SAYS(refusal_of("time,bytes_in\n0,0g\n"), "`0g` in column `bytes_in` is not made of two hexadecimal digits");
  EXPECT_SAYS(refusal_of("time,vector_in\n0,1 2\n"),
              "in.csv:2:3: `1 2` in column `vector_in` has 2 numbers, and needs 3 separated by blanks");
  EXPECT_SAYS(refusal_of("time,u\n0,1\n2,1\n1.5,1\n"),
              "in.csv:4:1: time goes back from 2 s to 1.5 s; rows are sorted by it");
  EXPECT_SAYS(refusal_of("time,u,gain\n0,1\n"), "in.csv:2:4: the row ends after 2 columns; the header names 3");
  EXPECT_SAYS(refusal_of("time,u\n0,1,2\n"), "in.csv:2:5: there are more columns than the 2 of the header");
  EXPECT_SAYS(refusal_of("time,\"u\n"), "in.csv:1:6: the quotation mark has no second one on its line");
  EXPECT_SAYS(refusal_of("\"time\" x,u\n"), "in.csv:1:8: a comma must follow the quotation mark");
  EXPECT_SAYS(refusal_of(std::string("PK\3\4\0\0\0", 7)),
              "in.csv:1:3: the character `\\x03` stands in no text; this is to be a CSV file");
}

TEST(FmuInputFileOfFmi3, ThatIsNoneOrEndlessIsRefused) {
  EXPECT_SAYS(refusal_of("", "/dev/zero"), "/dev/zero has a line of more than 64 MiB");
  EXPECT_SAYS(refusal_of("", "/nowhere/in.csv"), "/nowhere/in.csv cannot be read: No such file or directory");
  EXPECT_SAYS(refusal_of("", "/proc"), "/proc cannot be read: Is a directory");
  std::string rows = "time,u\n";
  for (int i = 0; i < 17; ++i) rows.append(std::size_t(4) << 20, '\n');
  EXPECT_SAYS(refusal_of(rows), "in.csv has more than 64 MiB");
}

TEST(FmuInputFileOfFmi3, AndAPropertyCannotBothGiveAnInput) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), 3, able_3);
  Bench bench;
  bench.control(scratch.path("x.fmu"), 3,
                Settings{{"inputs", Texts{"u=pose[x]"}}, {"input_file", scratch.file("in.csv", "time,u\n0,0\n")}});
  EXPECT_SAYS(refusal(bench), "in.csv has a column `u`, and `inputs` connects it, too; leave out one of them");
}

}  // namespace
}  // namespace muro::fmu
