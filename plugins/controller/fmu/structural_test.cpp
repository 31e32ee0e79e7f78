// SPDX-License-Identifier: MIT
// Structural parameters of FMI 3. They are set only in configuration mode (FMI 3.0, sections 2.3.3 and 2.4.7.4); the
// FMU of the tests refuses them in other modes.
#include "fmu_testing.hpp"
#include "model_description.hpp"
#include "start_values.hpp"

namespace muro::fmu {
namespace {

class Structural : public ::testing::TestWithParam<bool> {
 protected:
  Structural() { write_fmu(fmu_, 3, able_3); }
  void configure(Bench& bench, const Settings& settings, const Texts& values) {
    bench.is_isolated = GetParam();
    bench.control(fmu_, 3, settings, values);
  }
  test::ScratchFolder scratch_;
  const std::string fmu_ = scratch_.path("x.fmu");
};

TEST_P(Structural, BooleansAreSetAlsoAfterAReset) {
  static constexpr Key<std::uint8_t> flag_out{"test.flag_out", "1", ""};
  for (const bool as_it_is : {false, true}) {
    Bench bench;
    const std::uint8_t& out = bench.sink(flag_out);
    configure(bench, {{"outputs", Texts{"bool_out=test.flag_out"}}},
              {"bool_in=true", std::string("as_it_is=") + (as_it_is ? "true" : "false")});
    bench.build();
    for (int run = 0; run < 2; ++run) {
      bench.run_for(0.2);
      EXPECT_EQ(out, as_it_is ? 1 : 0) << run;
      bench.reset();
    }
  }
}

TEST_P(Structural, LengthsGiveArraysTheirSizes) {
  static constexpr Key<Vec3> out{"test.out", "1", ""};
  static constexpr Key<Twist> in{"test.in", "1", ""};
  for (const std::string length : {"0", "2", "6"}) {
    Bench bench;
    bench.source(in, Twist{{1, 2, 3}, {4, 5, 6}});
    const Vec3& result = bench.sink(out);
    Settings settings{{"outputs", Texts{"vector_out=test.out"}}};
    if (length == "6") settings["inputs"] = Texts{"vector_in=test.in"};
    Texts values{"length=" + length};
    if (length != "6") values.emplace_back(length == "2" ? "vector_in=7 8" : "vector_in=");
    configure(bench, settings, values);
    bench.build();
    bench.run_for(0.2);
    EXPECT_EQ(result, length == "0" ? Vec3(0, 0, 0) : length == "2" ? Vec3(-7, -8, 0) : Vec3(-1, -2, -3)) << length;
  }
}

TEST_P(Structural, ValuesThatDoNotFitAreTold) {
  const auto refusal_of = [&](const Texts& values) {
    Bench bench;
    configure(bench, {}, values);
    return refusal(bench);
  };
  EXPECT_SAYS(refusal_of({"as_it_is=7"}), "`parameters`: value `7` of `as_it_is` does not fit into its type, Boolean");
  EXPECT_SAYS(refusal_of({"length=9", "vector_in=1 2 3 4 5 6 7 8 9"}), "Error: length is at most 8");
  EXPECT_SAYS(refusal_of({"length=-1"}), "value `-1` of `length` does not fit into its type, UInt64");
  EXPECT_SAYS(refusal_of({"length=1000001"}),
              "value `1000001` of `length` is no length of arrays: each has at most 1000000 elements");
  EXPECT_SAYS(refusal_of({"length=2"}), "value `1 2 3` of `vector_in` has 3 numbers, and needs 2 separated by blanks");
  Bench bench;
  bench.source(Key<double>{"test.in", "1", ""});
  configure(bench, {{"inputs", Texts{"as_it_is=test.in"}}}, {});
  EXPECT_SAYS(refusal(bench), "`as_it_is` is a structural parameter, which keeps its value during the run; give that");
}

INSTANTIATE_TEST_SUITE_P(Parameters, Structural, ::testing::Bool(), [](const auto& test) {
  return test.param ? std::string("InAProcessOfItsOwn") : std::string("InTheProcess");
});

/// Returns a description of FMI 3 with these variables, and an array whose length is variable 1.
std::string with_variables(const std::string& variables) {
  return R"(<fmiModelDescription fmiVersion="3.0" modelName="m" instantiationToken="t">
<CoSimulation modelIdentifier="m"/><ModelVariables>)" +
         variables + R"(<Float64 name="x" valueReference="2"><Dimension valueReference="1"/></Float64>
</ModelVariables></fmiModelDescription>)";
}

TEST(StructuralParameters, OfAllTypesAreReadAndMayBeSet) {
  const std::string length = R"(<UInt64 name="n" valueReference="1" causality="structuralParameter" start="4"/>)";
  for (const std::string variable : {R"(Float64 start="0.5")", R"(Boolean start="true")", R"(Int32 start="-3")",
                                     R"(Enumeration declaredType="E" start="1")"}) {
    const ModelDescription d = read_model_description(
        with_variables(length + "<" + variable + R"( name="s" valueReference="7" causality="structuralParameter"/>)"),
        "x.fmu");
    EXPECT_TRUE(d.find("s")->may_be_set) << variable;
    EXPECT_EQ(d.find("x")->size, 4u);
  }
  const ModelDescription d = read_model_description(
      with_variables(length +
                     R"(<String name="s" valueReference="7" causality="structuralParameter" variability="tunable">
<Start value="abc"/></String>)"),
      "x.fmu");
  EXPECT_TRUE(d.find("s")->may_be_set);
}

/// FMI 3.0, section 2.4.7.3.1: "must be a variable of type UInt64, and ... either a constant ... or a structural
/// parameter".
TEST(StructuralParameters, AndConstantsAreLengthsOfArraysWhereTheyAreWhole) {
  const auto read = [](const std::string& variable) {
    return read_model_description(with_variables(variable), "x.fmu");
  };
  const auto refusal_of = [&](const std::string& variable) {
    return test::complaint_of<Error>([&] { read(variable); });
  };
  EXPECT_EQ(read(R"(<UInt64 name="n" valueReference="1" variability="constant" start="5"/>)").find("x")->size, 5u);
  EXPECT_SAYS(refusal_of(R"(<Boolean name="b" valueReference="1" causality="structuralParameter" start="true"/>)"),
              "x.fmu: modelDescription.xml:2: a dimension of variable `x` refers to `b`, which is of type Boolean; "
              "lengths are of type UInt64");
  EXPECT_SAYS(refusal_of(R"(<UInt64 name="n" valueReference="1" causality="structuralParameter" start="-1"/>)"),
              "start is `-1`; it is a whole number from 0 on");
  EXPECT_SAYS(refusal_of(R"(<UInt64 name="n" valueReference="1" causality="structuralParameter"/>)"),
              "a dimension of variable `x` refers to no structuralParameter with a start value");
}

}  // namespace
}  // namespace muro::fmu
