#include "file_layout.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

#include "own_nodes.hpp"
#include "perimorph/output/field_series.hpp"

namespace perimorph::output {

using base::GlobalId;
using fracture::Body;

namespace {

constexpr const char* broken_surface_name = "broken_surface";  // a side set

constexpr const char* kind_names[] = {"FE", "MORPH", "PD", "DGFE"};

/// An element as it travels to rank 0, or into a file.
struct ElementRecord {
  GlobalId id;
  GlobalId nodes[mesh::max_corners];
  int block, kind;
  mesh::ElementType type;
};

/// Sets of sides by name.
using SideSets = std::map<std::string, std::vector<mesh::Side>>;

/// What elements of one block of a file have in common; blocks come in this order.
struct BlockKey {
  int block, kind;
  mesh::ElementType type;
  bool operator<(const BlockKey& other) const {
    return std::tie(block, kind, type) < std::tie(other.block, other.kind, other.type);
  }
};

template <int dim>
std::vector<ElementRecord> own_elements(const Body<dim>& body) {
  std::vector<ElementRecord> records;
  const auto& mesh = body.mesh();
  const auto model = body.model();
  for (int e = 0; e < mesh.n_owned_elements; ++e) {
    ElementRecord record{mesh.element_ids[e], {}, mesh.blocks[e], kind_of(body, e), mesh.types[e]};
    for (int k = 0; k < mesh.n_corners(e); ++k) record.nodes[k] = model.dofs.global_node(model.dofs.nodes_of(e)[k]);
    records.push_back(record);
  }
  return records;
}

BlockKey key_of(const ElementRecord& record) { return {record.block, record.kind, record.type}; }

/// Of all ranks' elements. Collective.
std::set<BlockKey> all_keys(const base::Comm& comm, const std::vector<ElementRecord>& own) {
  std::set<BlockKey> keys;
  for (const auto& record : own) keys.insert(key_of(record));
  const auto all = base::gather_on_all(comm, std::vector<BlockKey>(keys.begin(), keys.end()));
  return {all.begin(), all.end()};
}

/// The type of each block's elements; of several the first.
std::map<int, mesh::ElementType> first_types(const std::set<BlockKey>& keys) {
  std::map<int, mesh::ElementType> types;
  for (const auto& key : keys) {
    auto& type = types.try_emplace(key.block, key.type).first->second;
    type = std::min(type, key.type);
  }
  return types;
}

/// Blocks by material, class and type, elements in each by id. Returns each record's place in the file. A block's name
/// and id depend on these three only, not on the topology: 11, 12, 13, 14 are FE to DGFE of the mesh's first block, 21
/// to 24 of its second. Elements of other types than a block's first are in blocks of their own, numbered after all
/// these.
template <int dim>
std::vector<int> sort_into_blocks(const std::vector<ElementRecord>& records, const std::set<BlockKey>& keys,
                                  const std::vector<std::string>& block_names, io::ExodusModel<dim>& model) {
  const auto types = first_types(keys);
  std::map<BlockKey, std::size_t> block_of;
  for (const auto& key : keys) {
    PERIMORPH_ASSERT(key.block >= 0 && key.block < static_cast<int>(block_names.size()), "block {} of {}", key.block,
                     block_names.size());
    const int other_type = static_cast<int>(key.type) - static_cast<int>(types.at(key.block));
    const int id = 10 * (other_type * static_cast<int>(block_names.size()) + key.block + 1) + key.kind + 1;
    std::string name = block_names[key.block] + "_" + kind_names[key.kind];
    if (other_type > 0) name += "_" + mesh::exodus_name(key.type);
    block_of[key] = model.blocks.size();
    model.blocks.push_back({name, key.type, {}, {}, id});
  }
  std::vector<int> order(records.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    const auto &a = records[i], &b = records[j];
    return std::tie(a.block, a.kind, a.type, a.id) < std::tie(b.block, b.kind, b.type, b.id);
  });
  std::vector<int> place(records.size());
  for (std::size_t position = 0; position < order.size(); ++position) {
    const auto& record = records[order[position]];
    place[order[position]] = static_cast<int>(position);
    auto& block = model.blocks[block_of.at(key_of(record))];
    block.element_ids.push_back(record.id);
    for (int k = 0; k < mesh::n_corners(record.type); ++k)
      block.connectivity.push_back(static_cast<int>(record.nodes[k]));
  }
  return place;
}

/// By place in the file, whatever the ranks.
void sort_sides(std::vector<mesh::Side>& sides) {
  std::sort(sides.begin(), sides.end(), [](const mesh::Side& a, const mesh::Side& b) {
    return std::tie(a.element, a.side) < std::tie(b.element, b.side);
  });
}

/// The mesh's, and the surface of its cracks.
template <int dim>
SideSets side_sets(const mesh::Mesh<dim>& mesh, const std::vector<mesh::Side>& broken_surface) {
  SideSets sets;
  for (const auto& [name, sides] : mesh.side_sets) sets[name_in_results(name)] = sides;
  sets[broken_surface_name] = broken_surface;
  return sets;
}

/// Groups of own nodes and of own elements' sides, gathered on rank 0.
template <int dim>
void gather_groups(const base::Comm& comm, const Body<dim>& body, const SideSets& side_sets,
                   const std::map<GlobalId, int>& place_of, io::ExodusModel<dim>& model) {
  const auto view = body.model();
  for (const auto& [name, reference_nodes] : body.mesh().node_sets) {
    std::vector<int> own;
    for (const int n : own_nodes_in(body, reference_nodes)) own.push_back(static_cast<int>(view.dofs.global_node(n)));
    model.node_sets[name] = base::gather_on_root(comm, own);
  }
  struct SideRecord {
    GlobalId element;
    int side;
  };
  for (const auto& [name, sides] : side_sets) {
    std::vector<SideRecord> own;
    for (const auto& side : sides) {
      if (side.element < body.mesh().n_owned_elements)
        own.push_back({body.mesh().element_ids[side.element], side.side});
    }
    auto& all = model.side_sets[name];
    for (const auto& record : base::gather_on_root(comm, own))
      all.push_back({place_of.at(record.element), record.side});
    sort_sides(all);
  }
}

template <int dim>
std::vector<base::Point<dim>> own_coordinates(const Body<dim>& body) {
  const auto model = body.model();
  std::vector<base::Point<dim>> own;
  for (int n = 0; n < model.dofs.n_owned_nodes(); ++n)
    own.push_back(model.mesh.coordinates[model.dofs.reference_node(n)]);
  return own;
}

/// All ranks' points on rank 0. They travel as numbers: Eigen's vectors are not trivially copyable.
template <int dim>
std::vector<base::Point<dim>> gather_points(const base::Comm& comm, const std::vector<base::Point<dim>>& own) {
  std::vector<double> flat;
  for (const auto& x : own) flat.insert(flat.end(), x.begin(), x.end());
  const auto all = base::gather_on_root(comm, flat);
  std::vector<base::Point<dim>> points;
  for (std::size_t i = 0; i < all.size(); i += dim)
    points.push_back(Eigen::Map<const base::Point<dim>>(all.data() + i));
  return points;
}

/// Local nodes of the elements that this rank owns, by ascending global number.
template <int dim>
std::vector<int> nodes_of_own_elements(const Body<dim>& body) {
  const auto model = body.model();
  std::map<GlobalId, int> nodes;
  for (int e = 0; e < body.mesh().n_owned_elements; ++e) {
    for (int k = 0; k < body.mesh().n_corners(e); ++k) {
      const int node = model.dofs.nodes_of(e)[k];
      nodes[model.dofs.global_node(node)] = node;
    }
  }
  std::vector<int> ordered;
  for (const auto& [id, node] : nodes) ordered.push_back(node);
  return ordered;
}

/// The groups within one rank's part. @param nodes its nodes; @param place of own elements
template <int dim>
void take_own_groups(const Body<dim>& body, const SideSets& side_sets, const std::vector<int>& nodes,
                     const std::vector<int>& place, io::ExodusModel<dim>& model) {
  const auto& dofs = body.model().dofs;
  for (const auto& [name, reference_nodes] : body.mesh().node_sets) {
    auto& members = model.node_sets[name];
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (std::binary_search(reference_nodes.begin(), reference_nodes.end(), dofs.reference_node(nodes[n])))
        members.push_back(static_cast<int>(n));
    }
  }
  for (const auto& [name, sides] : side_sets) {
    auto& members = model.side_sets[name];
    for (const auto& side : sides) {
      if (side.element < body.mesh().n_owned_elements) members.push_back({place[side.element], side.side});
    }
    sort_sides(members);
  }
}

}  // namespace

