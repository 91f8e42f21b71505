#include "perimorph/operators/contact_forces.hpp"

#include "at_points.hpp"
#include "perimorph/base/errors.hpp"
#include "point_springs.hpp"

namespace perimorph::operators {

using base::Point;

namespace {

/// How far the faces had slid where a bond was, when that was last accepted.
template <int dim>
Point<dim> accepted_slip(const discretization::Topology<dim>& topology, const bonds::Bond<dim>& bond) {
  const auto found = topology.slips().find(bonds::ends_of(bond));
  return found == topology.slips().end() ? Point<dim>::Zero() : found->second.distance;
}

}  // namespace

template <int dim>
ContactForces<dim>::ContactForces(const CoupledModel<dim>& model, const discretization::Topology<dim>& topology,
                                  double friction)
    : model_(model), topology_(topology), friction_(friction), normals_(model, topology) {
  PERIMORPH_ASSERT(friction >= 0., "a coefficient of friction of {}", friction);
  const auto add = [&](const bonds::Bond<dim>& bond) { this->add(bond); };
  model_.bonds.for_each_bond(add);
  for (const auto& bond : topology.bonds_across_faces()) add(bond);
}

template <int dim>
void ContactForces<dim>::add(const bonds::Bond<dim>& bond) {
  if (model_.share_lost(bond) == 0.) return;
  const Point n = normals_.across(bond);
  Contact contact{bond, bond.xi.dot(n) * n, 0., 0., accepted_slip(topology_, bond)};
  set_stiffness(contact);
  if (model_.bonds.softens() && bond.id < model_.bonds.n_bonds()) place_of_[bond.id] = contacts_.size();
  contacts_.push_back(contact);
}

/// As a bond may never have been, its stiffness follows from its points. kappa / mu of a material is its factor of
/// dilatation times 2 (dim + 2) / dim, and (lambda + 2 mu) / (3 mu) is 1 + kappa / (3 mu).
template <int dim>
void ContactForces<dim>::set_stiffness(Contact& contact) const {
  const auto& bond = contact.bond;
  const auto mean = [](double one, double other) { return 0.5 * (one + other); };
  const double c0 = model_.bonds.materials().stiffness(bond.first_element, bond.second_element, bond.xi.norm());
  const double lost = model_.share_lost(bond) * c0 *
                      mean(model_.alpha(bond.first_point), model_.alpha(bond.second_point)) *
                      model_.points.weight(bond.first_point) * model_.points.weight(bond.second_point);
  const double factor = mean(model_.elasticity.dilatation_factor(bond.first_element),
                             model_.elasticity.dilatation_factor(bond.second_element));
  contact.along_normal = lost * (1. + factor * 2. * (dim + 2.) / (3. * dim));
  contact.along_faces = friction_ == 0. ? 0. : lost * contact.g.squaredNorm();
}

/// How eta changes.
template <int dim>
Point<dim> ContactForces<dim>::opening(const Contact& contact, base::ConstField x) const {
  const auto& bond = contact.bond;
  return displacement_at(model_, x, bond.second_element, bond.second_end) -
         displacement_at(model_, x, bond.first_element, bond.first_end);
}

/// eta, without what the eigenstrain makes of xi.
template <int dim>
Point<dim> ContactForces<dim>::relative_displacement(const Contact& contact, base::ConstField u) const {
  if (model_.eigenstrain == nullptr) return opening(contact, u);
  return opening(contact, u) - contact.bond.mean_of(model_.eigenstrain->at_points()) * contact.bond.xi;
}

template <int dim>
typename ContactForces<dim>::Response ContactForces<dim>::response(const Contact& contact, const Point& eta) const {
  Response response;
  const double elongation = contact.g.dot(eta), squared = contact.g.squaredNorm();
  response.is_closed = elongation < 0.;
  if (friction_ > 0. && squared > 0.) response.sliding = eta - elongation / squared * contact.g;
  if (!response.is_closed) return response;
  response.normal = contact.along_normal * elongation * contact.g;
  if (friction_ == 0.) return response;
  response.friction = contact.along_faces * (response.sliding - contact.slip);
  const double largest = friction_ * response.normal.norm(), trial = response.friction.norm();
  response.slides = trial > largest;
  if (response.slides) response.friction *= largest / trial;
  return response;
}

/// k g (x) g, and along the faces k_t where they stick; where they slide, across the friction as stiff as its size
/// says.
template <int dim>
typename ContactForces<dim>::Block ContactForces<dim>::tangent(const Contact& contact, const Response& response) const {
  if (!response.is_closed) return Block::Zero();
  Block block = contact.along_normal * contact.g * contact.g.transpose();
  if (friction_ == 0. || contact.g.squaredNorm() == 0.) return block;
  const Point n = contact.g.normalized();
  Block along_faces = Block::Identity() - n * n.transpose();
  if (response.slides) {
    const Point trial = contact.along_faces * (response.sliding - contact.slip), direction = trial.normalized();
    along_faces -= direction * direction.transpose();
    along_faces *= response.friction.norm() / trial.norm();
  }
  return block + contact.along_faces * along_faces;
}

template <int dim>
void ContactForces<dim>::hold(const Contact& contact, const Point& on_second, base::Field force) const {
  const auto& bond = contact.bond;
  spread<dim>(model_, bond.first_element, bond.first_end, -on_second, force);
  spread<dim>(model_, bond.second_element, bond.second_end, on_second, force);
}

template <int dim>
void ContactForces<dim>::add_force(base::ConstField u, base::Field force) const {
  PERIMORPH_ASSERT(u.size() == force.size(), "{} displacements, {} forces", u.size(), force.size());
  for (const auto& contact : contacts_) {
    const auto now = response(contact, relative_displacement(contact, u));
    if (now.is_closed) hold(contact, now.normal + now.friction, force);
  }
}

template <int dim>
void ContactForces<dim>::prepare_tangent(base::ConstField u) {
  stiffened_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    auto& contact = contacts_[i];
    const Block wanted = tangent(contact, response(contact, relative_displacement(contact, u)));
    if (wanted == contact.in_tangent) continue;
    stiffened_.push_back({i, wanted - contact.in_tangent});
    contact.in_tangent = wanted;
  }
}

