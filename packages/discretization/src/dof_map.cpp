#include "perimorph/discretization/dof_map.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "perimorph/base/errors.hpp"

namespace perimorph::discretization {

using base::GlobalId;

namespace {
constexpr GlobalId not_numbered = -1;
}

template <int dim>
HaloExchange element_exchange(const base::Comm& comm, const mesh::Mesh<dim>& mesh) {
  std::vector<int> sources;
  for (const auto& image : mesh.images) sources.push_back(image.element);
  const auto n = mesh.n_real_elements();
  return {comm,
          {mesh.element_ids.begin(), mesh.element_ids.begin() + n},
          {mesh.element_owners.begin(), mesh.element_owners.begin() + n},
          std::move(sources)};
}

template <int dim>
HaloExchange corner_exchange(const base::Comm& comm, const mesh::Mesh<dim>& mesh) {
  std::vector<GlobalId> keys;
  std::vector<int> owners, sources;
  for (int e = 0; e < mesh.n_real_elements(); ++e) {
    for (int k = 0; k < mesh.n_corners(e); ++k) {
      keys.push_back(mesh.element_ids[e] * mesh::max_corners + k);
      owners.push_back(mesh.node_owners[mesh.corners_of(e)[k]]);
    }
  }
  for (const auto& image : mesh.images) {
    for (int c = mesh.first_corner[image.element]; c < mesh.first_corner[image.element + 1]; ++c) sources.push_back(c);
  }
  return {comm, keys, owners, std::move(sources)};
}

template <int dim>
DofMap<dim>::DofMap(const Teuchos::RCP<const base::Comm>& comm, const mesh::Mesh<dim>& mesh,
                    const HaloExchange& corners, const std::vector<char>& discontinuous)
    : mesh_(mesh) {
  PERIMORPH_ASSERT(static_cast<int>(discontinuous.size()) == mesh.n_elements(), "{} flags for {} elements",
                   discontinuous.size(), mesh.n_elements());
  std::vector<GlobalId> global_at_corner = number_owned(*comm, discontinuous);
  corners.update(global_at_corner);
  add_copies(global_at_corner);
  make_maps(comm);
  add_images();
  find_across_planes(discontinuous);
}

/// Numbers the nodes that this rank owns, reference node by reference node: first the one that its continuous elements
/// share, then those of its discontinuous elements. Returns the global node at each corner, where owned.
template <int dim>
std::vector<GlobalId> DofMap<dim>::number_owned(const base::Comm& comm, const std::vector<char>& discontinuous) {
  // Corners at each owned reference node, by a counting sort.
  std::vector<int> first(mesh_.n_owned_nodes + 1, 0), corner_at, element_at;
  const int n_corners = mesh_.first_corner[mesh_.n_real_elements()];
  for (int c = 0; c < n_corners; ++c) {
    if (mesh_.corners[c] < mesh_.n_owned_nodes) ++first[mesh_.corners[c] + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  corner_at.resize(first.back());
  element_at.resize(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int e = 0; e < mesh_.n_real_elements(); ++e) {
    for (int c = mesh_.first_corner[e]; c < mesh_.first_corner[e + 1]; ++c) {
      const int node = mesh_.corners[c];
      if (node >= mesh_.n_owned_nodes) continue;
      corner_at[next[node]] = c;
      element_at[next[node]++] = e;
    }
  }

  node_at_corner_.assign(mesh_.corners.size(), -1);
  for (int n = 0; n < mesh_.n_owned_nodes; ++n) {
    int shared = -1;
    for (int i = first[n]; i < first[n + 1]; ++i) {
      const bool own = discontinuous[element_at[i]];
      const int node = !own && shared >= 0 ? shared : static_cast<int>(reference_nodes_.size());
      if (node == static_cast<int>(reference_nodes_.size())) reference_nodes_.push_back(n);
      if (!own) shared = node;
      node_at_corner_[corner_at[i]] = node;
    }
  }
  n_owned_nodes_ = static_cast<int>(reference_nodes_.size());

  const GlobalId count = n_owned_nodes_;
  GlobalId end = 0;
  Teuchos::scan(comm, Teuchos::REDUCE_SUM, count, Teuchos::outArg(end));
  n_global_nodes_ = base::sum(comm, count);
  for (GlobalId id = end - count; id < end; ++id) global_nodes_.push_back(id);

  std::vector<GlobalId> global_at_corner(mesh_.corners.size(), not_numbered);
  for (std::size_t c = 0; c < global_at_corner.size(); ++c) {
    if (node_at_corner_[c] >= 0) global_at_corner[c] = global_nodes_[node_at_corner_[c]];
  }
  return global_at_corner;
}

template <int dim>
void DofMap<dim>::add_copies(const std::vector<GlobalId>& global_at_corner) {
  // Ascending global ids are grouped by owner, as Tpetra likes its column maps.
  std::vector<GlobalId> copies;
  const int n_corners = mesh_.first_corner[mesh_.n_real_elements()];
  for (int c = 0; c < n_corners; ++c) {
    if (node_at_corner_[c] < 0) copies.push_back(global_at_corner[c]);
  }
  std::sort(copies.begin(), copies.end());
  copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
  global_nodes_.insert(global_nodes_.end(), copies.begin(), copies.end());
  reference_nodes_.resize(global_nodes_.size());
  for (int c = 0; c < n_corners; ++c) {
    if (node_at_corner_[c] >= 0) continue;
    const auto copy = std::lower_bound(copies.begin(), copies.end(), global_at_corner[c]);
    node_at_corner_[c] = n_owned_nodes_ + static_cast<int>(copy - copies.begin());
    reference_nodes_[node_at_corner_[c]] = mesh_.corners[c];
  }
}

/// Of the nodes at the corners of images of elements, each once.
template <int dim>
void DofMap<dim>::add_images() {
  std::map<std::pair<int, unsigned>, int> known;  // by node and negative signs
  for (int image = mesh_.n_real_elements(); image < mesh_.n_elements(); ++image) {
    const auto& [source, signs] = mesh_.image(image);
    unsigned negative = 0;
    for (int c = 0; c < dim; ++c) negative |= static_cast<unsigned>(signs[c] < 0.) << c;
    for (int k = 0; k < mesh_.n_corners(image); ++k) {
      const int node = nodes_of(source)[k];
      const auto [entry, is_new] = known.try_emplace({node, negative}, n_nodes());
      if (is_new) {
        images_.push_back({node, signs});
        reference_nodes_.push_back(mesh_.corners_of(image)[k]);
        global_nodes_.push_back(global_nodes_[node]);
      }
      node_at_corner_[mesh_.first_corner[image] + k] = entry->second;
    }
  }
}

template <int dim>
void DofMap<dim>::find_across_planes(const std::vector<char>& discontinuous) {
  for (const auto& plane : mesh_.symmetry_planes) {
    for (int e = 0; e < mesh_.n_real_elements(); ++e) {
      if (discontinuous[e]) continue;
      for (int k = 0; k < mesh_.n_corners(e); ++k) {
        if (!std::binary_search(plane.nodes.begin(), plane.nodes.end(), mesh_.corners_of(e)[k])) continue;
        across_planes_.push_back(nodes_of(e)[k] * dim + plane.axis);
      }
    }
  }
  std::sort(across_planes_.begin(), across_planes_.end());
  across_planes_.erase(std::unique(across_planes_.begin(), across_planes_.end()), across_planes_.end());
}

template <int dim>
void DofMap<dim>::complete_images(base::Field values) const {
  PERIMORPH_ASSERT(values.size() == static_cast<base::Field::size_type>(n_nodes()) * dim, "{} values at {} nodes",
                   values.size(), n_nodes());
  for (int n = n_real_nodes(); n < n_nodes(); ++n) {
    const auto& [node, signs] = image(n);
    for (int c = 0; c < dim; ++c) values[n * dim + c] = signs[c] * values[node * dim + c];
  }
}

template <int dim>
void DofMap<dim>::make_maps(const Teuchos::RCP<const base::Comm>& comm) {
  std::vector<GlobalId> dofs;
  for (const GlobalId node : global_nodes_) {
    for (int c = 0; c < dim; ++c) dofs.push_back(node * dim + c);
  }
  const auto n_global = static_cast<Tpetra::global_size_t>(n_global_nodes_ * dim);
  owned_dofs_ = Teuchos::rcp(new Map(n_global, static_cast<std::size_t>(n_owned_nodes_ * dim), 0, comm));
  all_dofs_ = Teuchos::rcp(
      new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), Teuchos::arrayViewFromVector(dofs), 0, comm));
  import_ = Teuchos::rcp(new Import(owned_dofs_, all_dofs_));
}

template HaloExchange element_exchange<2>(const base::Comm&, const mesh::Mesh<2>&);
template HaloExchange element_exchange<3>(const base::Comm&, const mesh::Mesh<3>&);
template HaloExchange corner_exchange<2>(const base::Comm&, const mesh::Mesh<2>&);
template HaloExchange corner_exchange<3>(const base::Comm&, const mesh::Mesh<3>&);
template class DofMap<2>;
template class DofMap<3>;

}  // namespace perimorph::discretization
