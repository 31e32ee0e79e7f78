// SPDX-License-Identifier: MIT
// The process of control code (`isolate: process`). It loads one library and runs one instance of it, in turns with the
// simulation that has started it. It ends with the simulation.
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <optional>

#include "control_library.hpp"
#include "crash_note.hpp"
#include "local_instance.hpp"
#include "plugins/common/child_process/as_child.hpp"
#include "plugins/controller/common/shared_call/shared_memory.hpp"
#include "process_protocol.hpp"

namespace muro::control {

namespace {

void answer(std::span<const std::byte> bytes, bool is_refusal = false) {
  const MessageHeader header{bytes.size(), is_refusal ? 1u : 0u};
  as_child::send(&header, sizeof header);
  as_child::send(bytes.data(), bytes.size());
}

std::vector<std::byte> next_request() {
  MessageHeader header;
  as_child::receive(&header, sizeof header);
  std::vector<std::byte> bytes(header.size);
  as_child::receive(bytes.data(), bytes.size());
  return bytes;
}

/// Serves the calls of the instance.
class Server {
 public:
  explicit Server(const muro_controller_table& table) : table_(table) {}

  void prepare(const Preparation& p) {
    const SharedLayout layout(describe(table_), p.input_sizes, p.output_sizes);
    if (!memory_.open(process_memory, layout.size())) {
      std::perror("the shared memory");
      _exit(1);
    }
    close(process_memory);  // so that control code that writes to all descriptors does not change it
    memory_.keep_from_copies();
    header_ = reinterpret_cast<SharedHeader*>(memory_.data());
    leave_crash_notes_in(*header_);
    input_sizes_ = layout.input_sizes_in(memory_.data());
    instance_.emplace(table_, p.setup, layout.memory(memory_.data()), LogSink{header_, &write_log});
    patience_ = Patience(std::chrono::nanoseconds(p.spin_nanoseconds));
    bound_memory(p.memory);
  }

  void serve() {
    for (;;) {
      while (!header_->turn.wait_for(Turn::Side::callee, patience_, std::chrono::hours(1))) continue;
      std::vector<std::uint32_t>& sizes = instance_->memory().input_sizes;
      if (!sizes.empty()) std::memcpy(sizes.data(), input_sizes_, sizes.size() * sizeof(std::uint32_t));
      tell(instance_->call({.function = header_->function,
                            .time = header_->time,
                            .period = header_->period,
                            .seed = header_->seed,
                            .index = header_->index,
                            .running_text = header_->in_function}));
      header_->turn.pass_to(Turn::Side::caller);
    }
  }

 private:
  void tell(const Outcome& outcome) {
    header_->ending = outcome.ending;
    if (outcome.is_fine()) return;
    std::strncpy(header_->reason, outcome.reason.c_str(), sizeof header_->reason - 1);
    header_->reason[std::min(outcome.reason.size(), sizeof header_->reason - 1)] = 0;
  }

  static void write_log(void* context, std::uint32_t level, const char* text) {
    SharedHeader& h = *static_cast<SharedHeader*>(context);
    if (!text) return;
    const std::size_t room = sizeof h.log - h.log_size, size = strnlen(text, 1000);
    if (room < size + 2) {
      ++h.log_lost;
      return;
    }
    h.log[h.log_size] = char(std::min(level, MURO_LOG_ERROR));
    std::memcpy(h.log + h.log_size + 1, text, size);
    h.log[h.log_size + 1 + size] = 0;
    h.log_size += std::uint32_t(size) + 2;
  }

  muro_controller_table table_;
  SharedMemory memory_;
  SharedHeader* header_ = nullptr;
  const std::uint32_t* input_sizes_ = nullptr;
  std::optional<LocalInstance> instance_;
  Patience patience_{std::chrono::nanoseconds(0)};
};

void run() {
  const Greeting greeting = Greeting::ours();
  as_child::send(&greeting, sizeof greeting);
  const std::vector<std::byte> first = next_request();
  std::optional<Server> server;
  try {
    Reader request(first);
    const muro_controller_table table = load_library(request.text());
    Writer said;
    write(describe(table), said);
    answer(said.bytes());
    server.emplace(table);
  } catch (const std::exception& e) {
    answer(std::as_bytes(std::span(e.what(), std::strlen(e.what()))), true);
    return;
  }
  const std::vector<std::byte> second = next_request();
  Reader request(second);
  server->prepare(read_preparation(request));
  answer({});
  server->serve();
}

}  // namespace

}  // namespace muro::control

int main() {
  using namespace muro;
  if (!as_child::begin()) {
    std::fputs("muro_controller_host runs control code for muro, which starts it; it has no other use\n", stderr);
    return 2;
  }
  setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  control::leave_crash_notes();
  if (!as_child::end_with_parent()) return 1;
  control::run();
  _exit(0);
}
