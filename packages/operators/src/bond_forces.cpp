#include "perimorph/operators/bond_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lanes.hpp"
#include "perimorph/materials/decay.hpp"

namespace perimorph::operators {

namespace {

constexpr unsigned bit(int i, int j) { return 1u << (i * n_lanes + j); }
RowPair first_ends(const double* at_points) {
  RowPair both;
  both << Lanes::Constant(at_points[0]), Lanes::Constant(at_points[1]);
  return both;
}
auto first_row(const RowPair& rows) { return rows.head<n_lanes>(); }
auto second_row(const RowPair& rows) { return rows.tail<n_lanes>(); }
int count_bits(unsigned mask) { return __builtin_popcount(mask); }

}  // namespace

template <int dim>
BondForces<dim>::BondForces(const CoupledModel<dim>& model)
    : model_(model), first_packet_(model.mesh.n_elements(), -1) {
  const auto& bonds = model.bonds;
  const double root_of_tau0 = std::sqrt(bonds.micromodulus().tau0);
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (bonds.pairs_of(e).empty()) continue;
    first_packet_[e] = static_cast<int>(packets_.size());
    for (int q = 0; q < model.points.count(e); q += n_lanes) {
      packets_.push_back({e, shapes_of(model.points.reference(e), q)});
      const int first = model.points.first(e) + q, n = std::min(n_lanes, model.points.count(e) - q);
      for (int c = 0; c < dim; ++c) {
        for (int i = 0; i < n_lanes; ++i) positions_.push_back(i < n ? model.points.position(first + i)[c] : 0.);
      }
      for (int i = 0; i < n_lanes; ++i) alpha_.push_back(i < n ? 0.5 * model.alpha(first + i) : 0.);
      for (int i = 0; i < n_lanes && bonds.computes_stiffness(); ++i) {
        weights_.push_back(i < n ? root_of_tau0 * model.points.weight(first + i) : 0.);
      }
    }
  }
  displacements_.resize(positions_.size());
  forces_.resize(positions_.size());

