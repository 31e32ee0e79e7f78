// SPDX-License-Identifier: MIT
#include "model_description.hpp"

#include "fmu_testing.hpp"
#include "muro/algorithm.hpp"

namespace muro::fmu {
namespace {

ModelDescription read(int version, const std::string& flags = "") {
  return read_model_description(description(version, flags), "x.fmu");
}

std::string refusal_of(const std::string& text) {
  return test::complaint_of<Error>([&] { read_model_description(text, "x.fmu"); });
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, text.npos) << part;
  return text.replace(at, part.size(), by);
}

TEST(ModelDescription, OfBothVersionsIsRead) {
  for (const int version : {2, 3}) {
    const ModelDescription d = read(version, version == 2 ? able_2 : able_3);
    EXPECT_EQ(d.version, version);
    EXPECT_EQ(d.token, "{the-token}");
    EXPECT_EQ(d.identifier, "model");
    EXPECT_TRUE(d.variable_step_size && d.can_keep_state && d.can_serialize_state);
    EXPECT_EQ(d.might_return_early, version == 3);
    EXPECT_FALSE(d.once_per_process);
    ASSERT_NE(d.find("u"), nullptr);
    EXPECT_EQ(d.find("u")->unit, "m") << "from its type";
    EXPECT_EQ(d.find("u")->causality, Causality::input);
    EXPECT_EQ(d.find("u")->reference, 3u);
    EXPECT_TRUE(d.find("decay")->may_be_set);
    EXPECT_FALSE(d.find("speed")->may_be_set);
    EXPECT_TRUE(d.find("gain")->is_tunable);
    EXPECT_EQ(d.find("choice_in")->type, Type::enumeration);
    ASSERT_NE(d.find("choice_in")->items, nullptr);
    EXPECT_EQ(*d.find("choice_in")->items, (EnumerationItems{{"a", 1}, {"b", 2}}));
    EXPECT_EQ(d.units.at("deg").base->exponents[7], 1);
    EXPECT_EQ(d.find("nothing"), nullptr);
  }
}

TEST(ModelDescription, KnowsTheSizesOfArrays) {
  const ModelDescription d = read(3);
  EXPECT_EQ(d.find("vector_in")->size, 3u) << "by a structural parameter";
  EXPECT_EQ(d.find("vector_out")->size, 3u);
  EXPECT_EQ(d.find("u64_in")->type, Type::uint64);
  EXPECT_EQ(d.find("bytes_in")->type, Type::binary);
}

TEST(ModelDescription, RefusesByNameWhatIsNotOffered) {
  EXPECT_SAYS(refusal_of(description(2, R"(needsExecutionTool="true")")),
              "x.fmu: modelDescription.xml:3: the FMU has the flag needsExecutionTool");
  EXPECT_SAYS(refusal_of(description(3, R"(needsExecutionTool="1")")), "needsExecutionTool");
  EXPECT_SAYS(refusal_of(replaced(description(2, ""), "CoSimulation", "ModelExchange")),
              "the FMU offers ModelExchange only; co-simulation is what is run here");
  EXPECT_SAYS(refusal_of(replaced(description(3, ""), "CoSimulation", "ScheduledExecution")),
              "the FMU offers ScheduledExecution only");
  EXPECT_SAYS(refusal_of(replaced(description(2, ""), "\"2.0\"", "\"1.0\"")), "fmiVersion is `1.0`; 2.0 and 3.0 are");
  EXPECT_SAYS(refusal_of(replaced(description(3, ""), "\"3.0\"", "\"3.0-beta.2\"")), "fmiVersion is `3.0-beta.2`");
  EXPECT_SAYS(refusal_of(replaced(description(3, ""), "<Float64 name=\"speed\"", "<Clock name=\"tick\"")),
              "variable `tick` is a clock; FMUs with Clocks need event mode (hasEventMode)");
  EXPECT_SAYS(refusal_of(replaced(description(3, ""), "name=\"u\"", "clocks=\"7\" name=\"u\"")),
              "variable `u` belongs to Clocks");
}

TEST(ModelDescription, SaysWhatIsWrongAndWhere) {
  const std::string good = description(2, "");
  EXPECT_SAYS(refusal_of(""), "x.fmu: modelDescription.xml: the file is empty");
  EXPECT_SAYS(refusal_of("<a>"), "x.fmu: modelDescription.xml:1: the file is not well-formed XML");
  EXPECT_SAYS(refusal_of("<!<x>"), "x.fmu: modelDescription.xml: there is no element");
  EXPECT_SAYS(refusal_of("<a/>"), "the root element is <a>; that of an FMU is <fmiModelDescription>");
  EXPECT_SAYS(refusal_of(replaced(good, "guid", "gid")), ":2: <fmiModelDescription> has no attribute `guid`");
  EXPECT_SAYS(refusal_of(replaced(good, "modelIdentifier=\"model\"", "modelIdentifier=\"../x\"")),
              "modelIdentifier is `../x`; it consists of letters, digits and _");
  EXPECT_SAYS(refusal_of(replaced(good, "valueReference=\"3\"", "valueReference=\"-3\"")),
              "valueReference is `-3`; it is a whole number from 0 on");
  EXPECT_SAYS(refusal_of(replaced(good, "name=\"gain\"", "name=\"k\"")), "variable `k` is there twice");
  EXPECT_SAYS(refusal_of(replaced(good, "\"input\"", "\"inpt\"")), "causality of variable `u` is `inpt`");
  EXPECT_SAYS(refusal_of(replaced(good, "<Integer start=\"0\"/>", "<Int start=\"0\"/>")),
              "<Int> of variable `fault` is no type of FMI 2");
  EXPECT_SAYS(refusal_of(replaced(good, "factor=\"0.01", "factor=\"x0.01")), "factor: `x0.017453292519943295` is no");
  EXPECT_SAYS(refusal_of(description(2, R"(canGetAndSetFMUstate="yes")")),
              "canGetAndSetFMUstate is `yes`; it is true or false");
  EXPECT_SAYS(refusal_of(replaced(description(3, ""), "<Dimension start=\"3\"/>", "<Dimension start=\"2000000\"/>")),
              "variable `vector_out` has more than 1000000 elements");
  EXPECT_SAYS(refusal_of(replaced(description(3, ""), "<Dimension valueReference=\"99\"/>",
                                  "<Dimension valueReference=\"98\"/>")),
              "a dimension of variable `vector_in` refers to no structuralParameter with a start value");
}

}  // namespace
}  // namespace muro::fmu