std::string name_in_results(const std::string& side_set) {
  return side_set == broken_surface_name ? side_set + "_of_mesh" : side_set;
}

template <int dim>
int kind_of(const Body<dim>& body, int element) {
  const auto& topology = body.topology();
  return topology.discontinuous()[element] != 0 ? 3 : static_cast<int>(topology.classes()[element]);
}

template <int dim>
FileLayout<dim> gathered_layout(const base::Comm& comm, const Body<dim>& body,
                                const std::vector<mesh::Side>& broken_surface) {
  FileLayout<dim> layout;
  auto& model = layout.model;
  const auto own = own_elements(body);
  const auto keys = all_keys(comm, own);
  layout.nodes.resize(body.topology().dofs().n_owned_nodes());
  std::iota(layout.nodes.begin(), layout.nodes.end(), 0);
  model.coordinates = gather_points<dim>(comm, own_coordinates(body));
  const auto records = base::gather_on_root(comm, own);
  if (comm.getRank() == 0) layout.element_place = sort_into_blocks(records, keys, body.mesh().block_names, model);
  std::map<GlobalId, int> place_of;
  for (std::size_t i = 0; i < records.size(); ++i) place_of[records[i].id] = layout.element_place[i];
  gather_groups(comm, body, side_sets(body.mesh(), broken_surface), place_of, model);
  return layout;
}

template <int dim>
FileLayout<dim> spread_layout(const base::Comm& comm, const Body<dim>& body,
                              const std::vector<mesh::Side>& broken_surface) {
  FileLayout<dim> layout;
  auto& model = layout.model;
  auto own = own_elements(body);
  const auto keys = all_keys(comm, own);
  const auto& dofs = body.topology().dofs();
  layout.nodes = nodes_of_own_elements(body);
  for (const int node : layout.nodes) {
    model.coordinates.push_back(body.mesh().coordinates[dofs.reference_node(node)]);
    model.node_ids.push_back(dofs.global_node(node));
  }
  for (auto& record : own) {
    for (int k = 0; k < mesh::n_corners(record.type); ++k) {
      const auto found = std::lower_bound(model.node_ids.begin(), model.node_ids.end(), record.nodes[k]);
      record.nodes[k] = found - model.node_ids.begin();
    }
  }
  layout.element_place = sort_into_blocks(own, keys, body.mesh().block_names, model);
  take_own_groups(body, side_sets(body.mesh(), broken_surface), layout.nodes, layout.element_place, model);
  return layout;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                               \
  template int kind_of(const Body<dim>&, int);                                                                   \
  template FileLayout<dim> gathered_layout(const base::Comm&, const Body<dim>&, const std::vector<mesh::Side>&); \
  template FileLayout<dim> spread_layout(const base::Comm&, const Body<dim>&, const std::vector<mesh::Side>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::output
