// SPDX-License-Identifier: MIT
#include "host/process/out_of_memory.hpp"

#include <unistd.h>

#include <exception>
#include <new>

#include "core/running_call.hpp"
#include "host/process/exit_guard.hpp"

namespace muro::host {

namespace {

std::terminate_handler previous = nullptr;

bool lacks_memory() {
  const std::exception_ptr thrown = std::current_exception();
  if (!thrown) return false;
  try {
    std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

void end() {
  if (lacks_memory()) {
    SignalText line;
    const RunningCall& call = running_call();
    if (call.callee.load()) {
      add_who(line, call);
      line.add(" has no memory");
      add_where(line, call);
      line.add(": ");
    }
    line.add(lack_of_memory);
    line.add("; files that were being written end in .part\n");
    line.write_to(STDERR_FILENO);
    ExitGuard::leave(2);
  }
  previous();
}

}  // namespace

void report_lack_of_memory() { previous = std::set_terminate(end); }

}  // namespace muro::host
