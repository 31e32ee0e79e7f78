// SPDX-License-Identifier: MIT
// The process of one instance of an FMU (`isolate: process`). The plugin starts it, and it ends with the plugin.
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>
#include <optional>

#include "component.hpp"
#include "plugins/common/child_process/as_child.hpp"
#include "remote_protocol.hpp"

namespace muro::fmu {

namespace {

/// Keeps log lines for the next answer.
class Lines final : public Host {
 public:
  void log(LogLevel level, std::string_view text) noexcept override {
    const std::lock_guard lock(mutex_);
    lines_.emplace_back(level, text);
  }
  void write(Writer& to) {
    const std::lock_guard lock(mutex_);
    to.value(std::uint64_t(lines_.size()));
    for (const auto& [level, text] : lines_) {
      to.value(level);
      to.text(text);
    }
    lines_.clear();
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<LogLevel, std::string>> lines_;
};

/// The function of the FMU that runs now, for the message about a crash.
class OwnNotes final : public CallNotes {
 public:
  CallNote& of_this_thread() noexcept override { return note; }
  CallNote note;
};
OwnNotes own_notes;

/// Sends the last answer: a function has crashed. Calls only functions that are allowed in a signal handler.
void tell_crash(int, const siginfo_t&) {
  const char* const function = own_notes.note.function.load();
  const char* const name = function ? function : "muro_fmu_host";
  const std::uint64_t length = std::strlen(name), lines = 0;
  const std::uint64_t size = sizeof lines + 1 + sizeof length + length;
  const auto answer = Answer::crashed;
  char bytes[512];
  std::size_t used = 0;
  const auto put = [&](const void* data, std::size_t n) {
    if (used + n <= sizeof bytes) std::memcpy(bytes + used, data, n);
    used += n;
  };
  put(&size, sizeof size);
  put(&lines, sizeof lines);
  put(&answer, 1);
  put(&length, sizeof length);
  put(name, length);
  if (used <= sizeof bytes && as_child::has_socket())
    static_cast<void>(!::send(child_socket, bytes, used, MSG_NOSIGNAL));
}

class Server {
 public:
  /// Carries out the calls of a request; `out` gets the result of the last one.
  void serve(Reader request, Writer& out) {
    while (!request.at_end()) {
      out = {};
      carry_out(request.value<Call>(), request, out);
    }
  }
  bool is_over() const { return is_over_; }
  Lines& lines() { return lines_; }

 private:
  void load(Reader& in) {
    setup_ = RemoteSetup::read(in);
    description_.version = setup_.version;
    description_.token = setup_.token;
    description_.can_keep_state = setup_.can_keep_state;
    description_.can_serialize_state = setup_.can_serialize_state;
    description_.variable_step_size = setup_.variable_step_size;
    description_.might_return_early = setup_.might_return_early;
    description_.tolerance = setup_.tolerance;
    log_.emplace(lines_, setup_.name, setup_.logs_all);
    own_notes.note.set_library(setup_.library.c_str(), "load");
    binary_.emplace(setup_.library);
    own_notes.note.set_library(nullptr, nullptr);
    Component::Setup s;
    s.description = &description_;
    s.binary = &*binary_;
    s.resources = setup_.resources;
    s.name = setup_.name;
    s.notes = &own_notes;
    s.log = &*log_;
    component_ = make_component(s);
  }

  void carry_out(Call call, Reader& in, Writer& out) {
    if (call == Call::load) return load(in);
    if (!component_) throw Error("no FMU has been loaded");
    Component& c = *component_;
    switch (call) {
      case Call::load:
        break;
      case Call::instantiate:
        return c.instantiate();
      case Call::reset:
        return c.reset();
      case Call::enter_configuration:
        return c.enter_configuration();
      case Call::exit_configuration:
        return c.exit_configuration();
      case Call::enter_initialization:
        return c.enter_initialization(in.value<double>());
      case Call::exit_initialization:
        return c.exit_initialization();
      case Call::set: {
        const auto type = in.value<Type>();
        const auto references = in.list<std::uint32_t>();
        const auto values = in.list<std::byte>();
        return c.set(type, references, values.data(), in.value<std::uint64_t>());
      }
      case Call::get: {
        const auto type = in.value<Type>();
        const auto references = in.list<std::uint32_t>();
        const auto count = in.value<std::uint64_t>();
        std::vector<std::byte> values(count * bytes_of(type, setup_.version));
        c.get(type, references, values.data(), count);
        return out.list(std::span<const std::byte>(values));
      }
      case Call::set_text: {
        const auto reference = in.value<std::uint32_t>();
        return c.set_text(reference, in.text());
      }
      case Call::set_bytes: {
        const auto reference = in.value<std::uint32_t>();
        return c.set_bytes(reference, in.list<std::uint8_t>());
      }
      case Call::get_bytes:
        return out.list(c.get_bytes(in.value<std::uint32_t>()));
      case Call::do_step: {
        const auto time = in.value<double>();
        return write(c.do_step(time, in.value<double>()), out);
      }
      case Call::keep_state:
        return c.keep_state();
      case Call::return_to_state:
        return c.return_to_state();
      case Call::state_size:
        return out.value(std::uint64_t(c.state_size()));
      case Call::write_state: {
        std::vector<std::uint8_t> state(in.value<std::uint64_t>());
        c.write_state(state);
        return out.list(std::span<const std::uint8_t>(state));
      }
      case Call::read_state:
        return c.read_state(in.list<std::uint8_t>());
      case Call::end:
        component_.reset();
        is_over_ = true;
        return;
    }
    throw Error("a call that nobody knows");
  }

  Lines lines_;
  RemoteSetup setup_;
  ModelDescription description_;
  std::optional<MessageLog> log_;
  std::optional<Binary> binary_;
  std::unique_ptr<Component> component_;
  bool is_over_ = false;
};

void run() {
  const Greeting greeting;
  as_child::send(&greeting, sizeof greeting);
  Server server;
  while (!server.is_over()) {
    std::uint64_t size = 0;
    as_child::receive(&size, sizeof size);
    std::vector<std::byte> request(size);
    as_child::receive(request.data(), request.size());
    Writer result, answer;
    Answer how = Answer::done;
    std::string problem;
    try {
      server.serve(Reader(request), result);
    } catch (const std::exception& e) {
      how = Answer::failed;
      problem = e.what();
    }
    server.lines().write(answer);
    answer.value(how);
    if (how == Answer::failed) answer.text(problem);
    const std::uint64_t answer_size =
        answer.bytes().size() + (how == Answer::done ? result.bytes().size() : std::size_t(0));
    as_child::send(&answer_size, sizeof answer_size);
    as_child::send(answer.bytes().data(), answer.bytes().size());
    if (how == Answer::done) as_child::send(result.bytes().data(), result.bytes().size());
  }
}

}  // namespace

}  // namespace muro::fmu

int main() {
  using namespace muro;
  if (!as_child::begin()) {
    std::fputs("muro_fmu_host runs an FMU for muro, which starts it; it has no other use\n", stderr);
    return 2;
  }
  as_child::catch_crashes(fmu::tell_crash);
  if (!as_child::end_with_parent()) return 1;
  fmu::run();
  std::fflush(stdout);
  _exit(0);
}
