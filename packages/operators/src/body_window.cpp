#include "perimorph/operators/body_window.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Operator.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <utility>

#include "at_points.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/point_tree.hpp"

namespace perimorph::operators {

namespace {

using Map = Tpetra::Map<>;

/// A mark on owned nodes as it is on all local ones, on those that hang on marked ones, and on images. Collective.
template <int dim>
std::vector<char> on_all_nodes(const WindowSource<dim>& source, const std::vector<int>& marked) {
  const auto& dofs = source.model.dofs;
  Tpetra::Vector<double> owned(dofs.owned_dofs()), all(dofs.all_dofs());
  for (const int node : marked) owned.replaceLocalValue(node * dim, 1.);
  all.doImport(owned, *dofs.import(), Tpetra::INSERT);
  const auto values = all.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<char> marks(dofs.n_nodes(), 0);
  for (int node = 0; node < dofs.n_real_nodes(); ++node) marks[node] = static_cast<char>(values(node * dim, 0) != 0.);
  for (const auto& [node, parents] : source.space.hanging_nodes().ties()) {
    if (std::any_of(parents.begin(), parents.end(), [&](int parent) { return marks[parent] != 0; })) marks[node] = 1;
  }
  for (int node = dofs.n_real_nodes(); node < dofs.n_nodes(); ++node) marks[node] = marks[dofs.image(node).node];
  return marks;
}

/// Owned nodes of some elements, ascending, but for those of groups, which move with nodes elsewhere.
template <int dim>
std::vector<int> nodes_of(const WindowSource<dim>& source, const std::vector<char>& elements) {
  const auto& mesh = source.model.mesh;
  const auto& dofs = source.model.dofs;
  std::vector<char> is_theirs(dofs.n_nodes(), 0);
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if (elements[e] == 0) continue;
    for (int k = 0; k < mesh.n_corners(e); ++k) is_theirs[dofs.nodes_of(e)[k]] = 1;
  }
  for (const int dof : source.space.groups().dofs()) is_theirs[dof / dim] = 0;
  for (const auto& tie : source.space.hanging_nodes().ties()) is_theirs[tie.node] = 0;
  std::vector<int> nodes;
  for (int node = 0; node < dofs.n_owned_nodes(); ++node) {
    if (is_theirs[node] != 0) nodes.push_back(node);
  }
  return nodes;
}

template <int dim>
void append_dofs(int node, std::vector<int>& dofs) {
  for (int c = 0; c < dim; ++c) dofs.push_back(node * dim + c);
}

}  // namespace

template <int dim>
class BodyWindow<dim>::Tangent : public Tpetra::Operator<double> {
 public:
  using MultiVector = Tpetra::MultiVector<double>;
  explicit Tangent(const BodyWindow& window) : window_(window) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return window_.unknowns_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return window_.unknowns_; }

  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp /*mode*/, double alpha,
             double beta) const override {
    PERIMORPH_ASSERT(&x != &y, "the result would replace the argument while it is read");
    for (std::size_t column = 0; column < x.getNumVectors(); ++column) {
      const auto own_x = x.getVector(column)->getLocalViewHost(Tpetra::Access::ReadOnly);
      {
        const auto all = window_.on_all_->getLocalViewHost(Tpetra::Access::ReadWrite);
        for_each_unknown([&](int dof, int place) { all(dof, 0) = own_x(place, 0); });
      }
      window_.add_products_of(*window_.on_all_);
      const auto own_y = y.getVectorNonConst(column)->getLocalViewHost(Tpetra::Access::ReadWrite);
      for_each_unknown([&](int dof, int place) {
        const double result = alpha * window_.forces_[dof];
        own_y(place, 0) = beta == 0. ? result : beta * own_y(place, 0) + result;
      });
      for (const auto& [place, stiffness] : window_.held_) own_y(place, 0) += alpha * stiffness * own_x(place, 0);
    }
  }

 private:
  const BodyWindow& window_;

  template <class Visit>
  void for_each_unknown(Visit visit) const {
    int place = 0;
    for (const int node : window_.nodes_) {
      for (int c = 0; c < dim; ++c) visit(node * dim + c, place++);
    }
  }
};

