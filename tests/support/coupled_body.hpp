#pragma once

// The parts of the coupled model on a small mesh, put together without a case file, for tests of single packages.

#include <Teuchos_DefaultComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <set>

#include "perimorph/operators/coupled_stiffness.hpp"
#include "perimorph/operators/fields.hpp"
#include "perimorph/operators/matrix_free_stiffness.hpp"
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
};

struct CoupledBody {
  using Matrix = Tpetra::CrsMatrix<double>;

  Teuchos::RCP<const base::Comm> comm = Tpetra::getDefaultComm();
  mesh::Mesh<2> mesh;
  base::Stiffness<2> e0;
  materials::Micromodulus c0;
  elements::MaterialPoints<2> points;
  morphing::MorphingField<2> alpha;
  bonds::BondFamilies<2> bonds;
  operators::MorphedStiffness<2> elasticity;
  discretization::Dirichlet<2> dirichlet;
  std::vector<morphing::ElementClass> classes;
  std::vector<char> discontinuous;
  std::unique_ptr<discretization::DofMap<2>> dofs;
  std::unique_ptr<operators::CoupledStiffness<2>> stiffness;

  static constexpr double youngs_modulus = 1000.;

  explicit CoupledBody(const Setup& setup) : CoupledBody(setup, grid(setup.grid)) {}

  /// @param whole the whole mesh (used on rank 0)
  CoupledBody(const Setup& setup, const mesh::Mesh<2>& whole)
      : mesh(mesh::distribute(*comm, whole, setup.horizon)),
        e0(materials::elasticity_tensor<2>(materials::ElasticModel::plane_stress, youngs_modulus, 1. / 3.)),
        c0(materials::calibrate<2>(materials::ElasticModel::plane_stress, youngs_modulus, setup.characteristic_length,
                                   setup.horizon)),
        points(mesh),
        alpha(mesh, points, morphing::BlendingFunction::linear),
        bonds(mesh, points, mesh::active_elements(mesh), c0, setup.pre_cracks, setup.kept),
        elasticity(e0, setup.policy),
        dirichlet(*comm, mesh, setup.prescribed),
        classes(mesh.n_elements(), morphing::ElementClass::fe),
        discontinuous(mesh.n_elements(), 0) {
    bonds.extend(alpha.add(setup.zones));
    const auto extremes = bonds.neighbourhood_extremes(alpha);
    for (int e = 0; e < mesh.n_owned_elements; ++e) {
      double smallest = 1., largest = 0.;
      for (int p = points.first(e); p < points.first(e + 1); ++p) {
        smallest = std::min(smallest, extremes.smallest[p]);
        largest = std::max(largest, extremes.largest[p]);
      }
      classes[e] = smallest == 1. ? morphing::ElementClass::pd
                   : largest > 0. ? morphing::ElementClass::morph
                                  : morphing::ElementClass::fe;
      discontinuous[e] = setup.whole_zone_discontinuous && classes[e] == morphing::ElementClass::pd;
    }
    const auto exchange = discretization::element_exchange(*comm, mesh);
    exchange.update(classes);
    exchange.update(discontinuous);
    elasticity.update(mesh, points, bonds, alpha, classes, discontinuous);
    dofs = std::make_unique<discretization::DofMap<2>>(comm, mesh, discretization::corner_exchange(*comm, mesh),
                                                       discontinuous);
    stiffness = std::make_unique<operators::CoupledStiffness<2>>(model(), supports());
  }

  operators::CoupledModel<2> model() const { return {mesh, points, bonds, alpha, elasticity, *dofs}; }

  operators::Supports<2> supports() const { return {model(), dirichlet, discontinuous}; }

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
    for (const auto b : broken) bonds.set_broken(b);
    return broken;
  }

  /// Breaks the bonds between pairs of elements the sum of whose ids is a multiple of n. Returns them.
  std::vector<std::size_t> break_each(int n) {
    return break_bonds(bonds_between([&](int first, int second) {
      return first != second && (mesh.element_ids[first] + mesh.element_ids[second]) % n == 0;
    }));
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
