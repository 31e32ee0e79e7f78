// SPDX-License-Identifier: MIT
// The client library: one parser process for all libraries of a program, which find each other here.
#include <signal.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>

#include "child.hpp"
#include "plugins/common/child_process/own_folder.hpp"
#include "protocol.hpp"

namespace muro::parser_process {

namespace {

/// A number as a user reads it.
std::string rounded(double number) {
  const auto tenths = std::llround(number * 10);
  return std::to_string(tenths / 10) + (tenths % 10 ? "." + std::to_string(tenths % 10) : "");
}

class Client {
 public:
  Ending ask(std::string_view service, const void* request, std::uint64_t size, Sink& sink) {
    const std::lock_guard lock(mutex_);
    // A process that nobody has asked for some time ends by itself, maybe just now.
    for (const bool again : {false, true}) {
      if (!child_.is_there() && !start()) return tell(Ending::no_process, reason_, sink);
      child_.clear_output();
      Ending ending = Ending::died;
      if (exchange(service, request, size, sink, ending)) return ending;
      const Child::Death death = child_.end();
      if (death.signal != 0 || death.exit_code != 0 || again) return tell(Ending::died, reason_of(death), sink);
    }
    return Ending::died;
  }

 private:
  /// Of the program, beside this library.
  static std::string program() { return (std::filesystem::path(own_folder()) / program_file).string(); }

  bool start() {
    if (!child_.start(program(), reason_)) return false;
    Hello theirs{};
    const Hello ours = Hello::ours();
    if (!child_.receive(&theirs, sizeof theirs)) {
      const Child::Death death = child_.end();
      reason_ = program() + " has ended at its start" + (death.last_words.empty() ? "" : ": " + death.last_words) +
                "; install muro again";
      return false;
    }
    if (std::memcmp(&theirs, &ours, sizeof ours) == 0) return true;
    child_.end();
    reason_ = program() + " is of another muro; install muro again";
    return false;
  }

  /// False when the process has ended.
  bool exchange(std::string_view service, const void* request, std::uint64_t size, Sink& sink, Ending& ending) {
    const RequestHeader header{service.size(), size};
    if (!child_.send(&header, sizeof header) || !child_.send(service.data(), service.size()) ||
        !child_.send(request, size))
      return false;
    FrameHeader frame{};
    if (!child_.receive(&frame, sizeof frame)) return false;
    ending = frame.frame == Frame::answer    ? Ending::answered
             : frame.frame == Frame::refusal ? Ending::refused
                                             : Ending::no_service;
    void* const room = sink.reserve(&sink, frame.size);
    return room && child_.receive(room, frame.size);
  }

  static std::string reason_of(const Child::Death& death) {
    if (death.exit_code == exit_out_of_memory)
      return "that needed more than " + rounded(double(death.allowed.memory >> 20)) +
             " MiB of memory, which is too much for its size (" + memory_variable + "=MIB allows more)";
    if (death.signal == SIGPROF || death.signal == SIGALRM)
      return "that took more than " + rounded(death.allowed.seconds) + " s, which is too long for its size (" +
             seconds_variable + "=SECONDS allows more)";
    const std::string last_words = death.last_words.empty() ? "" : ": " + death.last_words;
    if (death.signal == SIGKILL)
      return "its reader was killed, maybe because the system was short of memory, or from outside";
    if (death.signal != 0) return "its reader crashed (" + name_of_signal(death.signal) + last_words + ")";
    return "its reader ended with exit code " + std::to_string(death.exit_code) + last_words;
  }

  static Ending tell(Ending ending, const std::string& text, Sink& sink) {
    if (void* const room = sink.reserve(&sink, text.size())) std::memcpy(room, text.data(), text.size());
    return ending;
  }

  std::mutex mutex_;
  Child child_;
  std::string reason_;
};

}  // namespace

}  // namespace muro::parser_process

// AskFunction of protocol.hpp; the name is ask_symbol.
extern "C" __attribute__((visibility("default"))) int muro_parser_ask_1(const char* service, const void* request,
                                                                        std::uint64_t size,
                                                                        muro::parser_process::Sink* sink) noexcept {
  using namespace muro::parser_process;
  // lives until the program has ended, as threads may ask until then
  static auto& client = *new Client;
  return int(client.ask(service, request, size, *sink));
}
