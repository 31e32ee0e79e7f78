// SPDX-License-Identifier: MIT
// Messages and replies from section 7 of the specification of JSON-RPC 2.0.
#include "message.hpp"

#include <gtest/gtest.h>

namespace muro::jsonrpc {
namespace {

/// Carries out the methods of the specification's examples.
void answer_as_example(Message& message) {
  const Request& r = *message.present();
  const Json& p = r.params;
  if (r.method == "subtract") {
    const bool is_named = p.is_object();
    const int a = (is_named ? p.at("minuend") : p.at(0)).get<int>();
    message.answer(a - (is_named ? p.at("subtrahend") : p.at(1)).get<int>());
  } else if (r.method == "sum") {
    int total = 0;
    for (const Json& x : p) total += x.get<int>();
    message.answer(total);
  } else if (r.method == "get_data") {
    message.answer({"hello", 5});
  } else if (r.method == "update" || r.method == "notify_hello" || r.method == "notify_sum") {
    message.answer("kept to ourselves");
  } else {
    message.fail({Code::method_not_found, "Method not found"});
  }
}

/// Returns the reply to a line, without the explanations that the specification does not define.
Json reply_to(std::string_view line) {
  Message message(line);
  while (message.present()) answer_as_example(message);
  const std::string text = message.reply();
  if (text.empty()) return "nothing";
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  Json reply = Json::parse(text);
  const auto strip = [](Json& r) {
    if (r.contains("error")) r["error"].erase("data");
  };
  if (reply.is_array())
    for (Json& r : reply) strip(r);
  else
    strip(reply);
  return reply;
}

void expect_dialogue(std::string_view line, std::string_view reply) {
  EXPECT_EQ(reply_to(line), reply.empty() ? Json("nothing") : Json::parse(reply)) << line;
}

TEST(Message, CarriesParametersByPosition) {
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "subtract", "params": [42, 23], "id": 1})",
                  R"({"jsonrpc": "2.0", "result": 19, "id": 1})");
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "subtract", "params": [23, 42], "id": 2})",
                  R"({"jsonrpc": "2.0", "result": -19, "id": 2})");
}

TEST(Message, CarriesParametersByName) {
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "subtract", "params": {"subtrahend": 23, "minuend": 42}, "id": 3})",
                  R"({"jsonrpc": "2.0", "result": 19, "id": 3})");
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "subtract", "params": {"minuend": 42, "subtrahend": 23}, "id": 4})",
                  R"({"jsonrpc": "2.0", "result": 19, "id": 4})");
}

TEST(Message, IsNotAnsweredWhereItIsANotification) {
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "update", "params": [1,2,3,4,5]})", "");
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "foobar"})", "");
}

TEST(Message, NamesAMethodThatIsNotThere) {
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "foobar", "id": "1"})",
                  R"({"jsonrpc": "2.0", "error": {"code": -32601, "message": "Method not found"}, "id": "1"})");
}

TEST(Message, ThatIsNoJsonIsAParseError) {
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "foobar, "params": "bar", "baz])",
                  R"({"jsonrpc": "2.0", "error": {"code": -32700, "message": "Parse error"}, "id": null})");
  expect_dialogue(R"([{"jsonrpc": "2.0", "method": "sum", "params": [1,2,4], "id": "1"}, {"jsonrpc": "2.0", "method")",
                  R"({"jsonrpc": "2.0", "error": {"code": -32700, "message": "Parse error"}, "id": null})");
}

TEST(Message, ThatIsNoRequestIsInvalid) {
  constexpr std::string_view invalid =
      R"({"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null})";
  for (const char* line :
       {R"({"jsonrpc": "2.0", "method": 1, "params": "bar"})", "[]", "7", R"({"jsonrpc": "1.0", "method": "sum"})",
        R"({"method": "sum"})", R"({"jsonrpc": "2.0", "method": "sum", "id": [1]})"})
    expect_dialogue(line, invalid);
  expect_dialogue(R"({"jsonrpc": "2.0", "method": "sum", "params": 1, "id": 5})",
                  R"({"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": 5})");
}

TEST(Message, ThatIsABatchIsAnsweredInOneLine) {
  expect_dialogue("[1]",
                  R"([{"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null}])");
  expect_dialogue("[1,2,3]", R"([
    {"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null},
    {"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null},
    {"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null}])");
  // The replies may come in any order; here entries that are no requests are answered first.
  expect_dialogue(R"([{"jsonrpc": "2.0", "method": "sum", "params": [1,2,4], "id": "1"},
        {"jsonrpc": "2.0", "method": "notify_hello", "params": [7]},
        {"jsonrpc": "2.0", "method": "subtract", "params": [42,23], "id": "2"},
        {"foo": "boo"},
        {"jsonrpc": "2.0", "method": "foo.get", "params": {"name": "myself"}, "id": "5"},
        {"jsonrpc": "2.0", "method": "get_data", "id": "9"}])",
                  R"([{"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null},
        {"jsonrpc": "2.0", "result": 7, "id": "1"},
        {"jsonrpc": "2.0", "result": 19, "id": "2"},
        {"jsonrpc": "2.0", "error": {"code": -32601, "message": "Method not found"}, "id": "5"},
        {"jsonrpc": "2.0", "result": ["hello", 5], "id": "9"}])");
  expect_dialogue(R"([{"jsonrpc": "2.0", "method": "notify_sum", "params": [1,2,4]},
        {"jsonrpc": "2.0", "method": "notify_hello", "params": [7]}])",
                  "");
}

TEST(Message, IsNotReadWhereItIsNestedTooDeep) {
  const std::string deep(100'000, '[');
  EXPECT_EQ(reply_to(deep)["error"]["code"], -32700);
  const std::string just_fine = R"({"jsonrpc":"2.0","method":"get_data","id":1,"params":)" +
                                std::string(deepest_nesting - 1, '[') + std::string(deepest_nesting - 1, ']') + "}";
  EXPECT_TRUE(reply_to(just_fine).contains("result"));
  EXPECT_TRUE(reply_to(R"({"jsonrpc":"2.0","method":"get_data","id":"\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["})")
                  .contains("result"))
      << "brackets in a text are no nesting";
}

TEST(Message, HasABatchOfBoundedLength) {
  std::string ones = "[1";
  for (std::size_t i = 1; i < Message::largest_batch; ++i) ones += ",1";
  EXPECT_EQ(reply_to(ones + "]").size(), Message::largest_batch);
  EXPECT_EQ(reply_to(ones + ",1]")["error"]["code"], -32600);
}

TEST(Message, KeepsTheIdAsItCame) {
  for (const char* id : {"null", "-7", "1.5", "18446744073709551615", R"("a b")"})
    EXPECT_EQ(reply_to(std::string(R"({"jsonrpc":"2.0","method":"get_data","id":)") + id + "}")["id"], Json::parse(id));
}

}  // namespace
}  // namespace muro::jsonrpc