template <int dim>
BodyWindow<dim>::BodyWindow(const WindowSource<dim>& source, const std::vector<char>& elements,
                            ChangedBonds<dim>& changed)
    : model_(source.model), space_(source.space), changed_(changed) {
  const auto& [model, space, exchange, terms, constraints, basis] = source;
  const auto& dofs = model.dofs;
  nodes_ = nodes_of(source, elements);
  unknowns_ = Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), nodes_.size() * dim, 0,
                                   dofs.owned_dofs()->getComm()));
  for (std::size_t i = 0; i < nodes_.size() * dim; ++i) {
    const double stiffness = constraints[nodes_[i / dim] * dim + i % dim];
    if (stiffness != 0.) held_.emplace_back(i, stiffness);
  }
  if (basis != nullptr) basis_ = Teuchos::rcp(new PointBasis<dim>(basis->within(nodes_, unknowns_)));
  const auto part = part_around(source);
  for (const auto& term : terms) {
    if (const auto here = term->within(part); !here.is_null()) terms_.push_back(here);
  }
  find_touched(source, part);
}

template <int dim>
BodyWindow<dim>::~BodyWindow() = default;

/// The elements that its nodes deform, and with dilatation those that have bonds with them, whose dilatation changes.
template <int dim>
MeshPart BodyWindow<dim>::part_around(const WindowSource<dim>& source) const {
  const auto& mesh = source.model.mesh;
  const auto& dofs = source.model.dofs;
  const auto& bonds = source.model.bonds;
  MeshPart part{std::vector<char>(mesh.n_elements(), 0), on_all_nodes(source, nodes_)};
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const int* corners = dofs.nodes_of(e);
    part.elements[e] = static_cast<char>(
        std::any_of(corners, corners + mesh.n_corners(e), [&](int node) { return part.nodes[node] != 0; }));
  }
  if (source.model.has_dilatation()) {
    const auto deformed = part.elements;
    for (int e = 0; e < mesh.n_owned_elements; ++e) {
      const auto& pairs = bonds.pairs_of(e);
      if (std::any_of(pairs.begin(), pairs.end(), [&](int p) {
            return deformed[bonds.pair(p).first] != 0 || deformed[bonds.pair(p).second] != 0;
          })) {
        part.elements[e] = 1;
      }
    }
    source.element_exchange.update(part.elements);
  }
  return part;
}

template <int dim>
void BodyWindow<dim>::find_touched(const WindowSource<dim>& source, const MeshPart& part) {
  const auto& mesh = source.model.mesh;
  const auto& dofs = source.model.dofs;
  const auto& bonds = source.model.bonds;
  std::vector<char> is_touched(dofs.n_nodes(), 0);
  const auto touch = [&](int e) {
    for (int k = 0; k < mesh.n_corners(e); ++k) is_touched[dofs.nodes_of(e)[k]] = 1;
  };
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if (part.elements[e] == 0) continue;
    touch(e);
    for (const int p : bonds.pairs_of(e)) {
      touch(bonds.pair(p).first);
      touch(bonds.pair(p).second);
    }
  }
  for (const int dof : space_.groups().dofs()) is_touched[dof / dim] = 1;  // which move with each other
  for (const auto& [node, parents] : space_.hanging_nodes().ties()) {
    for (const int parent : parents) is_touched[parent] = static_cast<char>(is_touched[parent] | is_touched[node]);
  }
  for (int node = dofs.n_real_nodes(); node < dofs.n_nodes(); ++node) {
    if (is_touched[node] != 0) is_touched[dofs.image(node).node] = 1;
  }
  std::vector<base::GlobalId> numbers;
  for (int node = 0; node < dofs.n_nodes(); ++node) {
    if (is_touched[node] == 0) continue;
    append_dofs<dim>(node, touched_);
    if (node < dofs.n_owned_nodes()) append_dofs<dim>(node, reached_);
    for (int c = 0; c < dim && node < dofs.n_real_nodes(); ++c) numbers.push_back(dofs.global_node(node) * dim + c);
  }
  const auto around =
      Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                           Teuchos::ArrayView<const base::GlobalId>(numbers.data(), static_cast<int>(numbers.size())),
                           0, dofs.owned_dofs()->getComm()));
  import_ = Teuchos::rcp(new Tpetra::Import<>(dofs.owned_dofs(), around));
  around_ = Teuchos::rcp(new Vector(around));
  on_all_ = Teuchos::rcp(new Vector(dofs.owned_dofs()));
  x_.assign(space_.n_local(), 0.);
  forces_.assign(space_.n_local(), 0.);
}

