#include "perimorph/bonds/bond_families.hpp"

#include <algorithm>
#include <cmath>

#include "perimorph/materials/decay.hpp"

namespace perimorph::bonds {

using base::Point;

template <int dim>
BondFamilies<dim>::BondFamilies(const mesh::Mesh<dim>& mesh, const elements::MaterialPoints<dim>& points,
                                std::vector<char> active, const materials::BondMaterials& materials,
                                const std::vector<mesh::CrackFacet<dim>>& pre_cracks, StiffnessStorage kept)
    : mesh_(mesh),
      points_(points),
      active_(std::move(active)),
      materials_(materials),
      kept_(kept),
      softens_(materials.softens()),
      visibility_(mesh, pre_cracks),
      balls_(mesh),
      searched_(mesh.n_elements(), 0),
      pairs_of_(mesh.n_elements()),
      family_volume_(points.size(), 0.),
      lost_volume_(points.size(), 0.),
      damaged_(mesh.n_elements(), 0) {
  check_arguments();
}

template <int dim>
void BondFamilies<dim>::check_arguments() const {
  PERIMORPH_ASSERT(static_cast<int>(active_.size()) == mesh_.n_elements(), "{} marks for {} elements", active_.size(),
                   mesh_.n_elements());
  PERIMORPH_ASSERT(points_.first(mesh_.n_elements()) == points_.size(), "{} points, {} of them in {} elements",
                   points_.size(), points_.first(mesh_.n_elements()), mesh_.n_elements());
}

template <int dim>
void BondFamilies<dim>::extend(const std::vector<int>& elements) {
  for (const int e : elements) {
    PERIMORPH_ASSERT(mesh_.has_element(e), "element {} of {}", e, mesh_.n_elements());
    if (searched_[e]) continue;
    searched_[e] = 1;
    const auto obstacles = visibility_.near(balls_.center(e), balls_.reach(e, materials_.horizon()));
    for (const int f : balls_.in_reach(e, materials_.horizon())) {
      const bool already_paired = searched_[f] && f != e;
      if (already_paired || !(active_[e] || active_[f])) continue;
      const bool in_order = mesh_.element_ids[e] <= mesh_.element_ids[f];
      add_pair(in_order ? e : f, in_order ? f : e, obstacles);
    }
  }
  ends_.shrink_to_fit();  // growing vectors hold up to twice of what is in them
  stiffness_.shrink_to_fit();
}

template <int dim>
void BondFamilies<dim>::add_pair(int a, int b, const std::vector<typename Visibility<dim>::Facet>& obstacles) {
  PERIMORPH_DEBUG_ASSERT(mesh_.element_ids[a] <= mesh_.element_ids[b], "element {} stands before {}",
                         mesh_.element_ids[a], mesh_.element_ids[b]);
  const int first_a = points_.first(a), first_b = points_.first(b);
  std::vector<Point<dim>> ends;
  for (int q = 0; q < points_.count(a); ++q) ends.push_back(points_.position(first_a + q));
  for (int q = 0; q < points_.count(b); ++q) ends.push_back(points_.position(first_b + q));
  // A bond inside one element is inside the body: elements are convex.
  const auto between =
      a == b ? std::vector<typename Visibility<dim>::Facet>() : Visibility<dim>::among(obstacles, ends);
  for (int qa = 0; qa < points_.count(a); ++qa) {
    for (int qb = a == b ? qa + 1 : 0; qb < points_.count(b); ++qb) {
      const int i = first_a + qa, j = first_b + qb;
      const double c0 = materials_.stiffness(a, b, (points_.position(j) - points_.position(i)).norm());
      if (c0 == 0.) continue;
      if (Visibility<dim>::blocks(between, points_.position(i), points_.position(j))) continue;
      ends_.push_back(static_cast<std::uint16_t>(qa * elements::max_points + qb));
      if (!computes_stiffness()) {
        stiffness_.push_back(static_cast<float>(c0 * points_.weight(i) * points_.weight(j)));
      }
      if (softens_) softening_.emplace_back();
      family_volume_[i] += points_.weight(j);
      family_volume_[j] += points_.weight(i);
    }
  }
  if (n_bonds() == first_bond_.back()) return;
  pairs_of_[a].push_back(n_pairs());
  if (b != a) pairs_of_[b].push_back(n_pairs());
  pairs_.push_back({a, b});
  first_bond_.push_back(n_bonds());
}

template <int dim>
double BondFamilies<dim>::stiffness_on_the_fly(const Bond<dim>& bond) const {
  const materials::EightValues squared = materials::EightValues::Constant(bond.xi.squaredNorm());
  const auto c0 = [&](const materials::Micromodulus& of) {
    return of.tau0 * materials::decay(squared, of.characteristic_length)[0];
  };
  return materials_.mean_of(bond.first_element, bond.second_element, c0) * points_.weight(bond.first_point) *
         points_.weight(bond.second_point);
}

template <int dim>
int BondFamilies<dim>::pair_of(BondId b) const {
  PERIMORPH_ASSERT(b < n_bonds(), "bond {} of {}", b, n_bonds());
  return static_cast<int>(std::upper_bound(first_bond_.begin(), first_bond_.end(), b) - first_bond_.begin()) - 1;
}

template <int dim>
std::size_t BondFamilies<dim>::bytes() const {
  const auto size = [](const auto& vector) { return vector.capacity() * sizeof(vector[0]); };
  std::size_t sum = size(ends_) + size(stiffness_) + size(softening_) + size(pairs_) + size(first_bond_) +
                    size(pairs_of_) + size(family_volume_) + size(lost_volume_);
  for (const auto& pairs : pairs_of_) sum += size(pairs);
  return sum;
}

template <int dim>
BondId BondFamilies<dim>::find(int first, int first_end, int second, int second_end) const {
  PERIMORPH_ASSERT(mesh_.has_element(first) && mesh_.has_element(second), "elements {} and {} of {}", first, second,
                   mesh_.n_elements());
  for (const int p : pairs_of_[first]) {
    if (pairs_[p].first != first || pairs_[p].second != second) continue;
    for (BondId b = first_bond_[p]; b < first_bond_[p + 1]; ++b) {
      if (this->first_end(b) == first_end && this->second_end(b) == second_end) return b;
    }
  }
  return n_bonds();
}

template <int dim>
void BondFamilies<dim>::take(const BondChange& change) {
  for (const BondId b : change.broken) {
    const Bond<dim> bond = this->bond(b);
    PERIMORPH_ASSERT(!bond.is_broken, "bond {} breaks again", b);
    PERIMORPH_ASSERT(bond.first_element != bond.second_element, "bond {} within element {} breaks", b,
                     bond.first_element);
    ends_[b] = static_cast<std::uint16_t>(ends_[b] | broken_bit);
    damaged_[bond.first_element] = damaged_[bond.second_element] = 1;
    lose(bond, share_left(bond));
  }
  for (const auto& [b, largest_stretch, loss] : change.softened) {
    const Bond<dim> bond = this->bond(b);
    PERIMORPH_ASSERT(softens_ && !bond.is_broken, "bond {} softens", b);
    softening_[b].largest = largest_stretch;
    lose(bond, loss);
  }
}

template <int dim>
void BondFamilies<dim>::accept_softening() {
  if (!softens_) return;
  for_each_bond([&](const Bond<dim>& bond) {
    const auto& law = materials_.law(bond.first_element, bond.second_element);
    auto& [accepted, largest] = softening_[bond.id];
    if (bond.is_broken) largest = static_cast<float>(law.critical_stretch());
    accepted = largest;
  });
}

template <int dim>
void BondFamilies<dim>::restore_softening(const SofteningHistories& histories) {
  accept_softening();
  for (const auto& [b, history] : histories) softening_[b] = history;
}

template <int dim>
void BondFamilies<dim>::note_softening() {
  if (!softens_) return;
  for_each_bond([&](const Bond<dim>& bond) {
    if (softening_[bond.id].largest > 0.F) damaged_[bond.first_element] = damaged_[bond.second_element] = 1;
  });
}

template <int dim>
void BondFamilies<dim>::lose(const Bond<dim>& bond, double share) {
  lost_volume_[bond.first_point] += share * points_.weight(bond.second_point);
  lost_volume_[bond.second_point] += share * points_.weight(bond.first_point);
}

template <int dim>
void BondFamilies<dim>::recount_damage() {
  std::fill(lost_volume_.begin(), lost_volume_.end(), 0.);
  for_each_bond([&](const Bond<dim>& bond) { lose(bond, bond.is_broken ? 1. : 1. - share_left(bond)); });
}

template <int dim>
typename BondFamilies<dim>::Extremes BondFamilies<dim>::neighbourhood_extremes(
    const morphing::MorphingField<dim>& alpha) const {
  Extremes extremes;
  for (int i = 0; i < points_.size(); ++i) extremes.smallest.push_back(alpha(i));
  extremes.largest = extremes.smallest;
  const auto include = [&](int i, double value) {
    extremes.smallest[i] = std::min(extremes.smallest[i], value);
    extremes.largest[i] = std::max(extremes.largest[i], value);
  };
  for_each_bond([&](const Bond<dim>& bond) {
    include(bond.first_point, alpha(bond.second_point));
    include(bond.second_point, alpha(bond.first_point));
  });
  return extremes;
}

/// visit(bond, s, its law) where the stretch s reaches threshold(its law); s is beyond the eigenstrain
template <int dim>
template <class Threshold, class Visit>
void BondFamilies<dim>::for_each_stretched(const std::vector<Point<dim>>& displacements,
                                           const std::vector<morphing::ElementClass>& classes,
                                           const std::vector<double>& eigenstrain, Threshold threshold,
                                           Visit visit) const {
  PERIMORPH_ASSERT(static_cast<int>(displacements.size()) == points_.size(), "{} displacements of {} points",
                   displacements.size(), points_.size());
  PERIMORPH_ASSERT(eigenstrain.empty() || eigenstrain.size() == displacements.size(), "eigenstrain at {} of {} points",
                   eigenstrain.size(), displacements.size());
  PERIMORPH_ASSERT(static_cast<int>(classes.size()) == mesh_.n_elements(), "{} classes of {} elements", classes.size(),
                   mesh_.n_elements());
  for (int p = 0; p < n_pairs(); ++p) {
    const auto [first, second] = pairs_[p];
    if (first == second || classes[first] != morphing::ElementClass::pd ||
        classes[second] != morphing::ElementClass::pd) {
      continue;
    }
    // s = |xi + eta| / |xi| - 1 >= s_crit, without the roots   [WHL19, eq. 6, 7]
    const materials::BondLaw& law = materials_.law(first, second);
    const double limit = 1. + threshold(law);
    for_each_bond(p, [&](const Bond<dim>& bond) {
      if (bond.is_broken) return;
      const Point<dim> eta = displacements[bond.second_point] - displacements[bond.first_point];
      PERIMORPH_DEBUG_ASSERT(eta.allFinite(), "a point of bond {} is displaced to nowhere", bond.id);
      const double free = bond.mean_of(eigenstrain);
      const double least = limit + free;
      if ((bond.xi + eta).squaredNorm() < least * least * bond.xi.squaredNorm()) return;
      visit(bond, std::sqrt((bond.xi + eta).squaredNorm() / bond.xi.squaredNorm()) - 1. - free, law);
    });
  }
}

template <int dim>
void BondFamilies<dim>::check_dilatation(const std::vector<double>& dilatation) const {
  PERIMORPH_ASSERT(!materials_.sees_compression() || static_cast<int>(dilatation.size()) == points_.size(),
                   "the dilatation of {} of {} points", dilatation.size(), points_.size());
}

template <int dim>
std::vector<double> BondFamilies<dim>::overstretches(const std::vector<Point<dim>>& displacements,
                                                     const std::vector<morphing::ElementClass>& classes, double ratio,
                                                     const PointStrains& strains) const {
  PERIMORPH_ASSERT(ratio >= 0., "{} times a limit", ratio);
  check_dilatation(strains.dilatation);
  std::vector<double> ratios;
  for_each_stretched(
      displacements, classes, strains.eigenstrain, [&](const materials::BondLaw& law) { return ratio * law.limit(); },
      [&](const Bond<dim>& bond, double stretch, const materials::BondLaw& law) {
        if (!counts_here(bond)) return;
        const double counted = law.counted_stretch(stretch, bond.mean_of(strains.dilatation));
        if (law.sees_compression() && counted < ratio * law.limit()) return;
        ratios.push_back(counted / law.limit());
      });
  return ratios;
}

template <int dim>
std::vector<BondId> BondFamilies<dim>::overstretched(const std::vector<Point<dim>>& displacements,
                                                     const std::vector<morphing::ElementClass>& classes, double ratio,
                                                     const PointStrains& strains) const {
  PERIMORPH_ASSERT(ratio >= 0., "{} times a critical stretch", ratio);
  check_dilatation(strains.dilatation);
  std::vector<BondId> found;
  for_each_stretched(
      displacements, classes, strains.eigenstrain,
      [&](const materials::BondLaw& law) { return ratio * law.critical_stretch(); },
      [&](const Bond<dim>& bond, double stretch, const materials::BondLaw& law) {
        const bool is_cut_short =
            law.sees_compression() &&
            law.counted_stretch(stretch, bond.mean_of(strains.dilatation)) < ratio * law.critical_stretch();
        if (!is_cut_short) found.push_back(bond.id);
      });
  return found;
}

template <int dim>
std::vector<SoftenedBond> BondFamilies<dim>::softened(const std::vector<Point<dim>>& displacements,
                                                      const std::vector<morphing::ElementClass>& classes,
                                                      bool may_recover, const std::vector<double>& eigenstrain) const {
  constexpr float further = 1.5F, almost = 0.999F;
  std::vector<SoftenedBond> found;
  if (!softens_) return found;
  for_each_stretched(
      displacements, classes, eigenstrain,
      [](const materials::BondLaw& law) { return law.softens() ? -1. : law.limit(); },
      [&](const Bond<dim>& bond, double stretch_now, const materials::BondLaw& law) {
        const auto [accepted, before] = softening_[bond.id];
        const auto limit = static_cast<float>(law.limit()), critical = static_cast<float>(law.critical_stretch());
        const auto now = static_cast<float>(stretch_now);
        if (now >= critical) return;
        float stretch = std::max(now > limit ? now : 0.F, may_recover ? accepted : before);
        if (stretch > before && may_recover) {
          const float from = std::max(before, limit);
          stretch = std::min(from + further * (stretch - from), almost * critical);
        } else if (stretch < before) {
          const float half_way = 0.5F * (stretch + before);
          if (half_way > limit) stretch = half_way;
        }
        if (stretch == before) return;
        found.push_back({bond.id, stretch, share_left(bond) - law.share_left(stretch)});
      });
  return found;
}

template class BondFamilies<2>;
template class BondFamilies<3>;

}  // namespace perimorph::bonds
