// SPDX-License-Identifier: MIT
#include "host/outputs/timeline.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/outputs/json_text.hpp"
#include "host/outputs/output_file.hpp"

namespace muro::host {

void write_timeline(const std::string& path, const Simulation& simulation) {
  const Executor& executor = simulation.scheduler().executor();
  const auto& threads = executor.timeline().threads();
  const double us = 1e6 * executor.seconds_per_tick();
  std::uint64_t first = ~std::uint64_t(0);
  for (const auto& spans : threads)
    if (!spans.empty()) first = std::min(first, spans.front().begin);
  std::string out = "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[";
  std::string comma;
  for (std::size_t thread = 0; thread < threads.size(); ++thread) {
    out += fmt::format(R"({}{{"name":"thread_name","ph":"M","pid":1,"tid":{},"args":{{"name":"thread {}"}}}})", comma,
                       thread, thread);
    comma = ",\n";
    for (const Timeline::Span& s : threads[thread]) {
      const Task& task = simulation.scheduler().tasks()[s.task];
      const std::string name = json_text(task.name, -1);  // with quotes
      out += fmt::format(R"({}{{"name":{},"ph":"X","pid":1,"tid":{},"ts":{:.3f},"dur":{:.3f},)"
                         R"("args":{{"simulated_s":{:.9f},"phase":{},"first":{},"end":{}}}}})",
                         comma, name, thread, us * double(s.begin - first), us * double(s.end - s.begin),
                         1e-9 * double(s.time), s.phase, s.range.begin, s.range.end);
    }
  }
  write_file(path, out + "]}\n");
}

}  // namespace muro::host
