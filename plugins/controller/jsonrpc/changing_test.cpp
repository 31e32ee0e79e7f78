// SPDX-License-Identifier: MIT
// Methods that change the simulation: their requests to the host, and grants.
#include <gtest/gtest.h>

#include "service_testing.hpp"

namespace muro::jsonrpc {
namespace {

using testing::Dialogue;
using testing::request;

/// Returns the code of the error; 0 when there is none.
int code_of(const std::string& reply) {
  const Json all = Json::parse(reply, nullptr, false);
  return all.contains("error") ? all["error"]["code"].get<int>() : 0;
}

TEST(Changing, AnswersWhenTheInstantIsComplete) {
  Dialogue d;
  EXPECT_EQ(d.say(request("set", R"(["rover:command.twist",[1,0,0,0,0,0.5]])")), "") << "it is not done yet";
  EXPECT_EQ(d.scene.command.linear.x(), 0);
  d.run.complete();
  EXPECT_EQ(d.heard(), R"({"jsonrpc":"2.0","result":{"time":0,"seconds":0.0},"id":1})"
                       "\n");
  EXPECT_EQ(d.scene.command.linear.x(), 1);
  EXPECT_EQ(d.scene.command.angular.z(), 0.5);
  EXPECT_EQ(d.outlet.answers, 1u);
  EXPECT_EQ(d.outlet.changes, 1u);
}

TEST(Changing, SetsElementsColumnsAndSeveralPropertiesAtOnce) {
  Dialogue d;
  d.say(request("set", R"({"property":"rover:ranges","element":1,"value":9.5})"));
  d.say(request("set", R"({"property":"rover:command.twist","value":{"vy":2}})"));
  d.say(request("set", R"({"property":"rover:command.twist","value":{"wz":3}})"));
  d.say(request("set", R"({"values":{"rover:flag":255,"rover:counter":18446744073709551614,"rover:gain":0.5}})"));
  d.settle();
  EXPECT_EQ(d.scene.ranges, (std::vector<double>{0.5, 9.5, 2.5}));
  EXPECT_EQ(d.scene.command.linear.y(), 2) << "the columns that are not named stay";
  EXPECT_EQ(d.scene.command.angular.z(), 3);
  EXPECT_EQ(d.scene.flag, 255);
  EXPECT_EQ(d.scene.counter, 18446744073709551614u);
  EXPECT_EQ(d.scene.gain, 0.5f);
  d.say(request("set", R"(["rover:ranges",[1,2,3]])"));
  d.settle();
  EXPECT_EQ(d.scene.ranges, (std::vector<double>{1, 2, 3}));
}

TEST(Changing, AnswersAtOnceWhereThereIsNothingToBeDone) {
  Dialogue d;
  d.scene.ranges.clear();
  EXPECT_EQ(d.say(request("set", R"(["rover:ranges",[]])")),
            R"({"jsonrpc":"2.0","result":{"time":0,"seconds":0.0},"id":1})"
            "\n");
  EXPECT_EQ(d.outlet.answers, 1u);
  EXPECT_NE(d.say(request("time")), "") << "it goes on";
}

TEST(Changing, RefusesValuesThatDoNotFit) {
  Dialogue d;
  for (const char* params :
       {R"(["rover:flag",256])", R"(["rover:flag",-1])", R"(["rover:flag",1.5])", R"(["rover:flag","1"])",
        R"(["rover:counter",-1])", R"(["rover:gain",1e39])", R"(["rover:gain","nan"])", R"(["rover:ranges",[1,2]])",
        R"(["rover:ranges",5])", R"(["rover:command.twist",[1,2]])", R"(["rover:command.twist",{"roll":1}])",
        R"(["rover:command.twist",[1,2,3,4,5,null]])", R"(["rover:ranges",1,3])", R"(["rover:ranges",1,-1])",
        R"({"values":{}})", R"({"values":{"rover:flag":1},"value":1})", R"(["rover:flag"])"})
    EXPECT_EQ(code_of(d.say(request("set", params))), -32602) << params;
  EXPECT_EQ(code_of(d.say(request("set", R"(["rover:state.block",1])"))), -32002);
  EXPECT_EQ(code_of(d.say(request("set", R"(["rover:hits",[1,2,3]])"))), -32002) << "it is no state";
  EXPECT_EQ(code_of(d.say(request("set", R"({"values":{"rover:flag":1,"rover:gain":"x"}})"))), -32602);
  d.run.complete();
  EXPECT_TRUE(d.run.carried_out.empty()) << "of several, none is set where one is wrong";
}

TEST(Changing, ComparesAUnitLetterByLetter) {
  Dialogue d;
  const std::string reply = d.say(request("set", R"({"property":"rover:ranges","element":0,"value":1,"unit":"mm"})"));
  EXPECT_EQ(Json::parse(reply)["error"]["message"], "`rover/base:ranges` is in `m`, not in `mm`");
  EXPECT_EQ(Json::parse(reply)["error"]["data"]["unit"], "m");
  EXPECT_EQ(d.say(request("set", R"({"property":"rover:ranges","element":0,"value":1,"unit":"m"})")), "");
}

TEST(Changing, IsGrantedByPatternsAlone) {
  Dialogue nobody(std::vector<std::string_view>{});
  EXPECT_EQ(code_of(nobody.say(request("set", R"(["rover:flag",1])"))), -32000);
  for (const char* method : {"place", "pause", "resume", "step", "speed", "stop", "reset", "snapshot", "restore"})
    EXPECT_EQ(code_of(nobody.say(request(method))), -32000) << method;
  nobody.run.complete();
  EXPECT_TRUE(nobody.run.carried_out.empty());
  EXPECT_FALSE(nobody.run.paused);
  EXPECT_FALSE(nobody.scene.is_stopped);

  Dialogue some({"*:command.*", "call:pause"});
  EXPECT_EQ(code_of(some.say(request("set", R"(["rover:flag",1])"))), -32000);
  EXPECT_EQ(code_of(some.say(request("step", R"({"steps":1})"))), -32000);
  EXPECT_EQ(some.say(request("set", R"(["rover:command.twist",{"vx":1}])")), "");

  Dialogue properties({"*:*"});
  EXPECT_EQ(code_of(properties.say(request("reset"))), -32000) << "patterns of properties grant no call";
  Dialogue calls({"call:*"});
  EXPECT_EQ(code_of(calls.say(request("set", R"(["rover:flag",1])"))), -32000) << "and the other way round";
}

TEST(Changing, PlacesByPoseOrByCoordinates) {
  Dialogue d;
  ASSERT_EQ(d.say(request("place", R"({"object":"rover","x":4,"y":5,"yaw":3.141592653589793,"force":true})")), "");
  d.settle();
  EXPECT_EQ(d.run.carried_out, std::vector<std::string>{"place rover/base by force"});
  EXPECT_EQ(d.scene.pose.position, Vec3(4, 5, 3)) << "the height stays";
  EXPECT_NEAR(d.scene.pose.orientation.z(), 1, 1e-15);
  d.heard();
  d.say(request("place", R"({"object":"rover/base","position":[1,2,3],"orientation_wxyz":[0,1,0,0]})"));
  d.settle();
  EXPECT_EQ(d.scene.pose.orientation.x(), 1);
  d.say(request("place", R"({"object":"rover/base","position":[1,2,3],"orientation_xyzw":[0,1,0,0]})"));
  d.settle();
  EXPECT_EQ(d.scene.pose.orientation.y(), 1);
  for (const char* params :
       {R"({"object":"rover"})", R"({"object":"rover","x":1})", R"({"object":"rover","x":1,"y":1,"position":[1,1,1]})",
        R"({"object":"rover","position":[1,1]})", R"({"object":"rover","x":1,"y":1,"orientation_wxyz":[1,1,0,0]})",
        R"({"object":"rover","x":1,"y":1,"yaw":0,"orientation_wxyz":[1,0,0,0]})",
        R"({"object":"rover","x":1e300,"y":1})", R"({"object":"rover","x":1,"y":1,"linear":[0,0]})"})
    EXPECT_EQ(code_of(d.say(request("place", params))), -32602) << params;
  EXPECT_EQ(code_of(d.say(request("place", R"({"object":"nobody","x":1,"y":1})"))), -32001);
}

TEST(Changing, TellsWhyTheHostRefuses) {
  Dialogue d;
  d.run.refuses = "`rover/base` would overlap `wall` by 0.1 m there";
  d.say(request("place", R"({"object":"rover","x":4,"y":5})"));
  d.run.complete();
  EXPECT_EQ(
      d.heard(),
      R"({"jsonrpc":"2.0","error":{"code":-32002,"message":"`rover/base` would overlap `wall` by 0.1 m there"},"id":1})"
      "\n");
}

TEST(Changing, KeepsABoundedNumberOfSnapshots) {
  Dialogue d;
  EXPECT_EQ(code_of(d.say(request("restore", R"(["a"])"))), -32001);
  for (int i = 0; i < 16; ++i) {
    d.say(request("snapshot", R"(["s)" + std::to_string(i) + R"("])"));
    d.settle();
    EXPECT_EQ(code_of(d.heard()), 0);
  }
  EXPECT_EQ(code_of(d.say(request("snapshot", R"(["another"])"))), -32003);
  d.say(request("snapshot", R"(["s3"])"));
  d.say(request("restore", R"(["s3"])"));
  d.settle();
  EXPECT_EQ(std::count(d.run.carried_out.begin(), d.run.carried_out.end(), "restore s3"), 1);
  EXPECT_EQ(code_of(d.say(request("snapshot", R"([""])"))), -32602);
}

}  // namespace
}  // namespace muro::jsonrpc
