#include "perimorph/operators/bond_forces.hpp"

#include <Tpetra_Map.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bond_sums.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/materials/decay.hpp"

namespace perimorph::operators {

namespace {

constexpr unsigned bit(int i, int j) { return 1u << (i * n_lanes + j); }
int count_bits(unsigned mask) { return __builtin_popcount(mask); }

/// c of a bond as far as softening has left it, [force / length^3].
template <int dim>
double stiffness_left(const CoupledModel<dim>& model, const bonds::Bond<dim>& bond) {
  return model.bonds.stiffness(bond) * model.bonds.share_left(bond);
}

/// What a bond of a stiffness adds to M, c |xi|^4, [force length].
template <int dim>
double weight_of(const bonds::Bond<dim>& bond, double stiffness) {
  const double squared_length = bond.xi.squaredNorm();
  return stiffness * squared_length * squared_length;
}

/// c0 over the root of the product of both tau0.
RowPair mean_decay(const RowPair& squared_lengths, const materials::Micromodulus& one,
                   const materials::Micromodulus& other) {
  RowPair decay = materials::decay(squared_lengths, one.characteristic_length);
  if (&one == &other) return decay;
  const RowPair of_one = one.tau0 * decay;
  const RowPair of_other = other.tau0 * materials::decay(squared_lengths, other.characteristic_length);
  return materials::harmonic_mean(of_one, of_other) / std::sqrt(one.tau0 * other.tau0);
}

}  // namespace

template <int dim>
BondForces<dim>::BondForces(const CoupledModel<dim>& model, MeshPart part)
    : ElasticTerm<dim>(model), part_(std::move(part)), first_packet_(model.mesh.n_elements(), -1) {
  const auto pairs = this->pairs();
  make_packets(pairs);
  make_blocks(pairs);
  if (model.has_dilatation()) make_dilatation(pairs);
}

/// Of the part, ascending.
template <int dim>
std::vector<int> BondForces<dim>::pairs() const {
  const auto& bonds = model_.bonds;
  std::vector<int> pairs;
  if (part_.is_whole()) {
    pairs.resize(bonds.n_pairs());
    std::iota(pairs.begin(), pairs.end(), 0);
    return pairs;
  }
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (part_.holds_element(e)) pairs.insert(pairs.end(), bonds.pairs_of(e).begin(), bonds.pairs_of(e).end());
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The points of the elements that have bonds, in fours.
template <int dim>
void BondForces<dim>::make_packets(const std::vector<int>& pairs) {
  const auto& bonds = model_.bonds;
  std::vector<char> has_bonds(model_.mesh.n_elements(), 0);
  for (const int p : pairs) has_bonds[bonds.pair(p).first] = has_bonds[bonds.pair(p).second] = 1;
  for (int e = model_.mesh.n_real_elements(); e < model_.mesh.n_elements(); ++e) {
    if (has_bonds[e] != 0) has_bonds[model_.mesh.image(e).element] = 1;  // whose dilatation it has
  }
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (has_bonds[e] == 0) continue;
    first_packet_[e] = static_cast<int>(packets_.size());
    const double root_of_tau0 = std::sqrt(bonds.materials().micromodulus_of(e).tau0);
    for (int q = 0; q < model_.points.count(e); q += n_lanes) {
      packets_.push_back({e, shapes_of(model_.points.reference(e), q)});
      const int first = model_.points.first(e) + q, n = std::min(n_lanes, model_.points.count(e) - q);
      for (int c = 0; c < dim; ++c) {
        for (int i = 0; i < n_lanes; ++i) positions_.push_back(i < n ? model_.points.position(first + i)[c] : 0.);
      }
      for (int i = 0; i < n_lanes; ++i) alpha_.push_back(i < n ? 0.5 * model_.alpha(first + i) : 0.);
      for (int i = 0; i < n_lanes && bonds.computes_stiffness(); ++i) {
        weights_.push_back(i < n ? root_of_tau0 * model_.points.weight(first + i) : 0.);
      }
    }
  }
  displacements_.resize(positions_.size());
  forces_.resize(positions_.size());
}

/// Pairs of elements by their first element, in the order of their second one's packets, each cut into blocks of two
/// packets.
template <int dim>
void BondForces<dim>::make_blocks(const std::vector<int>& pairs) {
  const auto& bonds = model_.bonds;
  struct Block {
    int second;  ///< packet
    unsigned mask = 0;
    std::array<float, n_lanes* n_lanes> stiffness = {};  ///< where the mask has a bit; not on the fly
  };
  std::vector<std::vector<int>> pairs_from(model_.mesh.n_elements());
  for (const int p : pairs) pairs_from[bonds.pair(p).first].push_back(p);
  const auto n_packets = [&](int e) { return (model_.points.count(e) + n_lanes - 1) / n_lanes; };
  std::vector<std::vector<Block>> from_packet;
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (first_packet_[e] < 0) continue;
    from_packet.assign(n_packets(e), {});
    std::sort(pairs_from[e].begin(), pairs_from[e].end(),
              [&](int p, int q) { return first_packet_[bonds.pair(p).second] < first_packet_[bonds.pair(q).second]; });
    for (const int p : pairs_from[e]) {
      const int other = bonds.pair(p).second, n = n_packets(other);
      for (auto& blocks : from_packet) {
        for (int k = 0; k < n; ++k) blocks.push_back({first_packet_[other] + k});
      }
      bonds.for_each_bond(p, [&](const bonds::Bond<dim>& bond) {
        if (bond.is_broken) return;
        const int i = bond.first_end, j = bond.second_end;
        Block& block = *(from_packet[i / n_lanes].end() - n + j / n_lanes);
        block.mask |= bit(i % n_lanes, j % n_lanes);
        if (bonds.computes_stiffness()) return;
        block.stiffness[i % n_lanes * n_lanes + j % n_lanes] = static_cast<float>(stiffness_left(model_, bond));
      });
    }
    for (const auto& blocks : from_packet) {
      first_block_.push_back(second_.size());
      first_bond_.push_back(stiffness_.size());
      for (const auto& block : blocks) {
        if (block.mask == 0) continue;
        second_.push_back(block.second);
        masks_.push_back(static_cast<std::uint16_t>(block.mask));
        for (unsigned left = block.mask; left != 0 && !bonds.computes_stiffness(); left &= left - 1) {
          stiffness_.push_back(block.stiffness[__builtin_ctz(left)]);
        }
      }
    }
  }
  first_block_.push_back(second_.size());
  first_bond_.push_back(stiffness_.size());
}

