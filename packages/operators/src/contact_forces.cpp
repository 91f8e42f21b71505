#include "perimorph/operators/contact_forces.hpp"

#include "at_points.hpp"
#include "perimorph/base/errors.hpp"
#include "point_springs.hpp"

namespace perimorph::operators {

using base::Point;

template <int dim>
ContactForces<dim>::ContactForces(const CoupledModel<dim>& model, const discretization::Topology<dim>& topology)
    : model_(model), normals_(model, topology) {
  const auto add = [&](const bonds::Bond<dim>& bond) { this->add(bond); };
  model_.bonds.for_each_bond(add);
  for (const auto& bond : topology.bonds_across_faces()) add(bond);
}

template <int dim>
void ContactForces<dim>::add(const bonds::Bond<dim>& bond) {
  const double stiffness = stiffness_of(bond);
  if (stiffness == 0.) return;
  const Point<dim> n = normals_.across(bond);
  if (model_.bonds.softens() && bond.id < model_.bonds.n_bonds()) place_of_[bond.id] = contacts_.size();
  contacts_.push_back({bond, bond.xi.dot(n) * n, stiffness});
}

/// As a bond may never have been, its stiffness follows from its points. kappa / mu of a material is its factor of
/// dilatation times 2 (dim + 2) / dim, and (lambda + 2 mu) / (3 mu) is 1 + kappa / (3 mu).
template <int dim>
double ContactForces<dim>::stiffness_of(const bonds::Bond<dim>& bond) const {
  const double lost = model_.share_lost(bond);
  if (lost == 0.) return 0.;
  const auto mean = [](double one, double other) { return 0.5 * (one + other); };
  const double c0 = model_.bonds.materials().stiffness(bond.first_element, bond.second_element, bond.xi.norm());
  const double factor = mean(model_.elasticity.dilatation_factor(bond.first_element),
                             model_.elasticity.dilatation_factor(bond.second_element));
  return lost * c0 * mean(model_.alpha(bond.first_point), model_.alpha(bond.second_point)) *
         model_.points.weight(bond.first_point) * model_.points.weight(bond.second_point) *
         (1. + factor * 2. * (dim + 2.) / (3. * dim));
}

template <int dim>
double ContactForces<dim>::elongation(const Contact& contact, base::ConstField u) const {
  const auto& bond = contact.bond;
  return contact.g.dot(displacement_at(model_, u, bond.second_element, bond.second_end) -
                       displacement_at(model_, u, bond.first_element, bond.first_end));
}

template <int dim>
void ContactForces<dim>::push(const Contact& contact, double tension, base::Field force) const {
  const auto& bond = contact.bond;
  const Point<dim> on_second = tension * contact.g;
  spread<dim>(model_, bond.first_element, bond.first_end, -on_second, force);
  spread<dim>(model_, bond.second_element, bond.second_end, on_second, force);
}

template <int dim>
void ContactForces<dim>::add_force(base::ConstField u, base::Field force) const {
  PERIMORPH_ASSERT(u.size() == force.size(), "{} displacements, {} forces", u.size(), force.size());
  for (const auto& contact : contacts_) {
    const double q = elongation(contact, u);
    if (q < 0.) push(contact, contact.stiffness * q, force);
  }
}

template <int dim>
void ContactForces<dim>::prepare_tangent(base::ConstField u) {
  stiffened_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    auto& contact = contacts_[i];
    const double wanted = elongation(contact, u) < 0. ? contact.stiffness : 0.;
    if (wanted == contact.in_tangent) continue;
    stiffened_.push_back({i, wanted - contact.in_tangent});
    contact.in_tangent = wanted;
  }
}

template <int dim>
void ContactForces<dim>::add_tangent_product(base::ConstField x, base::Field force) const {
  PERIMORPH_ASSERT(x.size() == force.size(), "{} displacements, {} forces", x.size(), force.size());
  for (const auto& contact : contacts_) {
    if (contact.in_tangent != 0.) push(contact, contact.in_tangent * elongation(contact, x), force);
  }
}

/// A bond that softens changes what is known of it, or becomes known, as one that breaks does.
template <int dim>
void ContactForces<dim>::take(const bonds::BondChange& change) {
  const auto take = [&](bonds::Bond<dim> bond) {
    const auto known = place_of_.find(bond.id);
    if (known == place_of_.end()) return add(bond);
    contacts_[known->second].bond = bond;
    contacts_[known->second].stiffness = stiffness_of(bond);
  };
  for (const auto id : change.broken) take(model_.bonds.bond(id));
  for (const auto& softened : change.softened) take(model_.bonds.bond(softened.id));
}

template <int dim>
double ContactForces<dim>::energy(base::ConstField u) const {
  double energy = 0.;
  for (const auto& contact : contacts_) {
    if (contact.bond.first_element >= model_.mesh.n_owned_elements) continue;
    const double q = std::min(0., elongation(contact, u));
    energy += 0.5 * contact.stiffness * q * q;
  }
  return energy;
}

template <int dim>
std::vector<ContactSpring<dim>> ContactForces<dim>::closed(base::ConstField u) const {
  std::vector<ContactSpring<dim>> springs;
  for (const auto& contact : contacts_) {
    const double q = elongation(contact, u);
    if (q < 0.) springs.push_back({contact.bond, contact.g, q, contact.stiffness * q});
  }
  return springs;
}

template <int dim>
void ContactForces<dim>::couple(const StiffnessMatrix<dim>& matrix, Couplings<dim>& couplings) const {
  bonds::ElementPair last{-1, -1};
  for (const auto& contact : contacts_) {
    const auto& bond = contact.bond;
    if (!matrix.selects(bond.xi)) continue;
    if (matrix.is_by_points(bond.first_element) || matrix.is_by_points(bond.second_element)) {
      couplings.add_nodes(matrix.nodes_at(bond.first_element, bond.first_end),
                          matrix.nodes_at(bond.second_element, bond.second_end));
    } else if (!(last == bonds::ElementPair{bond.first_element, bond.second_element})) {
      last = {bond.first_element, bond.second_element};
      couplings.add_elements(last.first, last.second);
    }
  }
}

template <int dim>
void ContactForces<dim>::add_to(StiffnessMatrix<dim>& matrix) const {
  std::vector<Stiffening> all;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (contacts_[i].in_tangent != 0.) all.push_back({i, contacts_[i].in_tangent});
  }
  std::vector<int> changed;
  add_to(matrix, all, changed);
}

template <int dim>
void ContactForces<dim>::update_tangent(StiffnessMatrix<dim>& matrix, std::vector<int>& changed) const {
  add_to(matrix, stiffened_, changed);
}

template <int dim>
void ContactForces<dim>::add_to(StiffnessMatrix<dim>& matrix, const std::vector<Stiffening>& springs,
                                std::vector<int>& changed) const {
  std::vector<PointSpring<dim>> selected;
  for (const auto& [i, by] : springs) {
    const auto& [bond, g, stiffness, in_tangent] = contacts_[i];
    if (!matrix.selects(bond.xi)) continue;
    selected.push_back({{bond.first_element, bond.second_element},
                        bond.first_end,
                        bond.second_end,
                        matrix.selection().scale * by * g * g.transpose()});
  }
  add_springs(model_, selected, matrix, changed);
}

template class ContactForces<2>;
template class ContactForces<3>;

}  // namespace perimorph::operators
