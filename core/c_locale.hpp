// SPDX-License-Identifier: MIT
#pragma once

#include <clocale>

namespace muro {

/// While it lives, C functions of this thread use the locale "C": numbers are read and written with a decimal point,
/// whatever an embedding program has chosen by setlocale(). Plugins, their libraries and control code run within one.
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