template <int dim>
void BondForces<dim>::make_dilatation(const std::vector<int>& pairs) {
  constexpr int most_lanes = (elements::max_points + n_lanes - 1) / n_lanes * n_lanes;
  const auto& mesh = model_.mesh;
  std::vector<base::GlobalId> ids;
  std::vector<double> factors;
  std::vector<std::size_t> twins;
  std::size_t n_owned = 0;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if (first_packet_[e] < 0) continue;
    for (int q = 0; q < model_.points.count(e); q += n_lanes) {
      for (int lane = q; lane < q + n_lanes; ++lane) {
        if (mesh.is_image(e)) {
          twins.push_back(lane_of(mesh.image(e).element, lane));
        } else {
          ids.push_back(mesh.element_ids[e] * most_lanes + lane);
        }
      }
    }
    factors.resize(ids.size(), model_.elasticity.dilatation_factor(e));
    if (e < mesh.n_owned_elements) n_owned = ids.size();
  }
  dilatation_.emplace(model_.dofs.owned_dofs()->getComm(), ids, n_owned, std::move(factors), std::move(twins));
  stretches_.resize(packets_.size() * n_lanes);
  const auto add = [&](const bonds::Bond<dim>& bond) {
    if (bond.is_broken) return;
    const double weight = weight_of(bond, stiffness_left(model_, bond));
    dilatation_->add(lane_of(bond.first_element, bond.first_end), weight);
    dilatation_->add(lane_of(bond.second_element, bond.second_end), weight);
  };
  for (const int p : pairs) model_.bonds.for_each_bond(p, add);
}

