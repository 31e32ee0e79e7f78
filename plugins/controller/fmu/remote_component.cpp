// SPDX-License-Identifier: MIT
// An instance in a separate process.
#include <utility>

#include "component.hpp"
#include "instance_process.hpp"
#include "muro/algorithm.hpp"
#include "remote_protocol.hpp"

namespace muro::fmu {

namespace {

class RemoteComponent final : public Component {
 public:
  explicit RemoteComponent(const Setup& setup) : Component(setup), process_(setup.timeout) {
    const ModelDescription& d = *setup.description;
    RemoteSetup remote{setup.library.string(), setup.resources.string(), setup.name, d.token};
    remote.version = d.version;
    remote.can_keep_state = d.can_keep_state;
    remote.can_serialize_state = d.can_serialize_state;
    remote.variable_step_size = d.variable_step_size;
    remote.might_return_early = d.might_return_early;
    remote.logs_all = setup.log->logs_all();
    remote.tolerance = d.tolerance;
    add(Call::load);
    remote.write(request_);
    finish("load");
  }
  ~RemoteComponent() override {
    if (!process_.is_running()) return;
    try {
      run(Call::end, "FreeInstance");
    } catch (const Error&) {
      // the process is gone in any case
    }
  }

  void instantiate() override { run(Call::instantiate, "Instantiate"); }
  void reset() override { run(Call::reset, "Reset"); }
  void enter_configuration() override { run(Call::enter_configuration, "EnterConfigurationMode"); }
  void exit_configuration() override { run(Call::exit_configuration, "ExitConfigurationMode"); }
  void enter_initialization(double start) override {
    add(Call::enter_initialization);
    request_.value(start);
    finish("EnterInitializationMode");
  }
  void exit_initialization() override { run(Call::exit_initialization, "ExitInitializationMode"); }

  // These are sent with the next call, which also reports their errors.
  void set(Type type, std::span<const std::uint32_t> references, const void* values, std::size_t count) override {
    add(Call::set);
    request_.value(type);
    request_.list(references);
    request_.list(
        std::span(static_cast<const std::byte*>(values), count * bytes_of(type, setup_.description->version)));
    request_.value(std::uint64_t(count));
  }
  void set_text(std::uint32_t reference, const std::string& text) override {
    add(Call::set_text);
    request_.value(reference);
    request_.text(text);
  }
  void set_bytes(std::uint32_t reference, std::span<const std::uint8_t> bytes) override {
    add(Call::set_bytes);
    request_.value(reference);
    request_.list(bytes);
  }
  void keep_state() override { add(Call::keep_state); }
  void return_to_state() override { add(Call::return_to_state); }

  void get(Type type, std::span<const std::uint32_t> references, void* values, std::size_t count) override {
    add(Call::get);
    request_.value(type);
    request_.list(references);
    request_.value(std::uint64_t(count));
    const std::vector<std::byte> bytes = finish("Get").list<std::byte>();
    check(bytes.size() == count * bytes_of(type, setup_.description->version));
    std::memcpy(values, bytes.data(), bytes.size());
  }
  std::span<const std::uint8_t> get_bytes(std::uint32_t reference) override {
    add(Call::get_bytes);
    request_.value(reference);
    bytes_ = finish("GetBinary").list<std::uint8_t>();
    return bytes_;
  }
  StepOutcome do_step(double time, double size) override {
    add(Call::do_step);
    request_.value(time);
    request_.value(size);
    Reader answer = finish("DoStep");
    return read_outcome(answer);
  }
  std::size_t state_size() override { return run(Call::state_size, "SerializedFMUStateSize").value<std::uint64_t>(); }
  void write_state(std::span<std::uint8_t> bytes) override {
    add(Call::write_state);
    request_.value(std::uint64_t(bytes.size()));
    const std::vector<std::uint8_t> state = finish("SerializeFMUState").list<std::uint8_t>();
    check(state.size() == bytes.size());
    std::copy(state.begin(), state.end(), bytes.begin());
  }
  void read_state(std::span<const std::uint8_t> bytes) override {
    add(Call::read_state);
    request_.list(bytes);
    finish("DeserializeFMUState");
  }

 private:
  void add(Call call) { request_.value(call); }

  Reader run(Call call, const char* name) {
    add(call);
    return finish(name);
  }

  /// Sends the added calls. Data of the answer is valid until the next request.
  Reader finish(const char* name) {
    CallNote* const note = setup_.notes ? &setup_.notes->of_this_thread() : nullptr;
    if (note) note->set_library(setup_.library.c_str(), name);
    const Writer request = std::exchange(request_, {});
    if (!process_.is_running()) throw Error("its process has ended before");
    answer_ = process_.ask(request.bytes());
    if (note) note->set_library(nullptr, nullptr);
    Reader reader(answer_);
    for (auto lines = reader.value<std::uint64_t>(); lines > 0; --lines) {
      const auto level = reader.value<LogLevel>();
      setup_.log->pass_on(level, reader.text());
    }
    const auto how = reader.value<Answer>();
    if (how == Answer::done) return reader;
    const std::string text = reader.text();
    if (how == Answer::failed) throw Error(text);
    throw Error("it has crashed in `" + text + "`: its process " + process_.reap().text);
  }

  static void check(bool fine) {
    if (!fine) throw Error("its process answers with a wrong size");
  }

  InstanceProcess process_;
  Writer request_;
  std::vector<std::byte> answer_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::unique_ptr<Component> make_remote_component(const Component::Setup& setup) {
  return std::make_unique<RemoteComponent>(setup);
}

}  // namespace muro::fmu
