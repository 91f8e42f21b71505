// Exodus files, as in "EXODUS: A Finite Element Data Model" (SAND2014), read through its library.

#include "exodus_file.hpp"

#include <exodusII.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <set>

#include "classic_header.hpp"
#include "exodus_types.hpp"
#include "file_cursor.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/mesh/element_type.hpp"
#include "trial.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int longest_name = 256;
constexpr int n_faces_of_shell = 2;          // its sides 1 and 2, before its edges
constexpr std::int64_t best_packing = 1032;  // of HDF5's compression (deflate)

// The limits for reading an HDF5 file: more than any sound one needs.
constexpr std::size_t trial_memory = std::size_t{1} << 30U, trial_memory_per_byte = 100;
constexpr std::size_t trial_seconds = 60, trial_bytes_per_second = 1000000;

const char* const advice = "export the elements of what is to be computed, plane ones for a 2D case";

Shape side_shape(std::size_t n_nodes) {
  return n_nodes == 2 ? Shape::line : n_nodes == 3 ? Shape::triangle : Shape::quadrangle;
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
  if (is_netcdf && !is_valid_header(file)) {
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
    const std::string path = std::filesystem::absolute(file).lexically_normal();  // a relative one may be an address
    id_ = ex_open(path.c_str(), EX_READ | EX_ALL_INT64_API, &our_word_size, &file_word_size, &version);
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
  static constexpr int passed_over = -1;

  /// How a block's plane elements number their sides.
  struct SideNumbering {
    std::string block;
    int dimension;  ///< of its elements
    bool is_shell;
  };

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

  std::string name_of(ex_entity_type kind, std::int64_t id, const char* unnamed) const {
    std::string name(longest_name + 1, '\0');
    if (ex_get_name(handle_.id(), kind, id, name.data()) < 0) name.clear();
    name.resize(std::min(name.find('\0'), name.size()));
    if (base::has_control_characters(name)) {
      fail("the name \"{}\" has control characters; allowed are readable names", excerpt(name));
    }
    return name.empty() ? fmt::format("{}_{}", unnamed, id) : name;
  }

  /// Files need not number nodes or elements, or may do so with the same number twice: their places are numbers, too.
  std::vector<std::int64_t> tags(ex_entity_type kind, std::int64_t count, const std::string& what) const {
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
    if (count > 0) check(ex_get_id_map(handle_.id(), kind, numbers.data()), what);
    std::vector<std::int64_t> ascending = numbers;
    std::sort(ascending.begin(), ascending.end());
    if (std::adjacent_find(ascending.begin(), ascending.end()) != ascending.end()) {
      std::iota(numbers.begin(), numbers.end(), std::int64_t{1});
    }
    return numbers;
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
    if (n_passed_over_ + static_cast<std::int64_t>(result_.n_elements()) != sizes_.num_elem) {
      fail("{} elements announced, but the blocks have {}: the file is damaged", sizes_.num_elem,
           n_passed_over_ + static_cast<std::int64_t>(result_.n_elements()));
    }
  }

  void read_block(std::int64_t id) {
    Block block{id, "", std::string(MAX_STR_LENGTH + 1, '\0')};
    std::int64_t n_edges = 0, n_faces = 0, n_attributes = 0;
    check(ex_get_block(handle_.id(), EX_ELEM_BLOCK, id, block.type.data(), &block.n_elements, &block.n_nodes, &n_edges,
                       &n_faces, &n_attributes),
          fmt::format("element block {}", id));
    block.type.resize(std::min(block.type.find('\0'), block.type.size()));
    block.name = name_of(EX_ELEM_BLOCK, id, "block");
    if (block.n_elements == 0) return;
    if (block.n_elements > sizes_.num_elem - static_cast<std::int64_t>(element_at_.size()) || block.n_elements < 0) {
      fail("{} elements announced, but the blocks have more: the file is damaged", sizes_.num_elem);
    }
    has_body(block.type) ? read_elements(block) : pass_over(block);
  }

  struct Block {
    std::int64_t id;
    std::string name, type;
    std::int64_t n_elements = 0, n_nodes = 0;
  };

  void pass_over(const Block& block) {
    element_at_.resize(element_at_.size() + static_cast<std::size_t>(block.n_elements), passed_over);
    n_passed_over_ += block.n_elements;
    result_.notes.push_back(fmt::format("the block \"{}\" is passed over: its {} elements of type \"{}\" have no body",
                                        block.name, block.n_elements, excerpt(block.type)));
  }

  void read_elements(const Block& block) {
    const PlaneOrSolid type = type_of(block);
    held(block.n_elements, block.n_nodes * static_cast<std::int64_t>(sizeof(int)), "elements");
    std::vector<std::int64_t> nodes(static_cast<std::size_t>(block.n_elements * block.n_nodes));
    check(ex_get_conn(handle_.id(), EX_ELEM_BLOCK, block.id, nodes.data(), nullptr, nullptr),
          fmt::format("elements of block \"{}\"", block.name));
    const bool is_shell = type.is_shell || (type.shape == Shape::triangle && sizes_.num_dim == 3);
    side_numbering_.push_back({block.name, dimension(type.shape), is_shell});
    if (dimension(type.shape) == 2) result_.n_plane_bodies += static_cast<std::size_t>(block.n_elements);
    const int list = add_group(dimension(type.shape), block.name);
    for (std::size_t e = 0; e < static_cast<std::size_t>(block.n_elements); ++e) {
      const auto first = nodes.begin() + static_cast<std::ptrdiff_t>(e) * block.n_nodes;
      add_element(type.shape, list, {first, first + block.n_nodes});
    }
  }

  PlaneOrSolid type_of(const Block& block) const {
    if (const auto type = plane_or_solid(block.type, block.n_nodes)) return *type;
    fail(
        "block \"{}\" has elements of type \"{}\" with {} nodes; allowed are triangles (TRI), quadrangles (QUAD, "
        "SHELL), "
        "TETRA, PYRAMID, WEDGE and HEX, of first or second order",
        block.name, excerpt(block.type), block.n_nodes);
  }

  void add_element(Shape shape, int list, const std::vector<std::int64_t>& numbers) {
    const std::int64_t tag = numbers_[element_at_.size()];
    std::vector<std::int64_t> nodes;
    for (const std::int64_t number : numbers) nodes.push_back(node_tag(number, fmt::format("element {}", tag)));
    element_at_.push_back(static_cast<int>(result_.n_elements()));
    block_of_.push_back(static_cast<int>(side_numbering_.size()) - 1);
    result_.add_element(tag, shape, list, nodes);
  }

  std::int64_t node_tag(std::int64_t number, const std::string& owner) const {
    if (number < 1 || number > sizes_.num_nodes) {
      fail("{} has node {}; allowed are 1 to {}", owner, number, sizes_.num_nodes);
    }
    return result_.node_tags[static_cast<std::size_t>(number - 1)];
  }

  /// Blocks and sets each have ids of their own, of up to 64 bits; here they are numbered in order.
  int add_group(int dimension, const std::string& name) {
    const int number = static_cast<int>(result_.group_names.size()) + 1;
    result_.group_names[{dimension, number}] = name;
    return result_.add_group_list({number});
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
    std::vector<Set> sets;
    for (const std::int64_t id : ids(EX_SIDE_SET, sizes_.num_side_sets, "numbers of the side sets")) {
      sets.push_back(read_set(EX_SIDE_SET, id, "sides"));
    }
    choose_side_numbering(sets);
    for (const Set& set : sets) add_side_set(set);
  }

  /// A set with sides that its elements do not have is left out: perhaps nobody uses it.
  void add_side_set(const Set& set) {
    std::vector<std::vector<std::int64_t>> sides;
    for (std::size_t i = 0; i < set.entries.size(); ++i) {
      const int element = element_index(set, i);
      sides.push_back(element == passed_over ? std::vector<std::int64_t>() : nodes_of_side(element, set.extra[i]));
      if (!sides.back().empty()) continue;
      result_.notes.push_back(fmt::format(
          "the side set \"{}\" is left out: it has side {} of element {}, which is none of its edges or faces",
          set.name, set.extra[i], numbers_[static_cast<std::size_t>(set.entries[i] - 1)]));
      return;
    }
    std::map<int, int> list_of_dimension;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Shape shape = side_shape(sides[i].size());
      const auto [list, is_new] = list_of_dimension.emplace(dimension(shape), 0);
      if (is_new) list->second = add_group(dimension(shape), set.name);
      result_.add_element(static_cast<std::int64_t>(i) + 1, shape, list->second, sides[i]);
    }
  }

  /// Where the entry's element stands in the lists, or that it was passed over.
  int element_index(const Set& set, std::size_t entry) const {
    const std::int64_t element = set.entries[entry];
    if (element < 1 || element > static_cast<std::int64_t>(element_at_.size())) {
      fail("side set \"{}\" has element {}; allowed are 1 to {}", set.name, element, element_at_.size());
    }
    return element_at_[static_cast<std::size_t>(element - 1)];
  }

  /// The corners of a side, {} if the element has none of that number.
  std::vector<std::int64_t> nodes_of_side(int element, std::int64_t side_number) const {
    const auto e = static_cast<std::size_t>(element);
    return nodes_of_side(e, side_number, side_numbering_[static_cast<std::size_t>(block_of_[e])].is_shell);
  }

  std::vector<std::int64_t> nodes_of_side(std::size_t element, std::int64_t side_number, bool is_shell) const {
    const auto begin = result_.element_nodes.begin() + static_cast<std::ptrdiff_t>(result_.first_node[element]);
    const auto& all = sides(element_type(result_.shapes[element]));
    const std::int64_t side = side_number - 1 - (is_shell ? n_faces_of_shell : 0);
    if (is_shell && side < 0 && side_number >= 1) return {begin, begin + n_nodes(result_.shapes[element])};
    if (side < 0 || side >= static_cast<std::int64_t>(all.size())) return {};
    std::vector<std::int64_t> nodes;
    for (const int corner : all[static_cast<std::size_t>(side)]) nodes.push_back(begin[corner]);
    return nodes;
  }

  // ---- the numbers of sides of plane elements: edges from 1, or, as of shells, after two faces ----

  /// Files of plane elements in three dimensions have one or the other, whatever the elements are called. The right one
  /// is that by which more of the sides are edges of the body, or faces beside solid elements.
  void choose_side_numbering(const std::vector<Set>& sets) {
    if (sizes_.num_dim != 3) return;
    const auto edges = boundary_edges();
    if (edges.empty()) return;
    for (std::size_t b = 0; b < side_numbering_.size(); ++b) {
      SideNumbering& numbering = side_numbering_[b];
      if (numbering.dimension != 2) continue;
      const bool usual = numbering.is_shell;
      const int n_usual = n_sides_at_boundary(sets, static_cast<int>(b), usual, edges);
      const int n_other = n_sides_at_boundary(sets, static_cast<int>(b), !usual, edges);
      if (n_other <= n_usual) continue;
      numbering.is_shell = !usual;
      result_.notes.push_back(
          fmt::format("sides of the block \"{}\" are taken as numbered {}: as that, {} of them are at "
                      "the boundary, otherwise {}",
                      numbering.block, usual ? "from the first edge" : "after two faces", n_other, n_usual));
    }
  }

  using Edge = std::pair<std::int64_t, std::int64_t>;
  static Edge edge_of(const std::vector<std::int64_t>& nodes) { return std::minmax(nodes[0], nodes[1]); }

  /// Edges that one plane element has.
  std::set<Edge> boundary_edges() const {
    std::map<Edge, int> n_elements;
    for (std::size_t e = 0; e < result_.n_elements(); ++e) {
      if (dimension(result_.shapes[e]) != 2) continue;
      for (int side = 1; side <= n_nodes(result_.shapes[e]); ++side)
        ++n_elements[edge_of(nodes_of_side(e, side, false))];
    }
    std::set<Edge> edges;
    for (const auto& [edge, n] : n_elements) {
      if (n == 1) edges.insert(edge);
    }
    return edges;
  }

  int n_sides_at_boundary(const std::vector<Set>& sets, int block, bool is_shell, const std::set<Edge>& edges) const {
    const bool has_solids =
        std::any_of(result_.shapes.begin(), result_.shapes.end(), [](Shape shape) { return dimension(shape) == 3; });
    int n = 0;
    for (const Set& set : sets) {
      for (std::size_t i = 0; i < set.entries.size(); ++i) {
        const int element = element_index(set, i);
        if (element == passed_over || block_of_[static_cast<std::size_t>(element)] != block) continue;
        const auto nodes = nodes_of_side(static_cast<std::size_t>(element), set.extra[i], is_shell);
        n += nodes.size() == 2 ? static_cast<int>(edges.count(edge_of(nodes))) : !nodes.empty() && has_solids ? 1 : 0;
      }
    }
    return n;
  }

  void read_node_sets() {
    for (const std::int64_t id : ids(EX_NODE_SET, sizes_.num_node_sets, "numbers of the node sets")) {
      const Set set = read_set(EX_NODE_SET, id, "nodes");
      std::set<std::int64_t> nodes;
      for (const std::int64_t node : set.entries)
        nodes.insert(node_tag(node, fmt::format("node set \"{}\"", set.name)));
      if (nodes.empty()) continue;
      const int list = add_group(0, set.name);
      for (const std::int64_t node : nodes) result_.add_element(node, Shape::point, list, {node});
    }
  }

  const std::string& file_;
  Container container_;
  Handle handle_;
  ex_init_params sizes_{};
  MeshFile result_;
  std::vector<std::int64_t> numbers_;  ///< of the file's elements
  std::vector<int> element_at_;        ///< by place in the file: index of the element, or passed_over
  std::int64_t n_passed_over_ = 0;
  std::vector<int> block_of_;  ///< by index of an element, place in side_numbering_
  std::vector<SideNumbering> side_numbering_;
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
