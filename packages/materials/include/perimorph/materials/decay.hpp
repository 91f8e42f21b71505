#pragma once

#ifdef __AVX512VL__
#include <immintrin.h>
#endif

#include <Eigen/Core>

#include "perimorph/base/errors.hpp"

namespace perimorph::materials {

using EightValues = Eigen::Array<double, 8, 1>;

/// exp(-r/l) of eight squared distances r^2 at once, in single precision: errors are some 1e-7 of exp(0). All who
/// compute the stiffness of a bond on the fly call this, so that they have the same bits.
/// @param squared_distances r^2, (8), [length^2]
/// @param characteristic_length l > 0, [length]
inline EightValues decay(const EightValues& squared_distances, double characteristic_length) {
  PERIMORPH_DEBUG_ASSERT(characteristic_length > 0., "a characteristic length of {}", characteristic_length);
  PERIMORPH_DEBUG_ASSERT(squared_distances.minCoeff() >= 0., "a squared distance of {}", squared_distances.minCoeff());
#ifdef __AVX512VL__
  // 2^y = 2^n exp(f), n the nearest integer, |f| <= ln(2)/2, where eight terms of the series suffice.
  constexpr float reciprocal_factorials[] = {1.F / 720, 1.F / 120, 1.F / 24, 1.F / 6, 1.F / 2, 1.F, 1.F};
  constexpr __mmask8 all = 255;  // the forms without a mask warn of an undefined value (GCC 12)
  const auto rate = static_cast<float>(-1.4426950408889634 / characteristic_length);
  const __m256 distances = _mm256_sqrt_ps(_mm512_maskz_cvtpd_ps(all, _mm512_load_pd(squared_distances.data())));
  const __m256 y = _mm256_mul_ps(distances, _mm256_set1_ps(rate));
  const __m256 n = _mm256_roundscale_ps(y, _MM_FROUND_TO_NEAREST_INT);
  const __m256 f = _mm256_mul_ps(_mm256_sub_ps(y, n), _mm256_set1_ps(0.69314718F));
  __m256 series = _mm256_set1_ps(1.F / 5040);
  for (const float term : reciprocal_factorials) series = _mm256_fmadd_ps(series, f, _mm256_set1_ps(term));
  EightValues result;
  _mm512_store_pd(result.data(), _mm512_maskz_cvtps_pd(all, _mm256_scalef_ps(series, n)));
  return result;
#else
  const auto rate = static_cast<float>(-1. / characteristic_length);
  return (squared_distances.cast<float>().sqrt() * rate).exp().cast<double>();
#endif
}

}  // namespace perimorph::materials
