// SPDX-License-Identifier: MIT
// Chooses the fastest build of a kernel for this processor. The choice never changes a result: a lane performs the same
// operations as a plain double.
#pragma once

#include <cstdlib>
#include <string_view>

namespace muro::lane {

/// Instruction sets for which muro_add_kernels() builds. base: the set that every processor of the architecture has.
enum class Isa { base, avx2, avx512 };

/// Returns the best set of this processor, or a lesser one that the environment variable MURO_ISA names (base, avx2).
inline Isa best_isa() {
#if defined(__x86_64__)
  const char* wish = std::getenv("MURO_ISA");
  const std::string_view most = wish ? wish : "";
  if (most == "base") return Isa::base;
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  if (avx512 && most != "avx2") return Isa::avx512;
  if (__builtin_cpu_supports("avx2")) return Isa::avx2;
#endif
  return Isa::base;
}

}  // namespace muro::lane

/// Declares, in a namespace, the constant `name` of type `Type`, which a kernel source defines once for each
/// instruction set, and `name_for(isa)`, which chooses one of them.
#if defined(__x86_64__)
#define MURO_DECLARE_KERNELS(Type, name)                                                                               \
  namespace base {                                                                                                     \
  extern const Type name;                                                                                              \
  }                                                                                                                    \
  namespace avx2 {                                                                                                     \
  extern const Type name;                                                                                              \
  }                                                                                                                    \
  namespace avx512 {                                                                                                   \
  extern const Type name;                                                                                              \
  }                                                                                                                    \
  inline const Type& name##_for(::muro::lane::Isa isa) {                                                               \
    return isa == ::muro::lane::Isa::avx512 ? avx512::name : isa == ::muro::lane::Isa::avx2 ? avx2::name : base::name; \
  }
#else
#define MURO_DECLARE_KERNELS(Type, name) \
  namespace base {                       \
  extern const Type name;                \
  }                                      \
  inline const Type& name##_for(::muro::lane::Isa) { return base::name; }
#endif
