#pragma once

// Writes meshes as Exodus files and ANSYS archives, for the tests of their readers.

#include <exodusII.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/mesh.hpp"

namespace perimorph::mesh_files {

struct ExodusOptions {
  int mode = EX_CLOBBER | EX_LARGE_MODEL;
  int n_dimensions = 0;                 ///< coordinates per node; 0: the mesh's dimension
  std::vector<std::string> types = {};  ///< of the blocks, if not the usual names
  int first_side = 1;                   ///< number of an element's first side in side sets
  bool named = true;                    ///< groups have names
  bool node_sets_of_side_sets = true;   ///< each side set is there as a node set, too
};

/// An Exodus file under construction.
class ExodusWriter {
 public:
  ExodusWriter(const std::string& file, int mode) {
    int word_size = sizeof(double);
    id_ = ex_create(file.c_str(), mode, &word_size, &word_size);
    check(id_);
  }
  /// Of a file that is there.
  explicit ExodusWriter(const std::string& file) {
    int word_size = sizeof(double), word_size_in_file = 0;
    float version = 0.F;
    id_ = ex_open(file.c_str(), EX_WRITE | EX_ALL_INT64_API, &word_size, &word_size_in_file, &version);
    check(id_);
  }
  ~ExodusWriter() { ex_close(id_); }
  ExodusWriter(const ExodusWriter&) = delete;
  ExodusWriter& operator=(const ExodusWriter&) = delete;
  int id() const { return id_; }
  void check(int status) const {
    if (status < 0) throw base::Bug("the test cannot write its Exodus file");
  }

