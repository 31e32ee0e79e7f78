// SPDX-License-Identifier: MIT
#include "lane_kernels.hpp"
#include "muro/simd/rows.hpp"
#include "muro/simd/trig.hpp"

namespace muro::lane_test {
namespace {

using namespace lane;

template <class S>
MURO_INLINE S chosen(MaskOf<S> m, S a, S b, unsigned& which) {
  which = bits(m);
  return select(m, a, b);
}

template <class S>
S result(Operation operation, S a, S b, unsigned& which) {
  using Value = typename Traits<S>::Value;
  S sum = a;
  switch (operation) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::negate:
      return -a;
    case Operation::add_to:
      return sum += b;
    case Operation::subtract_from:
      return sum -= b;
    case Operation::multiply_by:
      return sum *= b;
    case Operation::less:
      return chosen(a < b, a, b, which);
    case Operation::less_or_equal:
      return chosen(a <= b, a, b, which);
    case Operation::greater:
      return chosen(a > b, a, b, which);
    case Operation::greater_or_equal:
      return chosen(a >= b, a, b, which);
    case Operation::equal:
      return chosen(a == b, a, b, which);
    case Operation::both:
      return chosen((a > b) & (a > S(0)), a, b, which);
    case Operation::either:
      return chosen((a > b) | (b > S(0)), a, b, which);
    case Operation::neither:
      return chosen<S>(!((a > b) | (b > S(0))), a, b, which);
    case Operation::minimum:
      return min(a, b);
    case Operation::maximum:
      return max(a, b);
    case Operation::magnitude:
      return abs(a);
    case Operation::root:
      return lane::sqrt(a);
    case Operation::broadcast:
      return any(a < b) ? S(Value(-0.0)) : S(Value(1e-3));
  }
  return a;
}

template <class S>
void apply(Operation operation, const typename Traits<S>::Value* a, const typename Traits<S>::Value* b,
           typename Traits<S>::Value* out, unsigned* which) {
  *which = 0;
  for (int i = 0; i < values; i += count_of<S>) {
    S x, y;
    __builtin_memcpy(&x, a + i, sizeof x);
    __builtin_memcpy(&y, b + i, sizeof y);
    unsigned those = 0;
    const S r = result(operation, x, y, those);
    *which |= those << i;
    __builtin_memcpy(out + i, &r, sizeof r);
  }
}

void doubles(Operation operation, Width width, const double* a, const double* b, double* out, unsigned* which) {
  if (width == Width::one) return apply<double>(operation, a, b, out, which);
  if (width == Width::four) return apply<Double4>(operation, a, b, out, which);
  apply<Double8>(operation, a, b, out, which);
}
void floats(Operation operation, Width width, const float* a, const float* b, float* out, unsigned* which) {
  if (width == Width::one) return apply<float>(operation, a, b, out, which);
  if (width == Width::eight) return apply<Float8>(operation, a, b, out, which);
  apply<Float16>(operation, a, b, out, which);
}

void sine_and_cosine(Width width, const double* angles, double* sines, double* cosines) {
  if (width == Width::eight) {
    for (int i = 0; i < values; i += 8) {
      const SinCos<Double8> r = sincos(load_side_by_side<Double8>(angles + i));
      store_side_by_side(sines + i, r.sin);
      store_side_by_side(cosines + i, r.cos);
    }
  } else {
    for (int i = 0; i < values; ++i) {
      const SinCos<double> r = sincos(angles[i]);
      sines[i] = r.sin, cosines[i] = r.cos;
    }
  }
}

template <class S>
struct Copy {
  Places<S> from;
  Places<S, double> to;

  Copy(const double* const* source, double* const* target) {
    for (int i = 0; i < count_of<S>; ++i) from.at[i] = source[i], to.at[i] = target[i];
  }
};
template <class S, int n>
void copy_row(const Copy<S>& places, std::ptrdiff_t first, unsigned which) {
  S row[n];
  load_rows(places.from, first, row);
  store_rows(places.to, first, row, which);
}
template <class S>
void copy_rows_of(int n, const Copy<S>& places, std::ptrdiff_t first, unsigned which) {
  constexpr void (*by_count[])(const Copy<S>&, std::ptrdiff_t, unsigned) = {
      copy_row<S, 1>, copy_row<S, 2>, copy_row<S, 3>, copy_row<S, 4>,
      copy_row<S, 5>, copy_row<S, 6>, copy_row<S, 7>, copy_row<S, 8>};
  by_count[n - 1](places, first, which);
}
void copy_rows(Width width, int n, const double* const* from, double* const* to, std::ptrdiff_t first, unsigned which) {
  if (width == Width::four) return copy_rows_of<Double4>(n, {from, to}, first, which);
  copy_rows_of<Double8>(n, {from, to}, first, which);
}
void copy_properties(const double* const* from, double* const* to, unsigned which) {
  const Copy<Double8> places(from, to);
  store_vector(places.to, 0, load_vector(places.from), which);
  store_pose(places.to, 3, load_pose(places.from, 3), which);
  store_twist(places.to, 10, load_twist(places.from, 10), which);
}

}  // namespace

namespace MURO_ISA {
extern const Kernels kernels;
const Kernels kernels{&doubles, &floats, &sine_and_cosine, &copy_rows, &copy_properties};
}  // namespace MURO_ISA

}  // namespace muro::lane_test
