// SPDX-License-Identifier: MIT
#pragma once

#include "control_instance.hpp"

namespace muro::control {

/// An instance in this process.
class LocalInstance final : public ControlInstance {
 public:
  /// `table` has all fields and stays loaded.
  LocalInstance(const muro_controller_table& table, const InstanceSetup& setup, InstanceMemory memory, LogSink log);
  ~LocalInstance() override;

  InstanceMemory& memory() override { return memory_; }
  Outcome call(const Call& call) override;
  bool is_alive() const override { return true; }

 private:
  static constexpr std::size_t error_size = 1024;

  void connect_ports();
  void run(const Call& call);
  void create(const Call& call);
  void step(const Call& call);
  void save();
  void load();
  void destroy();
  /// Notes the function that runs now.
  void enter(const char* function);
  void require(bool fine);
  void forget_call();

  muro_controller_table table_;
  InstanceSetup setup_;
  InstanceMemory memory_;
  muro_log_sink log_;
  std::atomic<const char*>* running_ = nullptr;  ///< for the present call
  std::span<char> running_text_;                 ///< for the present call
  std::vector<const char*> arguments_;

  // by type, as in the C interface
  std::vector<const double*> inputs_;
  std::vector<double*> outputs_;
  std::vector<const std::int64_t*> integer_inputs_;
  std::vector<std::int64_t*> integer_outputs_;
  std::vector<const char*> text_inputs_;
  std::vector<char*> text_outputs_;

  void* instance_ = nullptr;  ///< instance with its own memory
  const char* function_ = "";
  char error_[error_size];
};

}  // namespace muro::control