 private:
  int id_;
};

template <int dim>
void put_set(const ExodusWriter& file, ex_entity_type kind, int id, const std::string& name,
             const std::vector<int>& entries, const std::vector<int>& extra) {
  file.check(ex_put_set_param(file.id(), kind, id, static_cast<int64_t>(entries.size()), 0));
  if (!name.empty()) file.check(ex_put_name(file.id(), kind, id, name.c_str()));
  if (!entries.empty())
    file.check(ex_put_set(file.id(), kind, id, entries.data(), extra.empty() ? nullptr : extra.data()));
}

template <int dim>
void put_nodes(const ExodusWriter& file, const mesh::Mesh<dim>& mesh) {
  std::vector<std::vector<double>> axes(3, std::vector<double>(mesh.coordinates.size(), 0.));
  for (std::size_t n = 0; n < mesh.coordinates.size(); ++n) {
    for (int d = 0; d < dim; ++d) axes[d][n] = mesh.coordinates[n][d];
  }
  file.check(ex_put_coord(file.id(), axes[0].data(), axes[1].data(), axes[2].data()));
}

/// Requires the elements of a block to stand beside each other and to be of one type.
template <int dim>
void put_blocks(const ExodusWriter& file, const mesh::Mesh<dim>& mesh, const ExodusOptions& options) {
  int first = 0;
  for (int block = 0; first < mesh.n_elements(); ++block) {
    std::vector<int> corners;
    int end = first;
    for (; end < mesh.n_elements() && mesh.blocks[end] == block; ++end) {
      for (int c = 0; c < mesh.n_corners(end); ++c) corners.push_back(mesh.corners_of(end)[c] + 1);
    }
    const std::string type = options.types.empty() ? exodus_name(mesh.types[first]) : options.types[block];
    const int id = 10 * (block + 1);
    file.check(ex_put_block(file.id(), EX_ELEM_BLOCK, id, type.c_str(), end - first, mesh.n_corners(first), 0, 0, 0));
    if (options.named) file.check(ex_put_name(file.id(), EX_ELEM_BLOCK, id, mesh.block_names[block].c_str()));
    file.check(ex_put_conn(file.id(), EX_ELEM_BLOCK, id, corners.data(), nullptr, nullptr));
    first = end;
  }
}

template <int dim>
void write_exodus(const mesh::Mesh<dim>& mesh, const std::string& file_name, const ExodusOptions& options = {}) {
  const ExodusWriter file(file_name, options.mode);
  std::map<std::string, std::vector<int>> node_sets;
  for (const auto& [name, nodes] : mesh.node_sets) {
    if (options.node_sets_of_side_sets || mesh.side_sets.count(name) == 0) node_sets[name] = nodes;
  }
  file.check(ex_put_init(file.id(), "a test", options.n_dimensions == 0 ? dim : options.n_dimensions, mesh.n_nodes(),
                         mesh.n_elements(), static_cast<int64_t>(mesh.block_names.size()),
                         static_cast<int64_t>(node_sets.size()), static_cast<int64_t>(mesh.side_sets.size())));
  put_nodes(file, mesh);
  put_blocks(file, mesh, options);
  int id = 0;
  for (const auto& [name, nodes] : node_sets) {
    std::vector<int> numbers;
    for (const int node : nodes) numbers.push_back(node + 1);
    put_set<dim>(file, EX_NODE_SET, ++id, options.named ? name : "", numbers, {});
  }
  id = 0;
  for (const auto& [name, sides_of_set] : mesh.side_sets) {
    std::vector<int> elements, numbers;
    for (const mesh::Side& side : sides_of_set) {
      elements.push_back(side.element + 1);
      numbers.push_back(side.side + options.first_side);
    }
    put_set<dim>(file, EX_SIDE_SET, ++id, options.named ? name : "", elements, numbers);
  }
}

// ---- Exodus files by their parts ----

struct Block {
  std::int64_t id;
  std::string type;
  int n_nodes;
  std::vector<std::int64_t> nodes;
};
struct Sides {
  std::int64_t id;
  std::vector<std::int64_t> elements, sides;
};
using Points = std::vector<std::array<double, 3>>;

/// An Exodus file with numbers of 64 bits and no names.
inline void write_exodus_parts(const std::string& name, const Points& points, const std::vector<Block>& blocks,
                               const std::vector<Sides>& sets, const std::vector<std::int64_t>& node_set = {}) {
  const ExodusWriter file(name, EX_CLOBBER | EX_NETCDF4 | EX_ALL_INT64_DB | EX_ALL_INT64_API);
  std::int64_t n_elements = 0;
  for (const Block& block : blocks) n_elements += static_cast<std::int64_t>(block.nodes.size()) / block.n_nodes;
  file.check(ex_put_init(file.id(), "a test", 3, static_cast<std::int64_t>(points.size()), n_elements,
                         static_cast<std::int64_t>(blocks.size()), node_set.empty() ? 0 : 1,
                         static_cast<std::int64_t>(sets.size())));
  std::array<std::vector<double>, 3> axes;
  for (const auto& point : points) {
    for (std::size_t d = 0; d < 3; ++d) axes[d].push_back(point[d]);
  }
  file.check(ex_put_coord(file.id(), axes[0].data(), axes[1].data(), axes[2].data()));
  for (const Block& block : blocks) {
    file.check(ex_put_block(file.id(), EX_ELEM_BLOCK, block.id, block.type.c_str(),
                            static_cast<std::int64_t>(block.nodes.size()) / block.n_nodes, block.n_nodes, 0, 0, 0));
    file.check(ex_put_conn(file.id(), EX_ELEM_BLOCK, block.id, block.nodes.data(), nullptr, nullptr));
  }
  for (const Sides& set : sets) {
    file.check(ex_put_set_param(file.id(), EX_SIDE_SET, set.id, static_cast<std::int64_t>(set.elements.size()), 0));
    file.check(ex_put_set(file.id(), EX_SIDE_SET, set.id, set.elements.data(), set.sides.data()));
  }
  if (!node_set.empty()) {
    file.check(ex_put_set_param(file.id(), EX_NODE_SET, 1, static_cast<std::int64_t>(node_set.size()), 0));
    file.check(ex_put_set(file.id(), EX_NODE_SET, 1, node_set.data(), nullptr));
  }
}

// ---- ANSYS archives ----

/// A component, with runs of three numbers or more as first and -last.
inline std::string component(const std::string& name, const std::string& kind, const std::vector<int>& numbers) {
  std::vector<int> items;
  for (std::size_t i = 0, end = 0; i < numbers.size(); i = end) {
    for (end = i + 1; end < numbers.size() && numbers[end] == numbers[end - 1] + 1;) ++end;
    items.push_back(numbers[i]);
    if (end - i > 2) {
      items.push_back(-numbers[end - 1]);
    } else {
      for (std::size_t k = i + 1; k < end; ++k) items.push_back(numbers[k]);
    }
  }
  std::string text =
      fmt::format("CMBLOCK,{:<8},{},{:8}  ! users component definition\n(8i10)\n", name, kind, items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += fmt::format("{:10}{}", items[i], i % 8 == 7 || i + 1 == items.size() ? "\n" : "");
  }
  return text;
}

/// The nodes of an element as ANSYS has them: triangles are collapsed quadrangles; all solids but hexahedra collapsed
/// ones.
inline std::vector<int> ansys_nodes(mesh::ElementType type, const int* n) {
  switch (type) {
    case mesh::ElementType::tri3:
      return {n[0], n[1], n[2], n[2]};
    case mesh::ElementType::quad4:
      return {n[0], n[1], n[2], n[3]};
    case mesh::ElementType::tet4:
      return {n[0], n[1], n[2], n[2], n[3], n[3], n[3], n[3]};
    case mesh::ElementType::pyramid5:
      return {n[0], n[1], n[2], n[3], n[4], n[4], n[4], n[4]};
    case mesh::ElementType::wedge6:
      return {n[0], n[1], n[2], n[2], n[3], n[4], n[5], n[5]};
    default:
      return {n, n + 8};
  }
}

/// The archive that CDWRITE makes, nodes and elements numbered from 1.
template <int dim>
std::string ansys_archive(const mesh::Mesh<dim>& mesh) {
  std::string text = "/COM,ANSYS RELEASE 19.2    BUILD 19.2\n/PREP7\n/NOPR\n/TITLE,\n*IF,_CDRDOFF,EQ,1,THEN\n*ENDIF\n";
  text += fmt::format("ET,        1,{}\nKEYOP,      1, 3,        3\n", dim == 2 ? 182 : 185);
  text += fmt::format("NBLOCK,6,SOLID,{:9},{:9}\n(3i9,6e21.13e3)\n", mesh.n_nodes(), mesh.n_nodes());
  for (int n = 0; n < mesh.n_nodes(); ++n) {
    text += fmt::format("{:9}{:9}{:9}", n + 1, 0, 0);
    for (int d = 0; d < dim; ++d) text += fmt::format("{:21.13E}", mesh.coordinates[n][d]);
    text += "\n";
  }
  text +=
      fmt::format("N,R5.3,LOC,       -1,\nEBLOCK,19,SOLID,{:9},{:9}\n(19i9)\n", mesh.n_elements(), mesh.n_elements());
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const std::vector<int> nodes = ansys_nodes(mesh.types[e], mesh.corners_of(e));
    for (const int field : {mesh.blocks[e] + 1, 1, 1, 1, 0, 0, 0, 0, static_cast<int>(nodes.size()), 0, e + 1}) {
      text += fmt::format("{:9}", field);
    }
    for (const int node : nodes) text += fmt::format("{:9}", node + 1);
    text += "\n";
  }
  text += "       -1\n";
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::vector<int> numbers;
    for (const int node : nodes) numbers.push_back(node + 1);
    text += component(name, "NODE", numbers);
  }
  for (std::size_t block = 0; block < mesh.block_names.size(); ++block) {
    std::vector<int> numbers;
    for (int e = 0; e < mesh.n_elements(); ++e) {
      if (mesh.blocks[e] == static_cast<int>(block)) numbers.push_back(e + 1);
    }
    text += component(mesh.block_names[block], "ELEM", numbers);
  }
  return text + "MPTEMP,R5.0, 1, 1,  0.00000000    ,\n/GO\nFINISH\n";
}

}  // namespace perimorph::mesh_files
