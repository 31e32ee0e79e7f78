// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/external/input_log.hpp"
#include "core/external/lockstep_clients.hpp"
#include "core/external/reported_numbers.hpp"
#include "core/external/run_requests.hpp"
#include "core/inspector.hpp"
#include "core/output_registry.hpp"
#include "core/used_library.hpp"
#include "muro/ext/call_note.hpp"
#include "muro/ext/loaded_libraries.hpp"

namespace muro {

/// Collects the libraries that algorithms have loaded.
class UsedLibraries final : public LoadedLibraries {
 public:
  void add(const LoadedLibrary& library) noexcept override;
  const std::vector<UsedLibrary>& all() const { return all_; }

 private:
  std::vector<UsedLibrary> all_;
};

/// Returns the note of the calling thread, in its RunningCall.
class NotesOfThreads final : public CallNotes {
 public:
  CallNote& of_this_thread() noexcept override;
};

/// The extensions that a simulation offers to its algorithms, see Host::find_extension.
class Extensions {
 public:
  Extensions(const World& world, const Scheduler& scheduler);

  /// Returns the interface of exactly this version and layout, or null. When only another version or layout is there,
  /// `why_not` says so.
  void* find(const ExtensionId& id, std::string& why_not);

  Inspector& inspector() { return inspector_; }
  const Inspector& inspector() const { return inspector_; }
  const std::vector<UsedLibrary>& libraries() const { return libraries_.all(); }
  OutputRegistry& outputs() { return outputs_; }
  InputLog& inputs() { return inputs_; }
  RunRequests& requests() { return requests_; }
  LockstepClients& lockstep() { return lockstep_; }
  const ReportedNumbers& reported_numbers() const { return reported_numbers_; }

 private:
  Inspector inspector_;
  UsedLibraries libraries_;
  NotesOfThreads notes_;
  OutputRegistry outputs_;
  InputLog inputs_;
  RunRequests requests_;
  LockstepClients lockstep_;
  ReportedNumbers reported_numbers_;
};

}  // namespace muro
