#pragma once

#ifdef __AVX512VL__
#include <immintrin.h>
#endif

#include <Eigen/Core>

namespace perimorph::operators {

/// Four numbers that are worked on at once, one per element or per point.
inline constexpr int n_lanes = 4;
using Lanes = Eigen::Array<double, n_lanes, 1>;
/// Two times four numbers.
using RowPair = Eigen::Array<double, 2 * n_lanes, 1>;

/// Spreads packed values to the lanes whose bit is set in the mask; zero elsewhere.
inline RowPair expand(unsigned mask, const float* packed) {
  RowPair lanes;
#ifdef __AVX512VL__
  _mm512_store_pd(lanes.data(), _mm512_cvtps_pd(_mm256_maskz_expandloadu_ps(static_cast<__mmask8>(mask), packed)));
#else
  for (int lane = 0; lane < 2 * n_lanes; ++lane) lanes[lane] = (mask >> lane & 1u) != 0 ? *packed++ : 0.;
#endif
  return lanes;
}

/// The lanes whose bit is set in the mask; zero elsewhere.
inline RowPair keep(unsigned mask, const RowPair& lanes) {
  RowPair kept;
#ifdef __AVX512VL__
  _mm512_store_pd(kept.data(), _mm512_maskz_load_pd(static_cast<__mmask8>(mask), lanes.data()));
#else
  for (int lane = 0; lane < 2 * n_lanes; ++lane) kept[lane] = (mask >> lane & 1u) != 0 ? lanes[lane] : 0.;
#endif
  return kept;
}

/// The same four numbers in both halves. (Written as two halves it would wait for its own stores.)
inline RowPair twice(const double* four) {
  RowPair lanes;
#ifdef __AVX512VL__
  _mm512_store_pd(lanes.data(), _mm512_broadcast_f64x4(_mm256_loadu_pd(four)));
#else
  const Eigen::Map<const Lanes> half(four);
  lanes << half, half;
#endif
  return lanes;
}

}  // namespace perimorph::operators