template <int dim>
Teuchos::RCP<typename BodyWindow<dim>::Operator> BodyWindow<dim>::tangent() const {
  return Teuchos::rcp(new Tangent(*this));
}

/// From the unknowns to the elements that take part.
template <int dim>
void BodyWindow<dim>::bring(const Vector& x) const {
  around_->doImport(x, *import_, Tpetra::INSERT);
  const auto values = around_->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < values.extent(0); ++i) x_[touched_[i]] = values(i, 0);
  for (const int dof : touched_) forces_[dof] = 0.;
  space_.complete_change(base::field(x_));
}

template <int dim>
void BodyWindow<dim>::add_products_of(const Vector& x) const {
  bring(x);
  for (const auto& term : terms_) term->add_tangent_product(base::field(x_), base::field(forces_));
  space_.restrict_forces(base::field(forces_));
}

template <int dim>
std::vector<double> BodyWindow<dim>::product_in_reach(const Vector& x) const {
  add_products_of(x);
  std::vector<double> forces;
  for (const int dof : reached_) forces.push_back(forces_[dof]);
  return forces;
}

template <int dim>
Window::Forces BodyWindow<dim>::product(const Vector& x) const {
  return {reached_, product_in_reach(x)};
}

template <int dim>
std::vector<int> BodyWindow<dim>::dofs_of_changed() const {
  std::vector<int> nodes, dofs;
  for (const auto& [bond, by] : changed_.bonds) {
    for (const int e : {bond.first_element, bond.second_element}) {
      const int* corners = model_.dofs.nodes_of(e);
      std::copy_if(corners, corners + model_.mesh.n_corners(e), std::back_inserter(nodes),
                   [&](int node) { return node < model_.dofs.n_owned_nodes(); });
    }
  }
  for (const int dof : space_.groups().owned_dofs()) nodes.push_back(dof / dim);  // which get each other's forces
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const int node : nodes) append_dofs<dim>(node, dofs);
  return dofs;
}

template <int dim>
std::vector<Window::Forces> BodyWindow<dim>::changes(const std::vector<Teuchos::RCP<const Vector>>& fields) {
  std::vector<Forces> all;
  const bool by_springs = changes_are_springs();
  const auto dofs = by_springs ? dofs_of_changed() : reached_;
  for (std::size_t field = 0; field < fields.size(); ++field) {
    all.push_back({dofs, {}});
    if (by_springs) {
      bring(*fields[field]);
      for (const auto& [bond, by] : changed_.bonds) {
        const base::Point<dim> eta = displacement_at(model_, base::field(x_), bond.second_element, bond.second_end) -
                                     displacement_at(model_, base::field(x_), bond.first_element, bond.first_end);
        const base::Point<dim> pull = by * eta;
        spread<dim>(model_, bond.second_element, bond.second_end, pull, base::field(forces_));
        spread<dim>(model_, bond.first_element, bond.first_end, -pull, base::field(forces_));
      }
      space_.restrict_forces(base::field(forces_));
      for (const int dof : dofs) all.back().values.push_back(forces_[dof]);
    } else {
      const auto now = product_in_reach(*fields[field]);
      for (std::size_t i = 0; i < now.size(); ++i) all.back().values.push_back(now[i] - products_[field][i]);
      products_[field] = now;
    }
  }
  changed_ = {};
  return all;
}

template <int dim>
void BodyWindow<dim>::note_field(std::size_t place, const Vector& field) {
  if (changes_are_springs()) return;
  if (place >= products_.size()) products_.resize(place + 1);
  products_[place] = product_in_reach(field);
}