/// Where a point stands among those of the packets.
template <int dim>
std::size_t BondForces<dim>::lane_of(int element, int q) const {
  return static_cast<std::size_t>(first_packet_[element]) * n_lanes + q;
}

/// Where the shape functions at four points of a reference element stand in shapes_, (n_corners, 4).
template <int dim>
std::size_t BondForces<dim>::shapes_of(const elements::ReferenceElement<dim>& reference, int first_point) {
  const auto [entry, is_new] = shape_tables_.try_emplace({&reference, first_point}, shapes_.size());
  if (is_new) {
    for (int k = 0; k < reference.n_corners; ++k) {
      for (int q = first_point; q < first_point + n_lanes; ++q) {
        shapes_.push_back(q < reference.n_points ? reference.shape[q][k] : 0.);
      }
    }
  }
  return entry->second;
}

template <int dim>
void BondForces<dim>::add_tangent_product(base::ConstField x, base::Field force) const {
  const auto n = static_cast<base::ConstField::size_type>(model_.dofs.n_nodes()) * dim;
  PERIMORPH_ASSERT(x.size() == n && force.size() == n, "{} displacements and {} forces on {} degrees of freedom",
                   x.size(), force.size(), n);
  gather(x.getRawPtr());
  std::fill(forces_.begin(), forces_.end(), 0.);
  if (dilatation_) {
    dilate<false>();
    pass_over(SumOfForces<dim, true>(forces_.data(), stretches_.data()));
  } else {
    pass_over(SumOfForces<dim, false>(forces_.data(), nullptr));
  }
  spread(force.getRawPtr());
}

template <int dim>
void BondForces<dim>::add_force_at(base::ConstField u, const std::vector<double>& eigenstrain,
                                   base::Field force) const {
  gather(u.getRawPtr());
  shrink(eigenstrain);
  std::fill(forces_.begin(), forces_.end(), 0.);
  pass_over(SumOfForces<dim, true>(forces_.data(), added_.data()));
  spread(force.getRawPtr());
}

template <int dim>
void BondForces<dim>::add_confinement(base::ConstField u, base::Field at_points) const {
  if (model_.eigenstrain == nullptr) return;
  gather(u.getRawPtr());
  shrink(model_.eigenstrain->at_points());
  std::vector<double> sums(added_.size(), 0.);
  pass_over(SumOfTensions<dim, true>(sums.data(), added_.data()));
  for (int e = 0; e < model_.mesh.n_owned_elements; ++e) {
    if (first_packet_[e] < 0) continue;
    for (int q = 0; q < model_.points.count(e); ++q) {
      at_points[model_.points.first(e) + q] -= 0.5 * sums[lane_of(e, q)];
    }
  }
}

/// From an eigenstrain, and displacements, to what is added to the stretches.
template <int dim>
void BondForces<dim>::shrink(const std::vector<double>& eigenstrain) const {
  shrinkage_.assign(packets_.size() * n_lanes, 0.);
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (first_packet_[e] < 0) continue;
    for (int q = 0; q < model_.points.count(e); ++q) {
      shrinkage_[lane_of(e, q)] = -0.5 * eigenstrain[model_.points.first(e) + q];
    }
  }
  added_ = shrinkage_;
  if (!dilatation_) return;
  dilate<true>();
  for (std::size_t i = 0; i < added_.size(); ++i) added_[i] += stretches_[i];
}

template <int dim>
void BondForces<dim>::gather(const double* u) const {
  for (std::size_t packet = 0; packet < packets_.size(); ++packet) {
    const auto [e, shapes] = packets_[packet];
    const int* nodes = model_.dofs.nodes_of(e);
    const int n = model_.mesh.n_corners(e);
    std::array<Lanes, dim> sum;
    sum.fill(Lanes::Zero());
    for (int k = 0; k < n; ++k) {
      const Eigen::Map<const Lanes> shape(shapes_.data() + shapes + k * n_lanes);
      for (int c = 0; c < dim; ++c) sum[c] += shape * u[nodes[k] * dim + c];
    }
    for (int c = 0; c < dim; ++c) Eigen::Map<Lanes>(displacements_.data() + (packet * dim + c) * n_lanes) = sum[c];
  }
}