template <int dim>
std::vector<StiffenedBond<dim>> ContactForces<dim>::stiffened() const {
  std::vector<StiffenedBond<dim>> bonds;
  for (const auto& [i, by] : stiffened_) bonds.push_back({contacts_[i].bond, by});
  return bonds;
}

template <int dim>
void ContactForces<dim>::add_tangent_product(base::ConstField x, base::Field force) const {
  PERIMORPH_ASSERT(x.size() == force.size(), "{} displacements, {} forces", x.size(), force.size());
  for (const auto& contact : contacts_) add_tangent_product(contact, x, force);
}

template <int dim>
void ContactForces<dim>::add_tangent_product(const Contact& contact, base::ConstField x, base::Field force) const {
  if (!contact.in_tangent.isZero(0.)) hold(contact, contact.in_tangent * opening(contact, x), force);
}

/// Those of a part's elements, with the springs that the whole has.
template <int dim>
class ContactForces<dim>::Within : public ForceTerm<dim> {
 public:
  Within(const ContactForces& whole, MeshPart part) : whole_(whole), part_(std::move(part)) { find(); }

  void add_force(base::ConstField /*u*/, base::Field /*force*/) const override {}
  void add_tangent_product(base::ConstField x, base::Field force) const override {
    for (const auto i : mine_) whole_.add_tangent_product(whole_.contacts_[i], x, force);
  }
  void take(const bonds::BondChange& /*change*/) override { find(); }
  void add_to(StiffnessMatrix<dim>& /*matrix*/) const override {}
  double energy(base::ConstField /*u*/) const override { return 0.; }
  std::size_t bytes() const override { return mine_.size() * sizeof(std::size_t); }

 private:
  const ContactForces& whole_;
  MeshPart part_;
  std::vector<std::size_t> mine_;
  std::size_t n_seen_ = 0;

