// SPDX-License-Identifier: MIT
// Lines of clients of controller.jsonrpc, which a simulation in memory answers.
#include <sstream>

#include "plugins/controller/jsonrpc/service_testing.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

constexpr int most_requests = 10'000;  ///< in the input

/// Checks that answers are JSON, one message a line. Ends requests that wait for a time that does not come.
void read_as_jsonrpc(Bytes bytes) {
  jsonrpc::testing::Dialogue dialogue;
  const auto check = [&](const std::string& said) {
    std::istringstream replies(said);
    for (std::string line; std::getline(replies, line);) {
      const jsonrpc::Json reply = jsonrpc::Json::parse(line, nullptr, false);
      require(!reply.is_discarded(), "a reply is no JSON");
      for (const jsonrpc::Json& one : reply.is_array() ? reply : jsonrpc::Json{reply})
        if (one.contains("error")) outcome(one["error"]["message"].get<std::string>());
    }
  };
  std::istringstream lines(text_of(bytes));
  int number = 0;
  for (std::string line; number < 100 && std::getline(lines, line); ++number) {
    check(dialogue.say(line + "\n"));
    dialogue.service.send_updates();
    if (number % 3 == 2)
      dialogue.attend();
    else
      dialogue.next_step();
    check(dialogue.heard());
  }
  dialogue.service.disconnected(0);
  for (int requests = 0; requests < most_requests && dialogue.service.clients() > 0; ++requests) {
    dialogue.service.time_was_set(0);  // ends requests that wait for a time or a pause
    dialogue.attend();
    dialogue.next_step();
  }
  require(dialogue.service.clients() == 0, "a client that has left and was answered is not forgotten");
}

}  // namespace muro::fuzz
