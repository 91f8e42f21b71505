#pragma once

#ifdef __AVX512VL__
#include <immintrin.h>
#endif

#include <Eigen/Core>

namespace perimorph::operators {

/// Four numbers that are worked on at once, one per element or per point.
inline constexpr int n_lanes = 4;
using Lanes = Eigen::Array<double, n_lanes, 1>;

/// Spreads packed values to the lanes whose bit is set in the mask; zero elsewhere.
inline Lanes expand(unsigned mask, const float* packed) {
  Lanes lanes;
#ifdef __AVX512VL__
  _mm256_store_pd(lanes.data(), _mm256_cvtps_pd(_mm_maskz_expandloadu_ps(static_cast<__mmask8>(mask), packed)));
#else
  for (int lane = 0; lane < n_lanes; ++lane) lanes[lane] = (mask >> lane & 1u) != 0 ? *packed++ : 0.;
#endif
  return lanes;
}

}  // namespace perimorph::operators
