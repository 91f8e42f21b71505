// Exodus files, as in "EXODUS: A Finite Element Data Model" (SAND2014), read through its library.

#include "exodus_file.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "exodus_input.hpp"
#include "exodus_types.hpp"
#include "file_cursor.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/element_type.hpp"
#include "share_exchange.hpp"
#include "trial.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int n_faces_of_shell = 2;  // its sides 1 and 2, before its edges

// The limits for reading an HDF5 file: more than any sound one needs.
constexpr std::size_t trial_memory = std::size_t{1} << 30U, trial_memory_per_byte = 100;
constexpr std::size_t trial_seconds = 60, trial_bytes_per_second = 1000000;

const char* const advice = "export the elements of what is to be computed, plane ones for a 2D case";

Shape side_shape(std::size_t n_nodes) {
  return n_nodes == 2 ? Shape::line : n_nodes == 3 ? Shape::triangle : Shape::quadrangle;
}

/// The corners of a side by its number in the file, {} if there is none of that number.
std::vector<int> corners_of_side(Shape shape, std::int64_t side_number, bool is_shell) {
  const auto& all = sides(element_type(shape));
  const std::int64_t side = side_number - 1 - (is_shell ? n_faces_of_shell : 0);
  if (is_shell && side < 0 && side_number >= 1) {
    std::vector<int> corners(static_cast<std::size_t>(n_nodes(shape)));
    std::iota(corners.begin(), corners.end(), 0);
    return corners;
  }
  const bool is_there = side >= 0 && side < static_cast<std::int64_t>(all.size());
  return is_there ? all[static_cast<std::size_t>(side)] : std::vector<int>();
}

/// Reads one rank's share of a file. Until put_node_numbers(), nodes of elements are places in the file, from 1.
class Reader {
 public:
  Reader(const std::string& file, const Share& share)
      : file_(file), share_(share), own_nodes_(share.of(file_.n_nodes())) {
    result_.name = file;
    result_.advice = advice;
  }

  /// Files need not number nodes or elements, or may do so with the same number twice: their places are numbers, too.
  /// Collective.
  void read_numbers(const base::Comm& comm) {
    std::vector<std::int64_t> numbers_of_elements;
    base::on_all_ranks(comm, [&] {
      result_.node_tags = file_.numbers(EX_NODE_MAP, own_nodes_);
      numbers_of_elements = file_.numbers(EX_ELEM_MAP, share_.of(file_.n_elements()));
    });
    if (!are_all_different(comm, result_.node_tags)) {
      std::iota(result_.node_tags.begin(), result_.node_tags.end(), own_nodes_.begin + 1);
    }
    elements_have_numbers_ = are_all_different(comm, std::move(numbers_of_elements));
  }

  /// Local.
  void read_nodes() {
    const auto axes = file_.coordinates(own_nodes_);
    result_.coordinates.reserve(result_.node_tags.size());
    for (std::size_t i = 0; i < result_.node_tags.size(); ++i) {
      result_.coordinates.push_back({axes[0][i], axes[1][i], axes[2][i]});
      for (const double x : result_.coordinates.back()) {
        if (!std::isfinite(x)) file_.fail("a coordinate of node {} is {}", result_.node_tags[i], x);
      }
    }
  }

  /// Local.
  void read_blocks() {
    list_blocks();
    for (Block& block : blocks_) {
      if (block.has_body) read_elements(block);
    }
  }

