#pragma once

#include <cmath>

namespace perimorph::model {

/// The part of the load that an increment takes, in increments of the case. Sizes are 1 and halves of halves of it, so
/// that ends come to whole increments again, at which stages of the load end.
struct LoadStep {
  double begin = 0., size = 1.;

  double end() const { return begin + size; }

  bool is_smallest() const { return size <= 1. / 256.; }

  LoadStep halved() const { return {begin, 0.5 * size}; }

  /// The one that follows, of twice the size if it may grow and begins at a multiple of that.
  LoadStep next(bool may_grow) const {
    const bool grows = may_grow && size < 1. && std::fmod(end(), 2. * size) == 0.;
    return {end(), grows ? 2. * size : size};
  }
};

}  // namespace perimorph::model
