// SPDX-License-Identifier: MIT
// The client library: one parser process for all libraries of a program, which share it here.
#include <signal.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <string>

#include "child.hpp"
#include "plugins/common/child_process/own_folder.hpp"
#include "protocol.hpp"

namespace muro::parser_process {

namespace {

/// Returns a number in a form for users.
std::string rounded(double number) {
  const auto tenths = std::llround(number * 10);
  return std::to_string(tenths / 10) + (tenths % 10 ? "." + std::to_string(tenths % 10) : "");
}

/// Memory on the heap for an answer that is kept.
struct Kept : Sink {
  std::unique_ptr<std::byte[]> bytes{};
  std::uint64_t size = 0;

  Kept() : Sink{&Kept::make_room} {}
  static void* make_room(Sink* sink, std::uint64_t size) noexcept {
    auto& self = *static_cast<Kept*>(sink);
    self.bytes.reset(new (std::nothrow) std::byte[size]);
    self.size = self.bytes ? size : 0;
    return self.bytes.get();
  }
};
using Handle = std::shared_ptr<const Kept>;

class Client {
 public:
  Ending ask(std::string_view service, const void* request, std::uint64_t size, Sink& sink) {
    const std::lock_guard lock(mutex_);
    return ask_process(service, request, size, sink);
  }

  Ending share(std::string_view service, const void* request, std::uint64_t size, std::string_view version,
               SharedAnswer& answer, Sink& sink) {
    const std::lock_guard lock(mutex_);
    std::string key(service);
    key.append(1, '\0').append(version).append(1, '\0').append(static_cast<const char*>(request), size);
    Handle found = shared_[key].lock();
    if (!found) {
      const auto kept = std::make_shared<Kept>();
      const Ending ending = ask_process(service, request, size, *kept);
      if (ending != Ending::answered) {
        shared_.erase(key);
        return tell(ending, {reinterpret_cast<const char*>(kept->bytes.get()), kept->size}, sink);
      }
      shared_[key] = found = kept;
    }
    latest_ = found;  // kept, because the readers of a scene ask one after the other
    std::erase_if(shared_, [](const auto& entry) { return entry.second.expired(); });
    answer = {found->bytes.get(), found->size, new Handle(found)};
    return Ending::answered;
  }

 private:
  Ending ask_process(std::string_view service, const void* request, std::uint64_t size, Sink& sink) {
    // A process that was idle for some time ends on its own, maybe right now.
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

  /// Returns the path of the program, beside this library.
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

  /// Returns false if the process has ended.
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
  std::map<std::string, std::weak_ptr<const Kept>> shared_;
  Handle latest_;
};

Client& client() {
  // lives until the program has ended, because threads may ask until then
  static auto& all = *new Client;
  return all;
}

}  // namespace

}  // namespace muro::parser_process

// AskFunction of protocol.hpp; the name is ask_symbol.
extern "C" __attribute__((visibility("default"))) int muro_parser_ask_1(const char* service, const void* request,
                                                                        std::uint64_t size,
                                                                        muro::parser_process::Sink* sink) noexcept {
  using namespace muro::parser_process;
  return int(client().ask(service, request, size, *sink));
}

// ShareFunction and ReleaseFunction
extern "C" __attribute__((visibility("default"))) int muro_parser_share_1(const char* service, const void* request,
                                                                          std::uint64_t size, const char* version,
                                                                          muro::parser_process::SharedAnswer* answer,
                                                                          muro::parser_process::Sink* sink) noexcept {
  using namespace muro::parser_process;
  return int(client().share(service, request, size, version, *answer, *sink));
}
extern "C" __attribute__((visibility("default"))) void muro_parser_release_1(void* handle) noexcept {
  delete static_cast<muro::parser_process::Handle*>(handle);
}