  /// Files of plane elements in three dimensions have one numbering of sides or the other (edges from 1, or, as of
  /// shells, after two faces), whatever the elements are called. The right one is that by which more of the sides are
  /// edges of the body, or faces beside solid elements. Collective.
  void choose_side_numbering(const base::Comm& comm) {
    const bool has_choice = std::any_of(blocks_.begin(), blocks_.end(), [](const Block& b) { return b.is_plane(); });
    if (file_.n_dimensions() != 3 || !has_choice) return;
    std::vector<OwnSide> sides;
    base::on_all_ranks(comm, [&] { sides = sides_of_plane_elements(); });
    const BoundaryEdges edges(comm, edges_of_plane_elements());
    if (edges.empty()) return;
    const std::vector<double> usual = n_sides_at_boundary(comm, sides, false, edges);
    const std::vector<double> other = n_sides_at_boundary(comm, sides, true, edges);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (other[b] > usual[b]) take_other_numbering(blocks_[b], std::lround(other[b]), std::lround(usual[b]));
    }
  }

  /// Local. Sides are appended after all elements.
  void read_sets() {
    for (const auto& set : file_.side_sets()) read_side_set(set);
    for (const auto& set : file_.node_sets()) read_node_set(set);
  }

  /// The last step: places in the file become the nodes' numbers. Collective.
  MeshFile put_node_numbers(const base::Comm& comm) {
    std::vector<std::int64_t> places(result_.node_tags.size());
    std::iota(places.begin(), places.end(), own_nodes_.begin + 1);
    if (base::max(comm, base::GlobalId{places == result_.node_tags ? 0 : 1}) > 0) {
      for (auto* list : {&result_.element_nodes, &result_.mid_nodes}) {
        for (std::int64_t& node : *list) --node;
        *list = items_at(comm, result_.node_tags, file_.n_nodes(), *list);
      }
    }
    return std::move(result_);
  }

 private:
  /// A block of elements, and the part of it that is in the share.
  struct Block {
    ExodusInput::Block described;
    std::int64_t first;  ///< place in the file of its first element
    bool has_body;       ///< otherwise it is passed over, and what follows has no meaning
    Shape shape = Shape::point;
    bool is_shell = false;
    int group_list = 0;
    Range own = {};                  ///< of its elements
    std::int64_t first_in_list = 0;  ///< place in the lists of the first of them

    bool is_plane() const { return has_body && dimension(shape) == 2; }
  };

  /// A side of an element in the share.
  struct OwnSide {
    std::int64_t place;   ///< in the set
    std::size_t block;    ///< in blocks_
    std::size_t element;  ///< in the lists
    std::int64_t number;  ///< of the side, as in the file
  };

  // ---- elements ----

  void list_blocks() {
    std::int64_t first = 0;
    std::array<std::int64_t, 4> n_elements{};
    for (const ExodusInput::Block& described : file_.blocks()) {
      if (described.n_elements == 0) continue;
      Block& block = blocks_.emplace_back(Block{described, first, has_body(described.type)});
      first += described.n_elements;
      if (!block.has_body) {
        note("the block \"{}\" is passed over: its {} elements of type \"{}\" have no body", described.name,
             described.n_elements, excerpt(described.type));
        continue;
      }
      const PlaneOrSolid type = type_of(described);
      file_.check_size(described);
      block.shape = type.shape;
      block.is_shell = type.is_shell || (type.shape == Shape::triangle && file_.n_dimensions() == 3);
      block.group_list = add_group(dimension(type.shape), described.name);
      block.own.begin = n_elements[dimension(type.shape)];  // at first of all elements of the dimension
      n_elements[dimension(type.shape)] += described.n_elements;
    }
    for (Block& block : blocks_) {
      const Range wanted = share_.of(n_elements[dimension(block.shape)]).from(block.own.begin);
      block.own = Range{0, block.described.n_elements}.overlap(wanted);
    }
  }

  PlaneOrSolid type_of(const ExodusInput::Block& block) const {
    if (const auto type = plane_or_solid(block.type, block.n_nodes)) return *type;
    file_.fail(
        "block \"{}\" has elements of type \"{}\" with {} nodes; allowed are triangles (TRI), quadrangles (QUAD, "
        "SHELL), "
        "TETRA, PYRAMID, WEDGE and HEX, of first or second order",
        block.name, excerpt(block.type), block.n_nodes);
  }

  void read_elements(Block& block) {
    block.first_in_list = static_cast<std::int64_t>(result_.n_elements());
    if (block.is_plane()) result_.n_plane_bodies += static_cast<std::size_t>(block.own.size());
    const std::int64_t n_nodes = block.described.n_nodes;
    for (Range part = {block.own.begin, block.own.begin}; part.end < block.own.end; part.begin = part.end) {
      part.end = std::min(part.begin + most_at_once, block.own.end);
      const std::vector<std::int64_t> nodes = file_.nodes_of_elements(block.described, part);
      const std::vector<std::int64_t> numbers = numbers_of_elements(part.from(-block.first));
      for (std::int64_t e = 0; e < part.size(); ++e) {
        const auto begin = nodes.begin() + e * n_nodes;
        add_element(numbers[static_cast<std::size_t>(e)], block, {begin, begin + n_nodes});
      }
    }
  }

  /// @param range of places in the file
  std::vector<std::int64_t> numbers_of_elements(const Range& range) const {
    if (elements_have_numbers_) return file_.numbers(EX_ELEM_MAP, range);
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(range.size()));
    std::iota(numbers.begin(), numbers.end(), range.begin + 1);
    return numbers;
  }

  void add_element(std::int64_t number, const Block& block, const std::vector<std::int64_t>& nodes) {
    for (const std::int64_t node : nodes) {
      if (!is_node(node)) file_.fail("element {} has node {}; allowed are 1 to {}", number, node, file_.n_nodes());
    }
    result_.add_element(number, block.shape, block.group_list, nodes);
  }

  bool is_node(std::int64_t node) const { return node >= 1 && node <= file_.n_nodes(); }

  /// Blocks and sets each have ids of their own, of up to 64 bits; here they are numbered in order.
  int add_group(int dimension, const std::string& name) {
    const int number = static_cast<int>(result_.group_names.size()) + 1;
    result_.group_names[{dimension, number}] = name;
    return result_.add_group_list({number});
  }

  /// What all ranks find, one of them notes.
  template <class... Arguments>
  void note(fmt::format_string<Arguments...> what, Arguments&&... arguments) {
    if (share_.rank == 0) result_.notes.push_back(fmt::format(what, std::forward<Arguments>(arguments)...));
  }

  // ---- side sets: all ranks look at all members, and each takes the sides of its elements ----

  /// Where the element of a set, counted from 1, is in blocks_.
  std::size_t block_of(const ExodusInput::Set& set, std::int64_t element) const {
    if (element < 1 || element > file_.n_elements()) {
      file_.fail("side set \"{}\" has element {}; allowed are 1 to {}", set.name, element, file_.n_elements());
    }
    const auto next = std::upper_bound(blocks_.begin(), blocks_.end(), element - 1,
                                       [](std::int64_t place, const Block& block) { return place < block.first; });
    return static_cast<std::size_t>(next - blocks_.begin()) - 1;
  }

  std::optional<OwnSide> own_side(std::int64_t place, std::size_t block, std::int64_t element,
                                  std::int64_t number) const {
    const std::int64_t in_block = element - 1 - blocks_[block].first;
    if (!blocks_[block].own.has(in_block)) return std::nullopt;
    const std::int64_t in_lists = blocks_[block].first_in_list + in_block - blocks_[block].own.begin;
    return OwnSide{place, block, static_cast<std::size_t>(in_lists), number};
  }

  std::vector<std::int64_t> nodes_of_side(std::size_t element, const std::vector<int>& corners) const {
    std::vector<std::int64_t> nodes;
    const std::size_t first = result_.first_node[element];
    for (const int corner : corners) nodes.push_back(result_.element_nodes[first + static_cast<std::size_t>(corner)]);
    return nodes;
  }

  /// A set with sides that its elements do not have is left out: perhaps nobody uses it.
  void read_side_set(const ExodusInput::Set& set) {
    std::vector<OwnSide> own;
    std::vector<int> dimensions;  // of its sides, as they come
    bool is_left_out = false;
    file_.for_each_member(set, [&](std::int64_t place, std::int64_t element, std::int64_t number) {
      if (is_left_out) return;
      const std::size_t b = block_of(set, element);
      const std::vector<int> corners = corners_of_side(blocks_[b], number);
      if (corners.empty()) {
        is_left_out = true;
        return note(
            "the side set \"{}\" is left out: it has side {} of element {}, which is none of its edges or faces",
            set.name, number, numbers_of_elements({element - 1, element})[0]);
      }
      const int found = dimension(side_shape(corners.size()));
      if (std::count(dimensions.begin(), dimensions.end(), found) == 0) dimensions.push_back(found);
      if (const auto side = own_side(place, b, element, number)) own.push_back(*side);
    });
    if (!is_left_out) add_side_set(set.name, dimensions, own);
  }

  static std::vector<int> corners_of_side(const Block& block, std::int64_t number) {
    if (!block.has_body) return {};
    return mesh_files::corners_of_side(block.shape, number, block.is_shell);
  }

  void add_side_set(const std::string& name, const std::vector<int>& dimensions, const std::vector<OwnSide>& own) {
    std::map<int, int> list_of_dimension;
    for (const int d : dimensions) list_of_dimension[d] = add_group(d, name);
    for (const OwnSide& side : own) {
      const std::vector<int> corners = corners_of_side(blocks_[side.block], side.number);
      const Shape shape = side_shape(corners.size());
      result_.add_element(side.place + 1, shape, list_of_dimension.at(dimension(shape)),
                          nodes_of_side(side.element, corners));
    }
  }

  // ---- the numbering of the sides of plane elements ----

  std::vector<OwnSide> sides_of_plane_elements() const {
    std::vector<OwnSide> own;
    for (const auto& set : file_.side_sets()) {
      file_.for_each_member(set, [&](std::int64_t place, std::int64_t element, std::int64_t number) {
        const std::size_t b = block_of(set, element);
        if (!blocks_[b].is_plane()) return;
        if (const auto side = own_side(place, b, element, number)) own.push_back(*side);
      });
    }
    return own;
  }

  static Edge edge_of(const std::vector<std::int64_t>& nodes) {
    return {std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1])};
  }

  std::vector<Edge> edges_of_plane_elements() const {
    std::vector<Edge> edges;
    for (std::size_t e = 0; e < result_.n_elements(); ++e) {
      const Shape shape = result_.shapes[e];
      if (dimension(shape) != 2) continue;
      for (const auto& corners : sides(element_type(shape))) edges.push_back(edge_of(nodes_of_side(e, corners)));
    }
    return edges;
  }

  /// By block, over all ranks.
  /// @param other by the numbering that the block's type does not stand for
  std::vector<double> n_sides_at_boundary(const base::Comm& comm, const std::vector<OwnSide>& own, bool other,
                                          const BoundaryEdges& boundary) const {
    const bool has_solids = std::any_of(blocks_.begin(), blocks_.end(),
                                        [](const Block& b) { return b.has_body && dimension(b.shape) == 3; });
    std::vector<double> n(blocks_.size(), 0.);
    std::vector<Edge> edges;
    std::vector<std::size_t> blocks_of_edges;
    for (const OwnSide& side : own) {
      const Block& block = blocks_[side.block];
      const auto corners = mesh_files::corners_of_side(block.shape, side.number, block.is_shell != other);
      if (corners.size() > 2 && has_solids) n[side.block] += 1.;
      if (corners.size() != 2) continue;
      edges.push_back(edge_of(nodes_of_side(side.element, corners)));
      blocks_of_edges.push_back(side.block);
    }
    const std::vector<char> are_at_boundary = boundary.have(comm, edges);
    for (std::size_t i = 0; i < edges.size(); ++i) n[blocks_of_edges[i]] += are_at_boundary[i];
    base::sum(comm, n);
    return n;
  }

  void take_other_numbering(Block& block, long n_other, long n_usual) {
    note("sides of the block \"{}\" are taken as numbered {}: as that, {} of them are at the boundary, otherwise {}",
         block.described.name, block.is_shell ? "from the first edge" : "after two faces", n_other, n_usual);
    block.is_shell = !block.is_shell;
  }

  // ---- node sets: each rank takes its nodes ----

  void read_node_set(const ExodusInput::Set& set) {
    std::map<std::int64_t, std::int64_t> own;  // by number
    file_.for_each_member(set, [&](std::int64_t, std::int64_t node, std::int64_t) {
      if (!is_node(node))
        file_.fail("node set \"{}\" has node {}; allowed are 1 to {}", set.name, node, file_.n_nodes());
      if (own_nodes_.has(node - 1))
        own[result_.node_tags[static_cast<std::size_t>(node - 1 - own_nodes_.begin)]] = node;
    });
    if (set.n_members == 0) return;
    const int list = add_group(0, set.name);
    for (const auto& [number, node] : own) result_.add_element(number, Shape::point, list, {node});
  }

  ExodusInput file_;
  Share share_;
  Range own_nodes_;
  MeshFile result_;
  bool elements_have_numbers_ = true;
  std::vector<Block> blocks_;  ///< those with elements
};