  void find() {
    for (; n_seen_ < whole_.contacts_.size(); ++n_seen_) {
      const auto& bond = whole_.contacts_[n_seen_].bond;
      if (part_.holds_element(bond.first_element) || part_.holds_element(bond.second_element)) mine_.push_back(n_seen_);
    }
  }
};

template <int dim>
Teuchos::RCP<ForceTerm<dim>> ContactForces<dim>::within(const MeshPart& part) const {
  return Teuchos::rcp(new Within(*this, part));
}

template <int dim>
void ContactForces<dim>::add_load_derivative(base::Field force) const {
  if (model_.eigenstrain == nullptr) return;
  const auto rates = model_.eigenstrain->rates(0.);
  for (const auto& contact : contacts_) {
    hold(contact, contact.in_tangent * (-contact.bond.mean_of(rates) * contact.bond.xi), force);
  }
}

template <int dim>
void ContactForces<dim>::add_confinement(base::ConstField u, base::Field at_points) const {
  for (const auto& spring : closed(u)) {
    const double of_each_end = -0.5 * spring.pull.dot(spring.bond.xi);
    at_points[spring.bond.first_point] += of_each_end;
    at_points[spring.bond.second_point] += of_each_end;
  }
}

/// A bond that softens changes what is known of it, or becomes known, as one that breaks does.
template <int dim>
void ContactForces<dim>::take(const bonds::BondChange& change) {
  const auto take = [&](const bonds::Bond<dim>& bond) {
    const auto known = place_of_.find(bond.id);
    if (known == place_of_.end()) return add(bond);
    contacts_[known->second].bond = bond;
    set_stiffness(contacts_[known->second]);
  };
  for (const auto id : change.broken) take(model_.bonds.bond(id));
  for (const auto& softened : change.softened) take(model_.bonds.bond(softened.id));
}

template <int dim>
std::vector<ContactSpring<dim>> ContactForces<dim>::closed(base::ConstField u) const {
  std::vector<ContactSpring<dim>> springs;
  for (const auto& contact : contacts_) {
    const Point eta = relative_displacement(contact, u);
    const auto now = response(contact, eta);
    if (!now.is_closed) continue;
    const double slid = now.friction.isZero(0.) ? 0.
                                                : 0.5 * now.friction.dot(now.sliding) -
                                                      0.5 * now.friction.squaredNorm() / contact.along_faces;
    springs.push_back(
        {contact.bond, now.normal + now.friction, 0.5 * (now.normal + now.friction).dot(eta) - slid, slid});
  }
  return springs;
}

template <int dim>
double ContactForces<dim>::energy(base::ConstField u) const {
  double energy = 0.;
  for (const auto& spring : closed(u)) {
    if (spring.bond.first_element < model_.mesh.n_owned_elements) energy += spring.energy;
  }
  return energy;
}

template <int dim>
bonds::Slips<dim> ContactForces<dim>::slips(base::ConstField u) const {
  bonds::Slips<dim> slips;
  if (friction_ == 0.) return slips;
  for (const auto& contact : contacts_) {
    const auto now = response(contact, relative_displacement(contact, u));
    Point distance = contact.slip;
    if (!now.is_closed) distance = now.sliding;
    if (now.slides) distance = now.sliding - now.friction / contact.along_faces;
    slips[bonds::ends_of(contact.bond)] = {distance, now.friction};
  }
  return slips;
}

template <int dim>
void ContactForces<dim>::follow_slips() {
  for (auto& contact : contacts_) contact.slip = accepted_slip(topology_, contact.bond);
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
    if (!contacts_[i].in_tangent.isZero(0.)) all.push_back({i, contacts_[i].in_tangent});
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
    const auto& bond = contacts_[i].bond;
    if (!matrix.selects(bond.xi)) continue;
    selected.push_back(
        {{bond.first_element, bond.second_element}, bond.first_end, bond.second_end, matrix.selection().scale * by});
  }
  add_springs(model_, selected, matrix, changed);
}

template class ContactForces<2>;
template class ContactForces<3>;

}  // namespace perimorph::operators
