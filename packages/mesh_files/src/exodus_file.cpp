// Exodus files, as in "EXODUS: A Finite Element Data Model" (SAND2014), read through its library.

#include "exodus_file.hpp"

#include <exodusII.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <set>

#include "classic_header.hpp"
#include "file_cursor.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/mesh/element_type.hpp"
#include "trial.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int longest_name = 256;
constexpr int first_side_of_shell = 2;       // its sides 1 and 2 are its faces
constexpr std::int64_t best_packing = 1032;  // of HDF5's compression (deflate)

// The limits for reading an HDF5 file: more than any sound one needs.
constexpr std::size_t trial_memory = std::size_t{1} << 30U, trial_memory_per_byte = 100;
constexpr std::size_t trial_seconds = 60, trial_bytes_per_second = 1000000;

const Advice advice = {"export the elements of what is to be computed, plane ones for a 2D case",
                       "Export only nodes that elements use",
                       "Number their nodes counterclockwise, seen from +z (in 3D so that volumes are positive)"};

/// An element type as programs that write Exodus files spell it.
struct Spelling {
  const char* name;
  Shape shape;
  bool is_shell;  // a 2D element with faces
};
constexpr Spelling spellings[] = {
    {"TRI", Shape::triangle, false},     {"TRI3", Shape::triangle, false},      {"TRIANGLE", Shape::triangle, false},
    {"TRISHELL", Shape::triangle, true}, {"QUAD", Shape::quadrangle, false},    {"QUAD4", Shape::quadrangle, false},
    {"SHELL", Shape::quadrangle, true},  {"SHELL4", Shape::quadrangle, true},   {"TETRA", Shape::tetrahedron, false},
    {"TET", Shape::tetrahedron, false},  {"TETRA4", Shape::tetrahedron, false}, {"TET4", Shape::tetrahedron, false},
    {"PYRAMID", Shape::pyramid, false},  {"PYRAMID5", Shape::pyramid, false},   {"WEDGE", Shape::wedge, false},
    {"WEDGE6", Shape::wedge, false},     {"HEX", Shape::hexahedron, false},     {"HEX8", Shape::hexahedron, false}};

/// The shape of a side with so many nodes of an element of this dimension.
Shape side_shape(int element_dimension, std::size_t n_side_nodes) {
  if (element_dimension == 2) return Shape::line;
  return n_side_nodes == 3 ? Shape::triangle : Shape::quadrangle;
}

enum class Container { netcdf, hdf5 };