/// What the library will be asked for when each rank reads its share.
void read_all_shares(const std::string& file, int n_ranks) {
  const Teuchos::SerialComm<int> alone;
  for (int rank = 0; rank < n_ranks; ++rank) {
    Reader reader(file, {rank, n_ranks});
    reader.read_numbers(alone);
    reader.read_nodes();
    reader.read_blocks();
    if (n_ranks == 1) reader.choose_side_numbering(alone);
    if (rank == 0) reader.read_sets();  // of which all ranks read the same
  }
}

/// HDF5's library trusts what a file says of itself: damaged ones make it crash or take all memory. So another process
/// reads it first. (Classic headers are checked by ourselves.)
void try_to_read(const std::string& file, int n_ranks) {
  require_regular_file(file, "an Exodus file");
  if (container_of(file) != Container::hdf5) return;
  const std::size_t size = std::filesystem::file_size(file);
  const std::string trouble =
      on_trial([&] { read_all_shares(file, n_ranks); }, trial_memory + trial_memory_per_byte * size,
               static_cast<unsigned>(trial_seconds + size / trial_bytes_per_second));
  if (trouble.empty()) return;
  throw base::UserError(fmt::format("{}: the HDF5 library cannot read it ({}): it is damaged", file, trouble));
}

}  // namespace

MeshFile read_exodus_file(const base::Comm& comm, const std::string& file) {
  const Share share = {comm.getRank(), comm.getSize()};
  base::on_all_ranks(comm, [&] {
    if (share.rank == 0) try_to_read(file, share.n_ranks);
  });
  std::optional<Reader> reader;
  base::on_all_ranks(comm, [&] { reader.emplace(file, share); });
  reader->read_numbers(comm);
  base::on_all_ranks(comm, [&] { reader->read_nodes(); });
  base::on_all_ranks(comm, [&] { reader->read_blocks(); });
  reader->choose_side_numbering(comm);
  base::on_all_ranks(comm, [&] { reader->read_sets(); });
  return reader->put_node_numbers(comm);
}

MeshFile read_exodus_file(const std::string& file) { return read_exodus_file(Teuchos::SerialComm<int>(), file); }

}  // namespace perimorph::mesh_files
