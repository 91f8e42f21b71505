#pragma once

// The parts of the coupled model on a small mesh, put together without a case file, for tests of single packages.

#include <Teuchos_DefaultComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <set>

#include "perimorph/discretization/topology.hpp"
#include "perimorph/operators/bond_forces.hpp"
#include "perimorph/operators/fields.hpp"
#include "perimorph/operators/local_forces.hpp"
#include "perimorph/operators/matrix_free_tangent.hpp"
#include "perimorph/operators/stiffness_matrix.hpp"
#include "perimorph/operators/supports.hpp"
#include "support/meshes.hpp"

namespace perimorph::tests {

struct Setup {
  Grid grid;
  double horizon, characteristic_length;
  std::vector<morphing::Zone<2>> zones;
  operators::PeridynamicStiffness policy = operators::PeridynamicStiffness::dropped;
  bool whole_zone_discontinuous = false;
  std::vector<discretization::PrescribedComponent> prescribed = {};
  std::vector<mesh::CrackFacet<2>> pre_cracks = {};
  bonds::StiffnessStorage kept = bonds::StiffnessStorage::stored;
  double poissons_ratio = 1. / 3.;
  double stiffer = 1.;  ///< by how much the elements of odd ids are, with a longer characteristic length; 1: all alike
  materials::BondLaw law = {};  ///< of all bonds
  discretization::CrackFaces crack_faces = discretization::CrackFaces::free;
};

/// Bonds that soften from a stretch of 0.01 and break at one of 0.36.
inline materials::BondLaw soft_law() {
  return materials::BondLaw::softening(materials::Softening::bilinear, 0.01, 0.001);
}

struct CoupledBody {
  using Matrix = Tpetra::CrsMatrix<double>;

  Teuchos::RCP<const base::Comm> comm;
  mesh::Mesh<2> mesh;
  base::Stiffness<2> e0;
  materials::Micromodulus c0;
  discretization::Topology<2> topology;
  const elements::MaterialPoints<2>& points = topology.points();
  const morphing::MorphingField<2>& alpha = topology.alpha();
  const bonds::BondFamilies<2>& bonds = topology.bonds();
  const std::vector<morphing::ElementClass>& classes = topology.classes();
  const std::vector<char>& discontinuous = topology.discontinuous();
  discretization::Dirichlet<2> dirichlet;
  operators::MorphedStiffness<2> elasticity;
  const discretization::DofMap<2>* dofs = nullptr;
  std::unique_ptr<discretization::Space<2>> space;
  std::unique_ptr<operators::StiffnessMatrix<2>> stiffness;

  static constexpr double youngs_modulus = 1000.;
  static constexpr auto elastic_model = materials::ElasticModel::plane_stress;

  explicit CoupledBody(const Setup& setup, const Teuchos::RCP<const base::Comm>& on = Tpetra::getDefaultComm())
      : CoupledBody(setup, grid(setup.grid), on) {}

  /// @param whole the whole mesh (used on rank 0); @param on the ranks that share it
  CoupledBody(const Setup& setup, const mesh::Mesh<2>& whole,
              const Teuchos::RCP<const base::Comm>& on = Tpetra::getDefaultComm())
      : comm(on),
        mesh(mesh::distribute(*comm, whole, setup.horizon)),
        e0(materials::elasticity_tensor<2>(elastic_model, youngs_modulus, setup.poissons_ratio)),
        c0(materials::calibrate<2>(elastic_model, youngs_modulus, setup.poissons_ratio, setup.characteristic_length,
                                   setup.horizon)),
        topology(comm, mesh,
                 {setup.zones, setup.pre_cracks, bond_materials(setup), morphing::BlendingFunction::linear,
                  setup.whole_zone_discontinuous ? discretization::DiscontinuousElements::whole_zone
                                                 : discretization::DiscontinuousElements::on_damage,
                  2., 4., 2, setup.kept, setup.crack_faces}),
        dirichlet(*comm, mesh, setup.prescribed),
        elasticity(elasticities(setup), of_elements(setup), setup.policy) {
    topology.update(topology.grow({}));
    elasticity.update(mesh, points, bonds, alpha, classes, discontinuous);
    dofs = &topology.dofs();
    space = std::make_unique<discretization::Space<2>>(*dofs, dirichlet);
    make_matrix();
  }
  CoupledBody(const CoupledBody&) = delete;
  CoupledBody& operator=(const CoupledBody&) = delete;

  /// Which of two materials each local element has.
  std::vector<int> of_elements(const Setup& setup) const {
    std::vector<int> places;
    for (const auto id : mesh.element_ids) places.push_back(id % 2 != 0 && setup.stiffer != 1. ? 1 : 0);
    return places;
  }
  materials::BondMaterials bond_materials(const Setup& setup) const {
    return {{c0, {setup.stiffer * c0.tau0, 1.1 * c0.characteristic_length, c0.horizon}},
            std::vector<materials::BondLaw>(4, setup.law),
            of_elements(setup)};
  }
  std::vector<operators::Elasticity<2>> elasticities(const Setup& setup) const {
    const double factor = materials::dilatational_ratio(elastic_model, setup.poissons_ratio) / 4.;
    return {{e0, factor}, {setup.stiffer * e0, factor}};
  }