/// What the first bytes say that the file is, before a library opens it.
Container container_of(const std::string& file) {
  std::string start(8, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  if (start == "\x89HDF\r\n\x1a\n") return Container::hdf5;
  const bool is_netcdf =
      start.size() >= 4 && start.substr(0, 3) == "CDF" && (start[3] == 1 || start[3] == 2 || start[3] == 5);
  if (is_netcdf && !is_sound_header(file)) {
    throw base::UserError(
        file + ": its header contradicts itself or announces more than the file holds: it is truncated or damaged");
  }
  if (is_netcdf) return Container::netcdf;
  throw base::UserError(fmt::format("{}: not an Exodus file: it must begin as a netCDF or HDF5 file does, found \"{}\"",
                                    file, excerpt(start)));
}

/// Keeps a library's own messages off the terminal while it opens a file: they mislead when the file is damaged.
class Silence {
 public:
  Silence() : terminal_(dup(STDERR_FILENO)), nowhere_(open("/dev/null", O_WRONLY)) { dup2(nowhere_, STDERR_FILENO); }
  ~Silence() {
    dup2(terminal_, STDERR_FILENO);
    close(terminal_);
    close(nowhere_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int terminal_, nowhere_;
};

/// An open Exodus file.
class Handle {
 public:
  explicit Handle(const std::string& file) {
    int our_word_size = sizeof(double), file_word_size = 0;
    float version = 0.F;
    const Silence silence;
    id_ = ex_open(file.c_str(), EX_READ | EX_ALL_INT64_API, &our_word_size, &file_word_size, &version);
  }
  ~Handle() {
    if (id_ >= 0) ex_close(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  int id() const { return id_; }

 private:
  int id_ = -1;
};

class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file), container_(container_of(file)), handle_(file) {
    result_.name = file;
    result_.advice = advice;
  }

  MeshFile read() {
    if (handle_.id() < 0) fail("the file cannot be opened: it is truncated or damaged, or holds no Exodus data");
    read_sizes();
    read_nodes();
    read_blocks();
    read_side_sets();
    read_node_sets();
    return std::move(result_);
  }

 private:
  struct Set {
    std::int64_t id;
    std::string name;
    std::vector<std::int64_t> entries, extra;  ///< nodes; or elements and their sides; from 1
  };

  template <class... Arguments>
  [[noreturn]] void fail(fmt::format_string<Arguments...> what, Arguments&&... arguments) const {
    throw base::UserError(file_ + ": " + fmt::format(what, std::forward<Arguments>(arguments)...));
  }

  /// A status below 0 is an error, one above a warning.
  void check(int status, const std::string& what) const {
    if (status < 0) fail("the {} cannot be read: the file is truncated or damaged", what);
  }

  /// A count, if a file of this size can hold so many items of so many bytes.
  std::size_t held(std::int64_t count, std::int64_t bytes, const std::string& what) const {
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file_));
    const std::int64_t most = (container_ == Container::hdf5 ? best_packing : 1) * size / bytes;
    if (count < 0 || count > most) {
      fail("{} {} announced, but a file of {} bytes holds at most {}: it is damaged", count, what, size, most);
    }
    return static_cast<std::size_t>(count);
  }

  void read_sizes() {
    check(ex_get_init_ext(handle_.id(), &sizes_), "header");
    if (sizes_.num_dim != 2 && sizes_.num_dim != 3) fail("found {} dimensions; allowed are 2 and 3", sizes_.num_dim);
    held(sizes_.num_nodes, sizes_.num_dim * static_cast<std::int64_t>(sizeof(float)), "nodes");
    held(sizes_.num_elem, sizeof(int), "elements");
    held(sizes_.num_elem_blk, sizeof(int), "element blocks");
    held(sizes_.num_node_sets, sizeof(int), "node sets");
    held(sizes_.num_side_sets, sizeof(int), "side sets");
    const auto longest = ex_inquire_int(handle_.id(), EX_INQ_DB_MAX_USED_NAME_LENGTH);
    ex_set_max_name_length(handle_.id(), static_cast<int>(std::clamp<std::int64_t>(longest, 32, longest_name)));
  }

  std::vector<std::int64_t> ids(ex_entity_type kind, std::int64_t count, const std::string& what) const {
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
    if (count > 0) check(ex_get_ids(handle_.id(), kind, numbers.data()), what);
    return numbers;
  }

  std::vector<std::int64_t> tags(ex_entity_type kind, std::int64_t count, const std::string& what) const {
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
    if (count > 0) check(ex_get_id_map(handle_.id(), kind, numbers.data()), what);
    return numbers;
  }

  std::string name_of(ex_entity_type kind, std::int64_t id, const char* unnamed) const {
    std::string name(longest_name + 1, '\0');
    if (ex_get_name(handle_.id(), kind, id, name.data()) < 0) name.clear();
    name.resize(std::min(name.find('\0'), name.size()));
    if (base::has_control_characters(name)) {
      fail("the name \"{}\" has control characters; allowed are readable names", excerpt(name));
    }
    return name.empty() ? fmt::format("{}_{}", unnamed, id) : name;
  }

  static int key_of(std::int64_t id) {
    return static_cast<int>(std::clamp<std::int64_t>(id, 0, std::numeric_limits<int>::max()));
  }

  void read_nodes() {
    const auto n = static_cast<std::size_t>(sizes_.num_nodes);
    result_.node_tags = tags(EX_NODE_MAP, sizes_.num_nodes, "node numbers");
    std::array<std::vector<double>, 3> axes;
    for (auto& axis : axes) axis.assign(n, 0.);
    if (n > 0) {
      check(ex_get_coord(handle_.id(), axes[0].data(), axes[1].data(), sizes_.num_dim == 3 ? axes[2].data() : nullptr),
            "coordinates");
    }
    for (std::size_t i = 0; i < n; ++i) {
      result_.coordinates.push_back({axes[0][i], axes[1][i], axes[2][i]});
      for (const double x : result_.coordinates.back()) {
        if (!std::isfinite(x)) fail("a coordinate of node {} is {}", result_.node_tags[i], x);
      }
    }
  }

  void read_blocks() {
    numbers_ = tags(EX_ELEM_MAP, sizes_.num_elem, "element numbers");
    for (const std::int64_t id : ids(EX_ELEM_BLOCK, sizes_.num_elem_blk, "numbers of the element blocks")) {
      read_block(id);
    }
    if (static_cast<std::int64_t>(result_.n_elements()) != sizes_.num_elem) {
      fail("{} elements announced, but the blocks have {}: the file is damaged", sizes_.num_elem, result_.n_elements());
    }
  }

  void read_block(std::int64_t id) {
    std::string type(MAX_STR_LENGTH + 1, '\0');
    std::int64_t n_elements = 0, n_corners = 0, n_edges = 0, n_faces = 0, n_attributes = 0;
    check(ex_get_block(handle_.id(), EX_ELEM_BLOCK, id, type.data(), &n_elements, &n_corners, &n_edges, &n_faces,
                       &n_attributes),
          fmt::format("element block {}", id));
    type.resize(std::min(type.find('\0'), type.size()));
    const std::string name = name_of(EX_ELEM_BLOCK, id, "block");
    if (n_elements == 0) return;
    const Spelling& spelling = spelling_of(type, n_corners, name);
    held(n_elements, n_corners * static_cast<std::int64_t>(sizeof(int)), "elements");
    if (n_elements > sizes_.num_elem - static_cast<std::int64_t>(result_.n_elements())) {
      fail("{} elements announced, but the blocks have more: the file is damaged", sizes_.num_elem);
    }

    std::vector<std::int64_t> corners(static_cast<std::size_t>(n_elements * n_corners));
    check(ex_get_conn(handle_.id(), EX_ELEM_BLOCK, id, corners.data(), nullptr, nullptr),
          fmt::format("elements of block \"{}\"", name));
    const int list = add_group({dimension(spelling.shape), key_of(id)}, name);
    for (std::size_t e = 0; e < static_cast<std::size_t>(n_elements); ++e) {
      const auto first = corners.begin() + static_cast<std::ptrdiff_t>(e) * n_corners;
      add_element(spelling.shape, list, {first, first + n_corners});
      shell_.push_back(spelling.is_shell || (spelling.shape == Shape::triangle && sizes_.num_dim == 3));
    }
  }

  const Spelling& spelling_of(std::string type, std::int64_t n_corners, const std::string& block) const {
    std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::toupper(c); });
    const auto* found = std::find_if(std::begin(spellings), std::end(spellings),
                                     [&](const Spelling& spelling) { return type == spelling.name; });
    if (found == std::end(spellings) || n_nodes(found->shape) != n_corners) {
      fail(
          "block \"{}\" has elements of type \"{}\" with {} nodes; allowed are TRI3, QUAD4, TETRA4, PYRAMID5, WEDGE6 "
          "and HEX8",
          block, excerpt(type), n_corners);
    }
    return *found;
  }

  void add_element(Shape shape, int list, const std::vector<std::int64_t>& corners) {
    const std::int64_t tag = numbers_[result_.n_elements()];
    std::vector<std::int64_t> nodes;
    for (const std::int64_t corner : corners) nodes.push_back(node_tag(corner, fmt::format("element {}", tag)));
    result_.add_element(tag, shape, list, nodes);
  }

  std::int64_t node_tag(std::int64_t number, const std::string& owner) const {
    if (number < 1 || number > sizes_.num_nodes) {
      fail("{} has node {}; allowed are 1 to {}", owner, number, sizes_.num_nodes);
    }
    return result_.node_tags[static_cast<std::size_t>(number - 1)];
  }

  int add_group(const GroupKey& key, const std::string& name) {
    if (!result_.group_names.emplace(key, name).second) {
      fail("\"{}\" and \"{}\" have the same number {}", result_.group_names[key], name, key.second);
    }
    return result_.add_group_list({key.second});
  }

  // ---- sets ----

  Set read_set(ex_entity_type kind, std::int64_t id, const char* unnamed) const {
    Set set{id, name_of(kind, id, unnamed), {}, {}};
    std::int64_t n = 0, n_factors = 0;
    check(ex_get_set_param(handle_.id(), kind, id, &n, &n_factors), fmt::format("set \"{}\"", set.name));
    set.entries.resize(held(n, sizeof(int), "members of a set"));
    if (kind == EX_SIDE_SET) set.extra.resize(set.entries.size());
    if (n > 0) {
      check(ex_get_set(handle_.id(), kind, id, set.entries.data(), set.extra.empty() ? nullptr : set.extra.data()),
            fmt::format("set \"{}\"", set.name));
    }
    return set;
  }

  /// Sides are appended after all elements, so that an element's number remains its place in the lists.
  void read_side_sets() {
    const std::size_t n_body = result_.n_elements();
    for (const std::int64_t id : ids(EX_SIDE_SET, sizes_.num_side_sets, "numbers of the side sets")) {
      const Set set = read_set(EX_SIDE_SET, id, "sides");
      std::optional<int> list;
      for (std::size_t i = 0; i < set.entries.size(); ++i) {
        const std::size_t element = element_index(set, i, n_body);
        const std::vector<std::int64_t> nodes = nodes_of_side(set, element, set.extra[i]);
        const int element_dimension = dimension(result_.shapes[element]);
        if (!list) list = add_group({element_dimension - 1, key_of(id)}, set.name);
        result_.add_element(static_cast<std::int64_t>(i) + 1, side_shape(element_dimension, nodes.size()), *list,
                            nodes);
        nodes_of_side_set_[set.name].insert(nodes.begin(), nodes.end());
      }
    }
  }

  std::size_t element_index(const Set& set, std::size_t entry, std::size_t n_body) const {
    const std::int64_t element = set.entries[entry];
    if (element < 1 || element > static_cast<std::int64_t>(n_body)) {
      fail("side set \"{}\" has element {}; allowed are 1 to {}", set.name, element, n_body);
    }
    return static_cast<std::size_t>(element - 1);
  }

  std::vector<std::int64_t> nodes_of_side(const Set& set, std::size_t element, std::int64_t side_number) const {
    const auto& all = sides(element_type(result_.shapes[element]));
    const std::int64_t side = side_number - 1 - (shell_[element] ? first_side_of_shell : 0);
    if (side < 0 || side >= static_cast<std::int64_t>(all.size())) {
      fail("side set \"{}\" has side {} of element {}, which is none of its edges or faces", set.name, side_number,
           result_.element_tags[element]);
    }
    std::vector<std::int64_t> nodes;
    for (const int corner : all[static_cast<std::size_t>(side)]) {
      nodes.push_back(result_.element_nodes[result_.first_node[element] + static_cast<std::size_t>(corner)]);
    }
    return nodes;
  }

  void read_node_sets() {
    for (const std::int64_t id : ids(EX_NODE_SET, sizes_.num_node_sets, "numbers of the node sets")) {
      const Set set = read_set(EX_NODE_SET, id, "nodes");
      std::set<std::int64_t> nodes;
      for (const std::int64_t node : set.entries)
        nodes.insert(node_tag(node, fmt::format("node set \"{}\"", set.name)));
      const auto same_name = nodes_of_side_set_.find(set.name);
      if (nodes.empty() || (same_name != nodes_of_side_set_.end() && same_name->second == nodes)) continue;
      if (same_name != nodes_of_side_set_.end()) {
        fail("a node set and a side set are called \"{}\", but have different nodes; give each its own name", set.name);
      }
      const int list = add_group({0, key_of(id)}, set.name);
      for (const std::int64_t node : nodes) result_.add_element(node, Shape::point, list, {node});
    }
  }

  const std::string& file_;
  Container container_;
  Handle handle_;
  ex_init_params sizes_{};
  MeshFile result_;
  std::vector<std::int64_t> numbers_;  ///< of the elements
  std::vector<char> shell_;            ///< by element: its first two sides are its faces
  std::map<std::string, std::set<std::int64_t>> nodes_of_side_set_;
};

}  // namespace

/// HDF5's library trusts what a file says of itself: damaged ones make it crash or take all memory. So another process
/// reads it first. (Classic headers are checked by ourselves.)
MeshFile read_exodus_file(const std::string& file) {
  require_regular_file(file, "an Exodus file");
  if (container_of(file) == Container::hdf5) {
    const std::size_t size = std::filesystem::file_size(file);
    const std::string trouble = on_trial([&] { Reader(file).read(); }, trial_memory + trial_memory_per_byte * size,
                                         static_cast<unsigned>(trial_seconds + size / trial_bytes_per_second));
    if (!trouble.empty()) {
      throw base::UserError(fmt::format("{}: the HDF5 library cannot read it ({}): it is damaged", file, trouble));
    }
  }
  return Reader(file).read();
}

}  // namespace perimorph::mesh_files
