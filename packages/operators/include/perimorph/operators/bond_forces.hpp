#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "perimorph/operators/dilatation.hpp"
#include "perimorph/operators/elastic_term.hpp"

namespace perimorph::operators {

/// B^T K_bonds B u, the double sum in K [WHL19, eq. 22], without a matrix: gather displacements to the points, pull
/// along every intact bond, spread the forces to the nodes. Four points of an element make a packet; the bonds between
/// two packets are a mask of 16 bits and one single-precision number per bond, so that few bytes stream past per bond.
/// If the bonds compute their stiffness on the fly, the mask is all: a tenth of the bytes for twice the arithmetic.
/// With dilatation the bonds are passed over twice: for the sums at each point, and for the forces. An eigenstrain
/// takes its mean at both ends off the stretch of each bond.
template <int dim>
class BondForces : public ElasticTerm<dim> {
 public:
  /// Of the intact bonds. Collective with dilatation. The model is read again later and must outlive this.
  /// @param part elements at either end
  explicit BondForces(const CoupledModel<dim>& model, MeshPart part = {});

  /// p of the displacement that the last product or force was of, at all points, (n_points), [-]; empty without
  /// dilatation. Local.
  std::vector<double> dilatational_stretch() const;

  void add_tangent_product(base::ConstField x, base::Field force) const override;
  void add_confinement(base::ConstField u, base::Field at_points) const override;
  void take(const bonds::BondChange& change) override;
  Teuchos::RCP<ForceTerm<dim>> within(const MeshPart& part) const override {
    return Teuchos::rcp(new BondForces(model_, part));
  }
  std::size_t bytes() const override;

  // In a matrix, with those bonds that it selects, and without dilatation, which would couple across two horizons.
  void couple(const StiffnessMatrix<dim>& matrix, Couplings<dim>& couplings) const override;
  void add_to(StiffnessMatrix<dim>& matrix) const override;
  void take(const bonds::BondChange& change, StiffnessMatrix<dim>& matrix, std::vector<int>& changed) const override;

 private:
  struct Packet {
    int element;
    std::size_t shapes;  ///< position in shapes_ of the shape functions at its points, (n_corners, 4)
  };
  using ElasticTerm<dim>::model_;
  MeshPart part_;
  std::map<std::pair<const elements::ReferenceElement<dim>*, int>, std::size_t> shape_tables_;
  std::vector<double> shapes_;
  std::vector<Packet> packets_;
  std::vector<double> positions_;  ///< per packet: (dim, 4)
  std::vector<double> alpha_;      ///< per packet: (4), halved
  std::vector<double> weights_;    ///< per packet: (4), times sqrt(tau0) of its material; on the fly only
  std::vector<int> first_packet_;  ///< per element, -1 without bonds

  // Blocks of bonds, from each packet to packets that come with it in a pair.
  std::vector<std::size_t> first_block_, first_bond_;  ///< per packet
  std::vector<int> second_;                            ///< per block: the other packet
  std::vector<std::uint16_t> masks_;                   ///< per block: bit 4 i + j is the bond from point i to point j
  std::vector<float> stiffness_;  ///< c0 w w of each bond as softened, zero if it has broken since; empty on the fly

  mutable std::vector<double> displacements_, forces_;  ///< per packet: (dim, 4)

  std::optional<Dilatation> dilatation_;   ///< at the points of the packets
  mutable std::vector<double> stretches_;  ///< per packet: (4), first S and then p

  // What the points of a packet add to the stretch of their bonds, (4) each; empty where that is p alone.
  mutable std::vector<double> shrinkage_;  ///< less half of the eigenstrain
  mutable std::vector<double> added_;      ///< and p

  struct Place {
    std::size_t block, position;  ///< in masks_ and in stiffness_
    unsigned bit;                 ///< of the mask
  };

  bool holds(const bonds::ElementPair& pair) const {
    return part_.holds_element(pair.first) || part_.holds_element(pair.second);
  }
  std::vector<int> pairs() const;
  void make_packets(const std::vector<int>& pairs);
  void make_blocks(const std::vector<int>& pairs);
  std::size_t shapes_of(const elements::ReferenceElement<dim>& reference, int first_point);
  void make_dilatation(const std::vector<int>& pairs);
  std::size_t lane_of(int element, int q) const;
  Place place_of(const bonds::Bond<dim>& bond) const;
  void add_force_at(base::ConstField u, const std::vector<double>& eigenstrain, base::Field force) const override;
  void gather(const double* u) const;
  void shrink(const std::vector<double>& eigenstrain) const;
  template <class Sum>
  void pass_over(Sum sum) const;
  template <bool on_the_fly, class Sum>
  void pass_over_blocks(Sum& sum) const;
  template <bool shrinks>
  void dilate() const;
  void spread(double* force) const;
};

}  // namespace perimorph::operators
