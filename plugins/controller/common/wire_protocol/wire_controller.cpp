// SPDX-License-Identifier: MIT
#include "plugins/controller/common/wire_protocol/wire_controller.hpp"

#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/group_text.hpp"
#include "plugins/controller/common/wire_protocol/number_text.hpp"

namespace muro::wire {

namespace {

/// Limit for rounds of messages in a step of lockstep; after that time goes on.
constexpr int most_rounds = 100'000;

}  // namespace

void WireController::connect(Connector& c) {
  const Parameters& p = c.parameters();
  const Protocol& protocol = protocol_of(p.text("protocol"));
  const std::string name(p.text("name"));
  if (!is_name(name)) throw Error("`name` is " + quote(name) + ", but must be made of " + name_rule);
  first_report_ = p.real("report");
  check_report_rate(c.rate());
  notes_ = CallNotes::of(c.host());
  for (std::uint32_t i = 0; i < c.items().size(); ++i) {
    const Item& item = c.items()[i];
    const std::string owner = item.robot ? std::string(item.robot->name) : "world";
    servers_.push_back(std::make_unique<Server>(c, i, owner + "/" + name, protocol));
  }
}

void WireController::connect_by_name(Connector& c) {
  for (std::uint32_t i = 0; i < servers_.size(); ++i) servers_[i]->set_groups(title_, groups_of(c, i), first_report_);
}

void WireController::start() {
  for (const auto& s : servers_) s->open();
}

void WireController::restored() {
  for (const auto& s : servers_) s->restored();
}

void WireController::finish() {
  for (const auto& s : servers_) s->finish();
}

std::span<const Phase> WireController::phases() const {
  static constexpr Phase whole[] = {{Phase::IndexSpace::whole}};
  return whole;
}

/// In lockstep, time stands still until every client waits for something that takes time.
void WireController::step(const Step& step, Range) {
  for (const auto& s : servers_) s->begin(step);
  const bool is_lockstep = !servers_.empty() && servers_.front()->is_lockstep();
  for (int round = 0; serve_all(step) && is_lockstep && round < most_rounds;) ++round;
  end_step(step);
}

bool WireController::serve_all(const Step& step) {
  bool any = false;
  const Range all{0, std::uint32_t(servers_.size())};
  for (const auto& server : NotedSpan(servers_.data(), all, notes_ ? &notes_->of_this_thread() : nullptr))
    any |= server->serve(step);
  return any;
}

void WireController::check_report_rate(double rate) const {
  if (rate == 0 || first_report_ <= rate * (1 + 1e-9)) return;
  std::string text = "`report` is ";
  add_number(text, first_report_);
  text += " Hz, more than the rate of the controller, ";
  add_number(text, rate);
  throw Error(text.append(" Hz; raise `rate`, or lower `report`"));
}

}  // namespace muro::wire
