// SPDX-License-Identifier: MIT
// The parser process: reads files of others, to protect a program from errors in them. Its client starts it. It ends
// when its client ends, or has sent no request for a while.
#include <dlfcn.h>
#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>

#include "limits.hpp"
#include "plugins/common/child_process/as_child.hpp"
#include "service.hpp"

#if defined(__SANITIZE_ADDRESS__)
/// Replaces the bound of memory, which the sanitizer's own memory would exceed.
extern "C" const char* __asan_default_options() {
  return "hard_rss_limit_mb=4096:max_allocation_size_mb=2048:allocator_may_return_null=1";
}
#endif

namespace muro::parser_process {

std::vector<Service>& services() {
  static std::vector<Service> all;
  return all;
}

namespace {

constexpr Allowance base{std::uint64_t(512) << 20, 5};
constexpr int idle_milliseconds = 20'000;
/// Bytes that remain from requests, because libraries lose memory when they fail. Above the first number they are given
/// back if possible; above the second a new process is better.
constexpr long large_remainder = 64L << 20, largest_remainder = 512L << 20;

[[noreturn]] void out_of_memory() { _exit(exit_out_of_memory); }

void send_frame(Frame frame, const void* data, std::uint64_t size) {
  const FrameHeader header{frame, size};
  as_child::send(&header, sizeof header);
  as_child::send(data, size);
}

void serve(const Service& service, std::span<const std::byte> request) {
  Writer answer;
  std::string refusal;
  begin_limits(base);
  try {
    Reader reader(request);
    service.serve(reader, answer);
  } catch (const std::bad_alloc&) {
    out_of_memory();
  } catch (const std::exception& e) {
    refusal = e.what();
    if (refusal.empty()) refusal = "a file cannot be read, and its reader gives no reason";
  }
  end_limits();
  if (refusal.empty())
    send_frame(Frame::answer, answer.bytes().data(), answer.bytes().size());
  else
    send_frame(Frame::refusal, refusal.data(), refusal.size());
}

/// Loads a module. Returns false if there is none of that name beside the program.
bool load_module(const std::string& word) {
  std::error_code code;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", code);
  const auto file = program.parent_path() / ("muro_parser_" + word + ".so");
  if (code || !std::filesystem::is_regular_file(file, code)) return false;
  if (dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) return true;
  std::fprintf(stderr, "%s\n", dlerror());
  _exit(1);
}

/// Answers one request.
void serve_next() {
  RequestHeader header{};
  as_child::receive(&header, sizeof header);
  std::string name(header.service_size, '\0');
  as_child::receive(name.data(), name.size());
  std::vector<std::byte> request(header.size);
  as_child::receive(request.data(), request.size());
  const auto known = [&name] {
    return std::find_if(services().begin(), services().end(), [&](const Service& s) { return s.name == name; });
  };
  auto service = known();
  if (service == services().end() && load_module(name.substr(0, name.find(' ')))) service = known();
  if (service == services().end()) return send_frame(Frame::no_service, nullptr, 0);
  serve(*service, request);
}

long resident_bytes() {
  long size = 0, resident = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &size, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return resident * sysconf(_SC_PAGESIZE);
}

}  // namespace

}  // namespace muro::parser_process

int main() {
  using namespace muro::parser_process;
  using namespace muro;
  if (!as_child::begin()) {
    std::fputs("muro_parser reads meshes, pictures and models for muro, which starts it; it has no other use\n",
               stderr);
    return 2;
  }
  const rlimit largest_file{rlim_t(1) << 29, rlim_t(1) << 29};  // for what it prints, and for models in memory
  setrlimit(RLIMIT_FSIZE, &largest_file);
  signal(SIGXFSZ, SIG_IGN);
  std::set_new_handler(&out_of_memory);
  as_child::end_with_parent();  // if there is no thread, the process ends with its request
  const Hello hello = Hello::ours();
  as_child::send(&hello, sizeof hello);
  const long at_start = resident_bytes();
  while (true) {
    pollfd client{child_socket, POLLIN, 0};
    const int ready = poll(&client, 1, idle_milliseconds);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) _exit(0);
    serve_next();
    if (resident_bytes() < at_start + large_remainder) continue;
    malloc_trim(0);
    if (resident_bytes() > at_start + largest_remainder) _exit(0);
  }
}