  // Pairs of elements by their first element, each cut into blocks of two packets.
  struct Bond {
    int second, position;  ///< packet, number of the bit
    float stiffness;       ///< not on the fly
  };
  std::vector<std::vector<int>> pairs_from(model.mesh.n_elements());
  for (int p = 0; p < bonds.n_pairs(); ++p) pairs_from[bonds.pair(p).first].push_back(p);
  std::vector<std::vector<Bond>> from_packet;
  for (int e = 0; e < model.mesh.n_elements(); ++e) {
    if (first_packet_[e] < 0) continue;
    from_packet.assign((model.points.count(e) + n_lanes - 1) / n_lanes, {});
    for (const int p : pairs_from[e]) {
      for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) {
        if (bonds.broken(b)) continue;
        const int i = bonds.first_end(b), j = bonds.second_end(b), other = bonds.pair(p).second;
        const double stiffness = bonds.computes_stiffness()
                                     ? 0.
                                     : bonds.stiffness(b, model.points.first(e) + i, model.points.first(other) + j);
        from_packet[i / n_lanes].push_back(
            {first_packet_[other] + j / n_lanes, i % n_lanes * n_lanes + j % n_lanes, static_cast<float>(stiffness)});
      }
    }
    for (auto& list : from_packet) {
      first_block_.push_back(second_.size());
      first_bond_.push_back(stiffness_.size());
      std::sort(list.begin(), list.end(), [](const Bond& a, const Bond& b) {
        return a.second != b.second ? a.second < b.second : a.position < b.position;
      });
      for (const auto& bond : list) {
        if (second_.size() == first_block_.back() || second_.back() != bond.second) {
          second_.push_back(bond.second);
          masks_.push_back(0);
        }
        masks_.back() = static_cast<std::uint16_t>(masks_.back() | 1u << bond.position);
        if (!bonds.computes_stiffness()) stiffness_.push_back(bond.stiffness);
      }
    }
  }
  first_block_.push_back(second_.size());
  first_bond_.push_back(stiffness_.size());
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
void BondForces<dim>::add(const double* u, double* force) const {
  gather(u);
  model_.bonds.computes_stiffness() ? pull<true>() : pull<false>();
  spread(force);
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

/// Two rows of a block at once, each of the bonds from one point of the first packet to the four of the second.
template <int dim>
template <bool on_the_fly>
void BondForces<dim>::pull() const {
  const double length = model_.bonds.micromodulus().characteristic_length;
  std::fill(forces_.begin(), forces_.end(), 0.);
  const float* stiffness = stiffness_.data();
  for (std::size_t a = 0; a < packets_.size(); ++a) {
    std::array<std::array<RowPair, dim>, n_lanes / 2> x_a, u_a, on_a;
    std::array<RowPair, n_lanes / 2> alpha_a, weights_a;
    for (int rows = 0; rows < n_lanes / 2; ++rows) {
      for (int c = 0; c < dim; ++c) {
        x_a[rows][c] = first_ends(positions_.data() + (a * dim + c) * n_lanes + 2 * rows);
        u_a[rows][c] = first_ends(displacements_.data() + (a * dim + c) * n_lanes + 2 * rows);
        on_a[rows][c].setZero();
      }
      alpha_a[rows] = first_ends(alpha_.data() + a * n_lanes + 2 * rows);
      if constexpr (on_the_fly) weights_a[rows] = first_ends(weights_.data() + a * n_lanes + 2 * rows);
    }
    for (std::size_t block = first_block_[a]; block < first_block_[a + 1]; ++block) {
      const std::size_t b = second_[block];
      std::array<RowPair, dim> x, u, on_b;
      for (int c = 0; c < dim; ++c) {
        x[c] = twice(positions_.data() + (b * dim + c) * n_lanes);
        u[c] = twice(displacements_.data() + (b * dim + c) * n_lanes);
        on_b[c].setZero();
      }
      const RowPair alpha = twice(alpha_.data() + b * n_lanes);
      for (int rows = 0; rows < n_lanes / 2; ++rows) {
        const unsigned mask = masks_[block] >> (rows * 2 * n_lanes) & 255u;
        std::array<RowPair, dim> xi;
        RowPair pull = RowPair::Zero();
        for (int c = 0; c < dim; ++c) {
          xi[c] = x[c] - x_a[rows][c];
          pull += xi[c] * (u[c] - u_a[rows][c]);
        }
        RowPair k;
        if constexpr (on_the_fly) {
          RowPair squared = RowPair::Zero();
          for (int c = 0; c < dim; ++c) squared += xi[c] * xi[c];
          k = keep(mask, materials::decay(squared, length)) * (twice(weights_.data() + b * n_lanes) * weights_a[rows]);
        } else {
          k = expand(mask, stiffness);
          stiffness += count_bits(mask);
        }
        pull *= k * (alpha + alpha_a[rows]);
        for (int c = 0; c < dim; ++c) {
          on_a[rows][c] -= pull * xi[c];
          on_b[c] += pull * xi[c];
        }
      }
      for (int c = 0; c < dim; ++c) {
        Eigen::Map<Lanes>(forces_.data() + (b * dim + c) * n_lanes) += first_row(on_b[c]) + second_row(on_b[c]);
      }
    }
    for (int rows = 0; rows < n_lanes / 2; ++rows) {
      for (int c = 0; c < dim; ++c) {
        double* force = forces_.data() + (a * dim + c) * n_lanes + 2 * rows;
        force[0] += first_row(on_a[rows][c]).sum();
        force[1] += second_row(on_a[rows][c]).sum();
      }
    }
  }
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
void BondForces<dim>::subtract(const std::vector<std::size_t>& broken) {
  for (const auto bond : broken) {
    const auto [first, second] = model_.bonds.pair(model_.bonds.pair_of(bond));
    const int i = model_.bonds.first_end(bond), j = model_.bonds.second_end(bond);
    const int a = first_packet_[first] + i / n_lanes, b = first_packet_[second] + j / n_lanes;
    const unsigned its_bit = bit(i % n_lanes, j % n_lanes);
    std::size_t block = first_block_[a], position = first_bond_[a];
    for (; second_[block] != b; ++block) position += count_bits(masks_[block]);
    if (model_.bonds.computes_stiffness()) {
      masks_[block] = static_cast<std::uint16_t>(masks_[block] & ~its_bit);
    } else {
      stiffness_[position + count_bits(masks_[block] & (its_bit - 1u))] = 0.F;
    }
  }
}

template <int dim>
std::size_t BondForces<dim>::bytes() const {
  const auto size = [](const auto& vector) { return vector.size() * sizeof(vector[0]); };
  return size(packets_) + size(positions_) + size(alpha_) + size(weights_) + size(first_packet_) + size(first_block_) +
         size(first_bond_) + size(second_) + size(masks_) + size(stiffness_) + size(displacements_) + size(forces_);
}

template class BondForces<2>;
template class BondForces<3>;

}  // namespace perimorph::operators
