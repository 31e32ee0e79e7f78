// SPDX-License-Identifier: MIT
// Algorithms and readers as the host calls them: what they throw becomes a text.
#pragma once

#include "muro/detail/abi.hpp"

namespace muro::abi::detail {

/// Runs `work`; what it throws becomes a text.
template <class Work>
bool guarded(ErrorText& error, Work&& work) noexcept {
  try {
    work();
    return true;
  } catch (const std::exception& e) {
    error.set(e.what());
  } catch (...) {
    error.set("an exception that is no std::exception");
  }
  return false;
}

template <class T>
class AlgorithmOf final : public AlgorithmInstance {
 public:
  bool connect(Connector& c, ErrorText& e) noexcept override {
    return guarded(e, [&] { algorithm_.connect(c); });
  }
  bool connect_by_name(Connector& c, ErrorText& e) noexcept override {
    return guarded(e, [&] { algorithm_.connect_by_name(c); });
  }
  bool start(ErrorText& e) noexcept override {
    return guarded(e, [&] { algorithm_.start(); });
  }
  Rows<Phase> phases() const noexcept override { return algorithm_.phases(); }
  void* find_extension(const ExtensionId& id) noexcept override {
    ErrorText error;
    void* found = nullptr;
    guarded(error, [&] { found = algorithm_.find_extension(id); });
    return found;
  }
  bool step(const Step& s, Range r, ErrorText& e) noexcept override {
    return guarded(e, [&] { algorithm_.step(s, r); });
  }
  bool restored(ErrorText& e) noexcept override {
    return guarded(e, [&] { algorithm_.restored(); });
  }
  bool finish(ErrorText& e) noexcept override {
    return guarded(e, [&] { algorithm_.finish(); });
  }
  void destroy() noexcept override { delete this; }
  bool on_handover(std::uint32_t item, ErrorText& e) noexcept override {
    return guarded(e, [&] { algorithm_.on_handover(item); });
  }

 private:
  ~AlgorithmOf() = default;
  T algorithm_;
};

template <class T>
class ReaderOf final : public ReaderInstance {
 public:
  bool read(std::string_view path, RobotBuilder& b, ErrorText& e) noexcept override {
    return guarded(e, [&] { reader_.read(path, b); });
  }
  void destroy() noexcept override { delete this; }
  bool read_world(std::string_view path, WorldBuilder& w, ErrorText& e) noexcept override {
    return guarded(e, [&] { reader_.read_world(path, w); });
  }

 private:
  ~ReaderOf() = default;
  T reader_;
};

/// An instance, or null with a text.
template <class Interface, class Of>
Interface* make(ErrorText* error) noexcept {
  Interface* made = nullptr;
  guarded(*error, [&] { made = new Of; });
  return made;
}

}  // namespace muro::abi::detail