template <int dim>
void WindowOfBody<dim>::take(const bonds::BondChange& change, const CoupledModel<dim>& model) {
  if (options_.radius == 0. || is_too_large_) return;
  const auto note = [&](bonds::BondId id, double loss) {
    const auto bond = model.bonds.bond(id);
    this->note({bond, -loss * bond.xi * bond.xi.transpose()});
    for (const int e : {bond.first_element, bond.second_element}) {
      if (e < model.mesh.n_owned_elements) changed_.push_back(mesh::centroid(model.mesh, e));
    }
  };
  for (const auto id : change.broken) note(id, model.spring(model.bonds.bond(id)));
  for (const auto& [id, stretch, loss] : change.softened) note(id, loss * model.intact_spring(model.bonds.bond(id)));
  if (window_ != nullptr) window_->take(change);
}

template <int dim>
void WindowOfBody<dim>::note(const StiffenedBond<dim>& changed) {
  if (window_ == nullptr) {
    changed_bonds_.are_all = false;
  } else {
    changed_bonds_.bonds.push_back(changed);
  }
}

template <int dim>
void WindowOfBody<dim>::take(const std::vector<StiffenedBond<dim>>& stiffened) {
  for (const auto& bond : stiffened) note(bond);
}

/// On all ranks.
template <int dim>
std::vector<base::Point<dim>> WindowOfBody<dim>::take_changed(const base::Comm& comm) {
  std::vector<double> own;
  for (const auto& x : changed_) own.insert(own.end(), x.data(), x.data() + dim);
  changed_.clear();
  const auto numbers = base::gather_on_all(comm, own);
  auto all = std::exchange(expected_, {});
  for (std::size_t i = 0; i < numbers.size(); i += dim) all.push_back(Eigen::Map<const base::Point<dim>>(&numbers[i]));
  const auto less = [](const auto& one, const auto& other) {
    return std::lexicographical_compare(one.data(), one.data() + dim, other.data(), other.data() + dim);
  };
  std::sort(all.begin(), all.end(), less);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

template <int dim>
std::shared_ptr<Window> WindowOfBody<dim>::find(const WindowSource<dim>& source) {
  constexpr double margin = 0.4;  // of the radius, which a window must reach beyond what has changed
  const auto& mesh = source.model.mesh;
  const auto& dofs = source.model.dofs;
  if (options_.radius == 0. || is_too_large_) return nullptr;
  const auto& comm = *dofs.owned_dofs()->getComm();
  auto changed = take_changed(comm);
  if (changed.empty()) return window_;
  const auto anything = [](int) { return true; };
  if (window_ != nullptr) {
    const base::PointTree<dim> tree(centers_);
    const bool serves = std::all_of(changed.begin(), changed.end(), [&](const auto& x) {
      return tree.any_within(x, (1. - margin) * options_.radius, anything);
    });
    if (serves) return window_;
  }
  centers_ = changed;
  window_ = nullptr;
  const base::PointTree<dim> tree(std::move(changed));
  std::vector<char> elements(mesh.n_elements(), 0);
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const int real = mesh.is_image(e) ? mesh.image(e).element : e;
    elements[e] = static_cast<char>(tree.any_within(mesh::centroid(mesh, real), options_.radius, anything));
  }
  const auto n_nodes = base::sum(comm, static_cast<base::GlobalId>(nodes_of(source, elements).size()));
  is_too_large_ = static_cast<double>(n_nodes) > options_.largest_share * static_cast<double>(dofs.n_global_nodes());
  if (is_too_large_) {
    changed_bonds_ = {{}, false};
  } else {
    window_ = std::make_shared<BodyWindow<dim>>(source, elements, changed_bonds_);
  }
  return window_;
}

template <int dim>
void WindowOfBody<dim>::clear() {
  changed_.clear();
  expected_.clear();
  centers_.clear();
  is_too_large_ = false;
  changed_bonds_ = {};
  window_ = nullptr;
}

template class BodyWindow<2>;
template class BodyWindow<3>;
template class WindowOfBody<2>;
template class WindowOfBody<3>;

}  // namespace perimorph::operators
