// SPDX-License-Identifier: MIT
// The process of control code (`isolate: process`): loads one library and runs one instance of it, in turns with the
// simulation, which starts it. It ends with that.
#include <poll.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>

#include "control_library.hpp"
#include "crash_note.hpp"
#include "local_instance.hpp"
#include "plugins/common/shared_call/shared_memory.hpp"
#include "process_protocol.hpp"

namespace muro::control {

namespace {

/// The simulation is gone where these fail.
void send_bytes(const void* data, std::uint64_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(process_socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) _exit(0);
    at += sent;
    size -= std::uint64_t(sent);
  }
}
void receive_bytes(void* data, std::uint64_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t received = recv(process_socket, at, size, MSG_WAITALL);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) _exit(0);
    at += received;
    size -= std::uint64_t(received);
  }
}

void answer(std::span<const std::byte> bytes, bool is_refusal = false) {
  const MessageHeader header{bytes.size(), is_refusal ? 1u : 0u};
  send_bytes(&header, sizeof header);
  send_bytes(bytes.data(), bytes.size());
}

std::vector<std::byte> next_request() {
  MessageHeader header;
  receive_bytes(&header, sizeof header);
  std::vector<std::byte> bytes(header.size);
  receive_bytes(bytes.data(), bytes.size());
  return bytes;
}

/// Ends the process when the simulation has ended, also in the middle of a call.
void* watch_simulation(void*) {
  pollfd simulation{process_socket, 0, 0};  // an end of the other side is always told
  while (poll(&simulation, 1, -1) < 0 && errno == EINTR) continue;
  _exit(0);
}

void start_watch() {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, 64 * 1024);  // it counts as memory of the control code
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);  // signals are for the control code's thread
  pthread_t thread;
  if (pthread_create(&thread, &attributes, watch_simulation, nullptr) == 0) pthread_detach(thread);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_attr_destroy(&attributes);
}

/// Of the one instance.
class Server {
 public:
  explicit Server(const muro_controller_table& table) : table_(table) {}

  void prepare(const Preparation& p) {
    const SharedLayout layout(describe(table_), p.input_sizes, p.output_sizes);
    if (!memory_.open(process_memory, layout.size())) {
      std::perror("the shared memory");
      _exit(1);
    }
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
  send_bytes(&greeting, sizeof greeting);
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

int main(int count, char** words) {
  using namespace muro::control;
  int type = 0;
  socklen_t size = sizeof type;
  if (count != 2 || getsockopt(process_socket, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
    std::fputs("muro_controller_host runs control code for muro, which starts it; it has no other use\n", stderr);
    return 2;
  }
  if (std::strcmp(words[1], "main") == 0) prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  leave_crash_notes();
  start_watch();
  run();
  _exit(0);
}