  operators::CoupledModel<2> model() const { return {mesh, points, bonds, alpha, elasticity, *dofs}; }

  operators::Supports<2> supports() const { return {model(), *space, discontinuous}; }

  /// Local elements, bonds and anchors, without the bonds that are broken now.
  operators::ForceTerms<2> terms() const {
    return {Teuchos::rcp(new operators::LocalForces<2>(model())), Teuchos::rcp(new operators::BondForces<2>(model())),
            Teuchos::rcp(new operators::Anchors<2>(supports().anchors))};
  }
  operators::MatrixFreeTangent<2> tangent(operators::ForceTerms<2> of_terms) const {
    return {*space, std::move(of_terms), supports().constraints};
  }
  std::unique_ptr<operators::StiffnessMatrix<2>> matrix_of(
      const operators::BondSelection& selection, const Teuchos::RCP<const operators::PointBasis<2>>& basis) const {
    return std::make_unique<operators::StiffnessMatrix<2>>(model(), *space, terms(), supports().constraints, selection,
                                                           basis);
  }
  void make_matrix() { stiffness = matrix_of(operators::all_bonds, Teuchos::null); }
  Teuchos::RCP<const operators::PointBasis<2>> point_basis() const {
    return Teuchos::rcp(new operators::PointBasis<2>(model(), *space, discontinuous));
  }

  /// Of the owned nodes.
  std::vector<Point2> node_coordinates() const {
    std::vector<Point2> coordinates;
    for (int n = 0; n < dofs->n_owned_nodes(); ++n) {
      coordinates.push_back(mesh.coordinates[dofs->reference_node(n)]);
    }
    return coordinates;
  }

  /// The intact bonds between two elements where is_chosen(first, second), ascending.
  template <class IsChosen>
  std::vector<std::size_t> bonds_between(const IsChosen& is_chosen) const {
    std::vector<std::size_t> chosen;
    for (int p = 0; p < bonds.n_pairs(); ++p) {
      const auto [first, second] = bonds.pair(p);
      if (!is_chosen(first, second)) continue;
      for (auto b = bonds.first_bond(p); b < bonds.first_bond(p + 1); ++b) {
        if (!bonds.broken(b)) chosen.push_back(b);
      }
    }
    return chosen;
  }

  /// The intact bonds between elements on both sides of a line normal to an axis, up to where the other axis is end.
  std::vector<std::size_t> bonds_across(int axis, double line, double end) const {
    return bonds_between([&](int first, int second) {
      const Point2 one = mesh::centroid(mesh, first), other = mesh::centroid(mesh, second);
      return (one[axis] < line) != (other[axis] < line) && std::max(one[1 - axis], other[1 - axis]) <= end;
    });
  }

  /// Returns the bonds that it breaks.
  std::vector<std::size_t> break_bonds(std::vector<std::size_t> broken) {
    topology.take({broken});
    return broken;
  }

  /// Breaks the bonds between pairs of elements the sum of whose ids is a multiple of n. Returns them.
  std::vector<std::size_t> break_each(int n) {
    return break_bonds(bonds_between([&](int first, int second) {
      return first != second && (mesh.element_ids[first] + mesh.element_ids[second]) % n == 0;
    }));
  }

  /// Softens the bonds between such pairs, some more than others; of a law that softens.
  /// @param share of the width of the law, up to a third
  bonds::BondChange soften_each(int n, double share) {
    bonds::BondChange change;
    for (const auto b : bonds_between([&](int first, int second) {
           return first != second && (mesh.element_ids[first] + mesh.element_ids[second]) % n == 0;
         })) {
      const auto bond = bonds.bond(b);
      const auto& law = model().law(bond);
      const double of_width = share * (1. + (bond.first_end + bond.second_end) % 3);
      const auto stretch = static_cast<float>(law.limit() + of_width * (law.critical_stretch() - law.limit()));
      change.softened.push_back({b, stretch, bonds.share_left(bond) - law.share_left(stretch)});
    }
    topology.take(change);
    return change;
  }

  /// The owned nodes whose rows another matrix of the same pattern has other values in.
  static std::set<int> nodes_that_differ(const Matrix& one, const Matrix& other) {
    const auto a = one.getLocalMatrixHost(), b = other.getLocalMatrixHost();
    std::set<int> nodes;
    for (int row = 0; row < a.numRows(); ++row) {
      for (auto i = a.graph.row_map(row); i < a.graph.row_map(row + 1); ++i) {
        if (a.values(i) != b.values(i)) nodes.insert(row / 2);
      }
    }
    return nodes;
  }

  /// The matrix, dense; on one rank.
  Eigen::MatrixXd dense() const {
    const auto local = stiffness->matrix()->getLocalMatrixHost();
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(local.numRows(), local.numCols());
    for (int row = 0; row < local.numRows(); ++row) {
      for (auto i = local.graph.row_map(row); i < local.graph.row_map(row + 1); ++i) {
        k(row, local.graph.entries(i)) = local.values(i);
      }
    }
    return k;
  }
};

}  // namespace perimorph::tests
