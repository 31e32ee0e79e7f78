// SPDX-License-Identifier: MIT
#pragma once

#include <clocale>

namespace muro {

/// While an object of this class lives, C functions of its thread use the locale "C", with a decimal point in numbers,
/// whatever an embedding program chose with setlocale(). Plugins, libraries and control code run in its lifetime.
class CLocale {
 public:
  CLocale() : before_(uselocale(c())) {}
  ~CLocale() { uselocale(before_); }
  CLocale(const CLocale&) = delete;
  CLocale& operator=(const CLocale&) = delete;

 private:
  static locale_t c() {
    static const locale_t locale = newlocale(LC_ALL_MASK, "C", nullptr);
    return locale;
  }
  locale_t before_;
};

}  // namespace muro
