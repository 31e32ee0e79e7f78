// SPDX-License-Identifier: MIT
#include "library.hpp"

#include <iostream>
#include <sdf/sdf.hh>
#include <set>

#include "plugins/common/text/one_line.hpp"

namespace muro::sdf {

namespace {

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

/// Suppresses text that libsdformat and urdfdom write to standard error.
class Quiet {
 public:
  Quiet() : before_(std::cerr.rdbuf(nullptr)) {}
  ~Quiet() {
    std::cerr.rdbuf(before_);
    std::cerr.clear();
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  std::streambuf* before_;
};

::sdf::ConsolePtr console() {
  const Quiet quiet;  // the console complains if it cannot write its log
  return ::sdf::Console::Instance();
}

/// Returns a configuration that does not search for files: all paths are given.
::sdf::ParserConfig config() {
  ::sdf::ParserConfig config;
  config.SetFindCallback([](const std::string&) { return std::string(); });
  config.SetWarningsPolicy(::sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(::sdf::EnforcementPolicy::LOG);
  config.SetDeprecatedElementsPolicy(::sdf::EnforcementPolicy::LOG);
  return config;
}

/// Descriptions of all elements. They are made only once, as that takes longer than to read a model.
::sdf::SDFPtr empty_document() {
  static const ::sdf::SDFPtr descriptions = [] {
    auto made = std::make_shared<::sdf::SDF>();
    ::sdf::init(made);
    return made;
  }();
  auto document = std::make_shared<::sdf::SDF>();
  document->Root(descriptions->Root()->Clone());
  return document;
}

}  // namespace

Library::Library() : lock_(one_at_a_time()), messages_(console()->GetMsgStream().GetStream()) {
  console()->GetMsgStream().SetStream(nullptr);
}

Library::~Library() { console()->GetMsgStream().SetStream(messages_); }

std::vector<Library::Mistake> Library::load(const SourceFiles& sources, const std::string& text, ::sdf::Root& root) {
  ::sdf::Errors errors;
  std::string thrown;
  try {
    const Quiet quiet;
    const ::sdf::ParserConfig how = config();
    const ::sdf::SDFPtr document = empty_document();
    if (::sdf::readString(text, how, document, errors)) {
      const ::sdf::Errors more = root.Load(document, how);
      errors.insert(errors.end(), more.begin(), more.end());
    } else if (errors.empty()) {
      thrown = "it cannot read the file and gives no reason";
    }
  } catch (const ::sdf::Exception& e) {
    thrown = e.GetErrorStr();
  } catch (const std::exception& e) {
    thrown = e.what();
  }
  // One mistake causes many messages. Keeps the first message of each location. Messages without a location are kept
  // only if there are no others.
  std::vector<Mistake> mistakes;
  std::set<FileLocation> known;
  for (const bool placed : {true, false})
    for (const ::sdf::Error& e : errors) {
      // the reader checks inertia
      if (e.Code() == ::sdf::ErrorCode::NONE || e.Code() == ::sdf::ErrorCode::LINK_INERTIA_INVALID) continue;
      const FileLocation location = sources.location_of(e.FilePath().value_or(""), e.LineNumber().value_or(0));
      if ((location.line > 0) != placed || (!placed && !mistakes.empty()) || !known.insert(location).second) continue;
      mistakes.push_back({location, "libsdformat: " + sources.with_file_names(one_line(e.Message()))});
    }
  if (!thrown.empty() && mistakes.empty())
    mistakes.push_back({{}, "libsdformat: " + sources.with_file_names(one_line(thrown))});
  return mistakes;
}

FileLocation location_of(const SourceFiles& sources, ::sdf::ElementPtr element) {
  for (; element; element = element->GetParent())
    if (element->LineNumber().value_or(0) > 0) return sources.location_of(element->FilePath(), *element->LineNumber());
  return {};
}

}  // namespace muro::sdf