/// Sums up over all bonds, two rows of a block at once, each of the bonds from one point of the first packet to the
/// four of the second.
template <int dim>
template <bool on_the_fly, class Sum>
void BondForces<dim>::pass_over_blocks(Sum& sum) const {
  const auto& bond_materials = model_.bonds.materials();
  const float* stiffness = stiffness_.data();
  for (std::size_t a = 0; a < packets_.size(); ++a) {
    std::array<std::array<RowPair, dim>, n_lanes / 2> x_a, u_a;
    std::array<RowPair, n_lanes / 2> alpha_a, weights_a;
    for (int rows = 0; rows < n_lanes / 2; ++rows) {
      for (int c = 0; c < dim; ++c) {
        x_a[rows][c] = first_ends(positions_.data() + (a * dim + c) * n_lanes + 2 * rows);
        u_a[rows][c] = first_ends(displacements_.data() + (a * dim + c) * n_lanes + 2 * rows);
      }
      alpha_a[rows] = first_ends(alpha_.data() + a * n_lanes + 2 * rows);
      if constexpr (on_the_fly) weights_a[rows] = first_ends(weights_.data() + a * n_lanes + 2 * rows);
    }
    const materials::Micromodulus& own = bond_materials.micromodulus_of(packets_[a].element);
    sum.start(a);
    for (std::size_t block = first_block_[a]; block < first_block_[a + 1]; ++block) {
      const std::size_t b = second_[block];
      std::array<RowPair, dim> x, u;
      for (int c = 0; c < dim; ++c) {
        x[c] = twice(positions_.data() + (b * dim + c) * n_lanes);
        u[c] = twice(displacements_.data() + (b * dim + c) * n_lanes);
      }
      const RowPair alpha = twice(alpha_.data() + b * n_lanes);
      sum.start_block(b);
      for (int rows = 0; rows < n_lanes / 2; ++rows) {
        const unsigned mask = masks_[block] >> (rows * 2 * n_lanes) & 255u;
        std::array<RowPair, dim> xi;
        RowPair elongation = RowPair::Zero();
        for (int c = 0; c < dim; ++c) {
          xi[c] = x[c] - x_a[rows][c];
          elongation += xi[c] * (u[c] - u_a[rows][c]);
        }
        RowPair k;
        if constexpr (on_the_fly) {
          const materials::Micromodulus& other = bond_materials.micromodulus_of(packets_[b].element);
          k = keep(mask, mean_decay(squared<dim>(xi), own, other)) *
              (twice(weights_.data() + b * n_lanes) * weights_a[rows]);
        } else {
          k = expand(mask, stiffness);
          stiffness += count_bits(mask);
        }
        sum.add(rows, xi, elongation, k * (alpha + alpha_a[rows]));
      }
      sum.end_block(b);
    }
    sum.end(a);
  }
}

template <int dim>
template <class Sum>
void BondForces<dim>::pass_over(Sum sum) const {
  model_.bonds.computes_stiffness() ? pass_over_blocks<true>(sum) : pass_over_blocks<false>(sum);
}

/// From displacements, and from what shrinks the bonds, to p at the points.
template <int dim>
template <bool shrinks>
void BondForces<dim>::dilate() const {
  std::fill(stretches_.begin(), stretches_.end(), 0.);
  pass_over(SumOfTensions<dim, shrinks>(stretches_.data(), shrinkage_.data()));
  dilatation_->to_stretch(stretches_);
}

