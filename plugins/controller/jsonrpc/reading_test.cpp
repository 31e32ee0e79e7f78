// SPDX-License-Identifier: MIT
// Methods that read the simulation, and failing requests.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "service_testing.hpp"

namespace muro::jsonrpc {
namespace {

using testing::Dialogue;
using testing::request;

/// Sends a request, and returns the result or the error.
Json ask(Dialogue& d, const std::string& method, const std::string& params = "{}") {
  const Json all = Json::parse(d.say(testing::request(method, params)));
  return all.contains("result") ? all["result"] : all["error"];
}

TEST(Reading, ListsObjectsAndProperties) {
  Dialogue d;
  EXPECT_EQ(ask(d, "list"), Json::parse(R"({"objects":["world","rover/base","drone/base"],"left_out":0})"));
  EXPECT_EQ(ask(d, "list", R"({"pattern":"rover*"})")["objects"], Json::parse(R"(["rover/base"])"));
  EXPECT_EQ(ask(d, "list", R"(["*:pose"])")["properties"], Json::parse(R"(["rover/base:pose","drone/base:pose"])"));
}

TEST(Reading, DescribesAProperty) {
  Dialogue d({"*:command.*"});
  EXPECT_EQ(ask(d, "describe", R"(["rover/base:command.twist"])"),
            Json::parse(R"({"property":"rover/base:command.twist","type":"muro.Twist","unit":"m/s, rad/s",
              "shape":"single","count":1,"columns":["vx","vy","vz","wx","wy","wz"],"kind":"variable",
              "has_values":true,"may_set":true,"doc":"wanted velocity"})"));
  const Json hits = ask(d, "describe", R"(["rover/base:hits"])");
  EXPECT_EQ(hits["shape"], "list");
  EXPECT_EQ(hits["kind"], "derived");
  EXPECT_EQ(hits["written_by"], "laser");
  EXPECT_EQ(hits["may_set"], false);
  EXPECT_EQ(ask(d, "describe", R"(["rover/base:state.block"])")["has_values"], false);
}

TEST(Reading, GetsValuesWithTheTime) {
  Dialogue d;
  d.next_step();
  EXPECT_EQ(ask(d, "get", R"(["rover/base:pose"])"),
            Json::parse(R"({"time":20000000,"values":{"rover/base:pose":[1,2,3,0,0,0,1]}})"));
  EXPECT_EQ(
      ask(d, "get", R"({"properties":["rover:flag","rover/base:ranges","rover:hits","rover:counter"]})")["values"],
      Json::parse(R"({"rover/base:flag":7,"rover/base:ranges":[0.5,1.5,2.5],
              "rover/base:hits":["rover/base",null,"drone/base"],"rover/base:counter":18446744073709551615})"));
  EXPECT_EQ(ask(d, "get", R"({"properties":"rover:ranges","element":2})")["values"]["rover/base:ranges"], 2.5);
  EXPECT_EQ(ask(d, "get", R"({"properties":"*:pose"})")["values"].size(), 2u);
  EXPECT_EQ(ask(d, "get", R"({"properties":["rover/base:*","*:flag"]})")["values"].size(), 7u)
      << "each once, without what is not made of numbers";
}

TEST(Reading, GivesNumbersThatComeBackAsTheSameBits) {
  Dialogue d;
  std::mt19937_64 engine(1);
  d.scene.ranges.assign(20'000, 0);
  for (double& x : d.scene.ranges) {
    const std::uint64_t bits = engine();
    std::memcpy(&x, &bits, sizeof x);
    if (!std::isfinite(x)) x = -0.0;
  }
  d.scene.ranges[0] = std::numeric_limits<double>::denorm_min();
  d.scene.ranges[1] = std::numeric_limits<double>::max();
  const Json told = ask(d, "get", R"(["rover:ranges"])")["values"]["rover/base:ranges"];
  ASSERT_EQ(told.size(), d.scene.ranges.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    const double x = told[i].get<double>();
    EXPECT_EQ(std::memcmp(&x, &d.scene.ranges[i], sizeof x), 0) << told[i];
  }
}

TEST(Reading, GivesWhatIsNoNumberAsText) {
  Dialogue d;
  const double infinite = std::numeric_limits<double>::infinity();
  d.scene.ranges = {infinite, -infinite, std::nan("")};
  EXPECT_EQ(ask(d, "get", R"(["rover:ranges"])")["values"]["rover/base:ranges"],
            Json::parse(R"(["inf","-inf","nan"])"));
}

TEST(Reading, NamesTheNearestOfWhatIsNotThere) {
  Dialogue d;
  const auto fails = [&](const char* method, const char* params) {
    const Json error = ask(d, method, params);
    return std::to_string(error["code"].get<int>()) + " " + error["message"].get<std::string>() + " " +
           error.value("data", Json("")).dump();
  };
  EXPECT_EQ(fails("gett", "[]"), R"(-32601 Method not found {"did_you_mean":"get"})");
  EXPECT_EQ(fails("get", R"(["rovr/base:pose"])"),
            R"(-32001 there is no object `rovr/base` {"did_you_mean":"rover/base"})");
  EXPECT_EQ(fails("get", R"(["rover/base:range"])"),
            R"(-32001 `rover/base` has no property `range` {"did_you_mean":"rover/base:ranges"})");
  EXPECT_EQ(fails("get", R"(["*:nothing"])"), R"(-32001 no property matches `*:nothing` "")");
  EXPECT_EQ(
      fails("get", R"({"property":"rover:pose"})"),
      R"(-32602 there is no parameter `property`; the method has `properties`, `element`, `encoding` {"did_you_mean":"properties"})");
  EXPECT_EQ(fails("get", "{}"), R"(-32602 the parameter `properties` is missing "")");
  EXPECT_EQ(fails("get", R"(["rover/base:pose",0,"text",1])"),
            R"(-32602 there are 4 parameters, but the method has 3: `properties`, `element`, `encoding` "")");
  EXPECT_EQ(fails("info", "[1]"), R"(-32602 there is 1 parameter, but the method has 0: none "")");
  EXPECT_EQ(fails("get", R"({"properties":"rover:ranges","element":3})"),
            R"(-32602 `element` must be a whole number from 0 to 2 "")");
  EXPECT_EQ(fails("get", R"(["rover:state.block"])"),
            R"(-32002 `rover/base:state.block` is of type muro.block, which is not made of numbers "")");
  EXPECT_TRUE(fails("get", R"(["pose"])").starts_with("-32602 `pose` must be \"object:property\""));
}

TEST(Reading, TellsArraysAsBytesToo) {
  Dialogue d;
  const Json values = ask(d, "get", R"({"properties":"rover/base:*","encoding":"base64"})")["values"];
  EXPECT_EQ(values["rover/base:ranges"],
            Json::parse(R"({"type":"float64","shape":[3,1],"base64":"AAAAAAAA4D8AAAAAAAD4PwAAAAAAAARA"})"))
      << "as `struct.pack` and `base64` of Python have it";
  EXPECT_EQ(values["rover/base:flag"], 7) << "what is no array stays as it is";
  EXPECT_TRUE(values["rover/base:hits"].is_array()) << "names are no numbers";
  d.scene.ranges.assign(500'000, 1);
  EXPECT_EQ(ask(d, "get", R"({"properties":"rover:ranges","encoding":"base64"})")["values"].size(), 1u);
  EXPECT_EQ(ask(d, "get", R"({"properties":"rover:ranges","encoding":"png"})")["code"], -32602);
}

TEST(Reading, RefusesAReplyWithoutEnd) {
  Dialogue d;
  d.scene.ranges.assign(500'001, 1);
  EXPECT_EQ(ask(d, "get", R"(["rover:ranges"])")["code"], -32003);
  EXPECT_EQ(ask(d, "get", R"(["rover:ranges",500000])")["values"]["rover/base:ranges"], 1);
}

TEST(Reading, RefusesABatchWhoseRepliesTogetherHaveTooManyNumbers) {
  Dialogue d;
  d.scene.ranges.assign(200'000, 1);
  std::string batch = "[" + request("get", R"(["rover:ranges"])", 1);
  for (int i = 2; i <= 4; ++i) batch += "," + request("get", R"(["rover:ranges"])", i);
  const Json replies = Json::parse(d.say(batch + "]\n"));
  EXPECT_TRUE(replies[0].contains("result"));
  EXPECT_TRUE(replies[1].contains("result"));
  EXPECT_EQ(replies[2]["error"]["code"], -32003);
  EXPECT_EQ(replies[2]["error"]["data"], Json::parse(R"({"limit":"numbers","most":500000,"left":100000})"));
  EXPECT_EQ(ask(d, "get", R"(["rover:ranges"])")["values"]["rover/base:ranges"].size(), 200'000u) << "alone it may";
}

TEST(Reading, SpendsNoMoreThanAMessageMay) {
  Budget budget;
  budget.spend_names(Budget::most_names);
  try {
    budget.spend_names(1);
    FAIL();
  } catch (const RpcError& error) {
    EXPECT_EQ(error.data["limit"], "names");
  }
  budget.spend_bytes(Budget::most_bytes - 1);
  EXPECT_THROW(budget.spend_bytes(2), RpcError);
  budget.spend_bytes(1);
}

TEST(Reading, TellsTimeSpeedAndWhatIsGranted) {
  Dialogue d({"call:s*", "*:pose"});
  d.next_step();
  EXPECT_EQ(ask(d, "time"), Json::parse(R"({"time":20000000,"seconds":0.02,"speed":1.0,"paused":false})"));
  const Json info = ask(d, "info");
  EXPECT_EQ(info["period"], 20'000'000);
  EXPECT_EQ(info["methods"]["get"], true);
  EXPECT_EQ(info["methods"]["step"], true);
  EXPECT_EQ(info["methods"]["place"], false);
  EXPECT_EQ(info["write"], Json::parse(R"(["call:s*","*:pose"])"));
}

TEST(Reading, HasAHashOfCompleteInstantsAlone) {
  Dialogue d;
  EXPECT_EQ(ask(d, "hash")["code"], -32002);
  d.attend();
  EXPECT_EQ(ask(d, "hash")["hash"], "0000000000abcdef");
}

}  // namespace
}  // namespace muro::jsonrpc
