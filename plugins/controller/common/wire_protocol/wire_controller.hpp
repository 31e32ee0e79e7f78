// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/ext/call_note.hpp"
#include "plugins/controller/common/stream/address.hpp"
#include "plugins/controller/common/wire_protocol/server.hpp"

namespace muro::wire {

/// Parameters that all these controllers have. `groups`: text that describes the groups. `name`: default of `name`.
constexpr std::array<Parameter, 5> wire_parameters(std::string_view groups, std::string_view name) {
  return {
      stream::stream_parameter().required(),
      text("protocol", "text", "how messages look: lines, or frames of bytes").one_of(protocol_names),
      texts("groups", groups),
      real("report", "Hz", 0, "clients get the first group unasked so often, until they ask for something else; 0: not")
          .between(0, 1e6),
      text("name", name, "of the streams in recordings and reports; two of them on one robot need two names")};
}

/// A controller that serves groups of numbers: one stream for each item.
class WireController : public Algorithm {
 public:
  void connect(Connector& c) override;
  void connect_by_name(Connector& c) override;
  void start() override;
  void restored() override;
  void finish() override;
  std::span<const Phase> phases() const final;
  void step(const Step& step, Range range) final;

 protected:
  explicit WireController(std::string title) : title_(std::move(title)) {}

  /// Returns the groups that clients of an item read and set, at least one. [setup]
  virtual std::vector<std::unique_ptr<Group>> groups_of(Connector& c, std::uint32_t item) = 0;
  /// Called after all messages of this step. [step]
  virtual void end_step(const Step& step) { static_cast<void>(step); }
  const Service& service(std::uint32_t item) const { return servers_[item]->service(); }

 private:
  void check_report_rate(double rate) const;
  bool serve_all(const Step& step);

  const std::string title_;
  double first_report_ = 0;
  CallNotes* notes_ = nullptr;
  std::vector<std::unique_ptr<Server>> servers_;  ///< one for each item
};

}  // namespace muro::wire
