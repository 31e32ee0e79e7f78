// SPDX-License-Identifier: MIT
// The stamp of the compiler, libraries and layout that this source is compiled with.
#pragma once

#include "muro/detail/abi.hpp"
#include "muro/key.hpp"
#include "muro/robot.hpp"

#ifdef __FAST_MATH__
#error "muro plugins are not built with -ffast-math: it changes the arithmetic of the whole process when loaded"
#endif
#ifdef __clang__
#define MURO_COMPILER "clang " __clang_version__
#else
#define MURO_COMPILER "gcc " __VERSION__
#endif
#ifndef EIGEN_MALLOC_ALREADY_ALIGNED
#error \
    "link the muro::sdk target (or use muro_add_plugin): it sets EIGEN_MALLOC_ALREADY_ALIGNED and EIGEN_MAX_ALIGN_BYTES"
#endif

namespace muro::abi {

/// Values whose layout both sides must agree on before the host reads a table.
struct Probe {
  char a;
  Pose pose;
  Inertia inertia;
  JointLimits limits;
  std::string_view text;
  KeyInfo key;
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
/// A hash of the places of members of these values; that of all structs is layout_of_contract().
constexpr std::uint32_t layout_of_values() {
  constexpr std::size_t places[] = {
      sizeof(Pose),           offsetof(Pose, orientation), sizeof(Inertia),
      offsetof(Inertia, ixy), sizeof(JointLimits),         offsetof(JointLimits, armature),
      sizeof(KeyInfo),        offsetof(KeyInfo, type),     offsetof(KeyInfo, doc)};
  std::uint32_t hash = 2166136261u;  // FNV-1a
  for (const std::size_t place : places) hash = (hash ^ std::uint32_t(place)) * 16777619u;
  return hash;
}
#pragma GCC diagnostic pop

/// The stamp of the source that is being compiled.
constexpr Stamp make_stamp() {
  Stamp s{};
  std::copy_n("MUROPLUG", 8, s.magic);
  s.stamp_size = sizeof(Stamp);
  s.sdk_major = sdk_major;
  s.sdk_minor = sdk_minor;
  s.pointer_size = sizeof(void*);
#ifdef _LIBCPP_VERSION
  std::copy_n("libc++", 6, s.standard_library);
  s.standard_library_abi = _LIBCPP_ABI_VERSION;
#else
  std::copy_n("libstdc++", 9, s.standard_library);
  s.standard_library_abi = _GLIBCXX_USE_CXX11_ABI;
#ifdef _GLIBCXX_DEBUG
  s.standard_library_debug = 1;
#endif
#endif
  s.eigen_version = EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION;
  s.eigen_max_align_bytes = EIGEN_MAX_ALIGN_BYTES;
  s.eigen_malloc_already_aligned = EIGEN_MALLOC_ALREADY_ALIGNED;
  s.probe_size = sizeof(Probe);
  s.probe_align = alignof(Probe);
  s.probe_layout = layout_of_values();
  constexpr std::string_view compiler = MURO_COMPILER;
  std::copy_n(compiler.data(), std::min(compiler.size(), sizeof s.compiler - 1), s.compiler);
  return s;
}

}  // namespace muro::abi
