// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "control_instance.hpp"
#include "control_process.hpp"
#include "port.hpp"
#include "shared_layout.hpp"

namespace muro::control {

/// An instance in a separate process, called through shared memory.
class RemoteInstance final : public ControlInstance {
 public:
  /// `table`: description that the process has sent. Throws ProcessError.
  RemoteInstance(std::unique_ptr<ControlProcess> process, const ControlTable& table, const InstanceSetup& setup,
                 std::span<const Port> inputs, std::span<const Port> outputs, LogSink log);
  ~RemoteInstance() override;

  InstanceMemory& memory() override { return memory_; }
  Outcome call(const Call& call) override;
  bool is_alive() const override { return is_alive_; }

 private:
  SharedHeader& header() { return *reinterpret_cast<SharedHeader*>(process_->memory().data()); }
  /// Returns false when the process has ended, or takes too long.
  bool wait(bool is_patient, bool& timed_out);
  Outcome death(bool timed_out);
  void hand_on_log();
  void hand_on_output();

  std::unique_ptr<ControlProcess> process_;
  bool has_instances_;
  std::vector<std::uint32_t> input_sizes_, output_sizes_;
  SharedLayout layout_;
  InstanceMemory memory_;
  LogSink log_;
  Patience patience_;
  std::uint32_t printed_lines_ = 0;
  bool is_alive_ = true;
};

}  // namespace muro::control
