// SPDX-License-Identifier: MIT
#include "core/extensions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/running_call.hpp"

namespace muro {

void UsedLibraries::add(const LoadedLibrary& library) noexcept {
  UsedLibrary told{std::string(library.path), std::string(library.name), std::string(library.version)};
  if (std::find(all_.begin(), all_.end(), told) == all_.end()) all_.push_back(std::move(told));
}

CallNote& NotesOfThreads::of_this_thread() noexcept { return running_call().note; }

Extensions::Extensions(const World& world, const Scheduler& scheduler)
    : inspector_(world, scheduler), inputs_(world, scheduler), requests_(inputs_, world) {
  lockstep_.is_stopping = [this] { return inspector_.is_stopping(); };
  lockstep_.is_replayed = [this] { return inputs_.has_recording(); };
}

void* Extensions::find(const ExtensionId& id, std::string& why_not) {
  struct Offer {
    ExtensionId id;
    void* interface;
  };
  const Offer offers[] = {{Inspection::id(), static_cast<Inspection*>(&inspector_)},
                          {LoadedLibraries::id(), static_cast<LoadedLibraries*>(&libraries_)},
                          {CallNotes::id(), static_cast<CallNotes*>(&notes_)},
                          {Outputs::id(), static_cast<Outputs*>(&outputs_)},
                          {ExternalInputs::id(), static_cast<ExternalInputs*>(&inputs_)},
                          {RunControl::id(), static_cast<RunControl*>(&requests_)},
                          {Lockstep::id(), static_cast<Lockstep*>(&lockstep_)},
                          {ReportEntries::id(), static_cast<ReportEntries*>(&reported_numbers_)}};
  for (const Offer& offer : offers) {
    if (offer.id.name != id.name) continue;
    if (offer.id.version == id.version && offer.id.layout == id.layout) {
      if (offer.id.name == RunControl::id().name) requests_.want();
      return offer.interface;
    }
    why_not =
        offer.id.version == id.version
            ? fmt::format("the plugin has version {} of extension {} with another layout ({:08x} instead of {:08x})",
                          id.version, id.name, id.layout, offer.id.layout)
            : fmt::format("the plugin asks for version {} of extension {}, and this muro has version {}", id.version,
                          id.name, offer.id.version);
    why_not += "; build it again with the SDK of this muro";
  }
  return nullptr;
}

}  // namespace muro