template <int dim>
std::vector<double> BondForces<dim>::dilatational_stretch() const {
  if (!dilatation_) return {};
  std::vector<double> at_points(model_.points.size(), 0.);
  for (int e = 0; e < model_.mesh.n_elements(); ++e) {
    if (first_packet_[e] < 0) continue;
    std::copy_n(stretches_.begin() + static_cast<std::ptrdiff_t>(lane_of(e, 0)), model_.points.count(e),
                at_points.begin() + model_.points.first(e));
  }
  return at_points;
}

template <int dim>
void BondForces<dim>::spread(double* force) const {
  for (std::size_t packet = 0; packet < packets_.size(); ++packet) {
    const auto [e, shapes] = packets_[packet];
    const int* nodes = model_.dofs.nodes_of(e);
    const int n = model_.mesh.n_corners(e);
    for (int k = 0; k < n; ++k) {
      const Eigen::Map<const Lanes> shape(shapes_.data() + shapes + k * n_lanes);
      for (int c = 0; c < dim; ++c) {
        const Eigen::Map<const Lanes> at_points(forces_.data() + (packet * dim + c) * n_lanes);
        force[nodes[k] * dim + c] += (shape * at_points).sum();
      }
    }
  }
}

template <int dim>
void BondForces<dim>::take(const bonds::BondChange& change) {
  PERIMORPH_ASSERT(change.broken.empty() || change.broken.back() < model_.bonds.n_bonds(), "bond {} of {}",
                   change.broken.back(), model_.bonds.n_bonds());
  for (const auto id : change.broken) {
    const auto bond = model_.bonds.bond(id);
    if (!holds({bond.first_element, bond.second_element})) continue;
    if (dilatation_) {
      const double weight = weight_of(bond, stiffness_left(model_, bond));
      dilatation_->remove(lane_of(bond.first_element, bond.first_end), weight);
      dilatation_->remove(lane_of(bond.second_element, bond.second_end), weight);
    }
    const auto [block, position, its_bit] = place_of(bond);
    if (model_.bonds.computes_stiffness()) {
      masks_[block] = static_cast<std::uint16_t>(masks_[block] & ~its_bit);
    } else {
      stiffness_[position] = 0.F;
    }
  }
  for (const auto& [id, stretch, loss] : change.softened) {
    const auto bond = model_.bonds.bond(id);
    if (!holds({bond.first_element, bond.second_element})) continue;
    if (dilatation_) {
      const double weight = weight_of(bond, model_.bonds.stiffness(bond) * loss);
      dilatation_->weaken(lane_of(bond.first_element, bond.first_end), weight);
      dilatation_->weaken(lane_of(bond.second_element, bond.second_end), weight);
    }
    PERIMORPH_ASSERT(!model_.bonds.computes_stiffness(), "bond {} softens, but its stiffness is not stored", id);
    stiffness_[place_of(bond).position] = static_cast<float>(stiffness_left(model_, bond));
  }
}

template <int dim>
typename BondForces<dim>::Place BondForces<dim>::place_of(const bonds::Bond<dim>& bond) const {
  const int i = bond.first_end, j = bond.second_end;
  const int a = first_packet_[bond.first_element] + i / n_lanes;
  const int b = first_packet_[bond.second_element] + j / n_lanes;
  const unsigned its_bit = bit(i % n_lanes, j % n_lanes);
  std::size_t block = first_block_[a], position = first_bond_[a];
  for (; second_[block] != b; ++block) position += count_bits(masks_[block]);
  return {block, position + count_bits(masks_[block] & (its_bit - 1u)), its_bit};
}

template <int dim>
std::size_t BondForces<dim>::bytes() const {
  const auto size = [](const auto& vector) { return vector.size() * sizeof(vector[0]); };
  return size(packets_) + size(positions_) + size(alpha_) + size(weights_) + size(first_packet_) + size(first_block_) +
         size(first_bond_) + size(second_) + size(masks_) + size(stiffness_) + size(displacements_) + size(forces_) +
         size(stretches_) + size(shrinkage_) + size(added_) + (dilatation_ ? dilatation_->bytes() : 0);
}

template class BondForces<2>;
template class BondForces<3>;

}  // namespace perimorph::operators
