// The MSH formats 2.0 to 4.1, as in "File formats" of gmsh's manual (that of 4.8 for 4.x; the older ones as gmsh reads
// and writes them).

#include "gmsh_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <set>
#include <type_traits>

#include "file_cursor.hpp"
#include "gmsh_elements.hpp"
#include "gmsh_groups.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

namespace {

const char* const advice =
    "mesh it with gmsh -2 (or -3), and put what is to be computed into a physical surface (or volume)";

/// Nodes, and elements by dimension: which are wanted.
struct Parts {
  Range nodes;
  std::array<Range, 4> elements;
};
constexpr Parts nothing = {}, all = {everything, {everything, everything, everything, everything}};

/// Of nodes, and of elements of dimension 0 to 3.
using Counts = std::vector<std::int64_t>;

Parts share_of(const Counts& counts, const Share& share) {
  Parts parts = {share.of(counts[0]), {}};
  for (std::size_t d = 0; d < 4; ++d) parts.elements[d] = share.of(counts[d + 1]);
  return parts;
}

/// Reads one file from front to back.
class Reader {
 public:
  enum class Purpose { read, count };

  Reader(const std::string& file, const Parts& wanted, Purpose purpose = Purpose::read)
      : cursor_(file, "a gmsh mesh"), wanted_(wanted), counts_only_(purpose == Purpose::count) {
    result_.name = file;
    result_.advice = advice;
  }

  MeshFile read() {
    read_format();
    while (skip_to_section()) read_section();
    for (const char* needed : {"$Nodes", "$Elements"}) {
      if (sections_.count(needed) == 0) {
        cursor_.fail(fmt::format("the file ends without {}: it is truncated or holds no mesh", needed));
      }
    }
    groups_.finish();
    return std::move(result_);
  }

  /// Of what has been read or passed over.
  Counts counts() const {
    Counts counts = {n_nodes_};
    counts.insert(counts.end(), n_elements_.begin(), n_elements_.end());
    return counts;
  }

 private:
  // ---- the file's frame ----

  /// Lines outside sections are comments, as to gmsh.
  bool skip_to_section() {
    while (!cursor_.at_end() && !cursor_.next_is('$')) cursor_.line();
    return !cursor_.at_end();
  }

  void read_format() {
    const std::string first = cursor_.line();
    std::string name = first;
    while (name != "$MeshFormat") {
      if (name == "$Comments") cursor_.skip_past_line("$EndComments");
      const bool is_other_section = !name.empty() && name[0] == '$' && name != "$Comments";
      if (is_other_section || !skip_to_section()) {
        cursor_.fail(fmt::format("not a gmsh mesh: its first section must be $MeshFormat, found \"{}\"",
                                 excerpt(is_other_section ? name : first)));
      }
      name = cursor_.line();
    }
    const double version = cursor_.ascii_real();
    const std::int64_t type = cursor_.ascii_long(), size = cursor_.ascii_long();
    version_ = static_cast<int>(std::lround(10. * version));
    groups_.set_version(version_);
    if (!(version >= 2. && version < 3.) && version != 3. && version != 4. && version != 4.1) {
      cursor_.fail(
          fmt::format("MSH version {}; allowed are 2.0 to 4.1 (convert it: gmsh -save -format msh41 -o new.msh "
                      "old.msh)",
                      version));
    }
    if (type < 0 || type > 1 || (type == 1 && size != 8)) {
      cursor_.fail(
          fmt::format("after the version \"0 8\" (ASCII) or \"1 8\" (binary) expected, found \"{} {}\"", type, size));
    }
    if (type == 1) read_byte_order();
    cursor_.expect("$EndMeshFormat");
  }

  void read_byte_order() {
    cursor_.skip_line_break();
    cursor_.set_binary();
    if (const int one = cursor_.next_int(); one == 0x01000000) {
      cursor_.fail(
          "the file was written on a machine of the other byte order (endianness): convert it there to ASCII "
          "(gmsh -save -format msh41 -o new.msh old.msh)");
    } else if (one != 1) {
      cursor_.fail(fmt::format("the number 1 expected after the format, found {}: the file is damaged", one));
    }
  }

  void read_section() {
    const std::string name = cursor_.line();
    if (name.size() < 2 || name.rfind("$End", 0) == 0) {
      cursor_.fail(fmt::format("a section such as $Nodes expected, found \"{}\"", excerpt(name)));
    }
    sections_.insert(name);
    const std::string end = "$End" + name.substr(1);
    if (name == "$PhysicalNames") {
      groups_.read_names();
    } else if (name == "$Entities" && version_ >= 30) {
      groups_.read_entities();
    } else if (name == "$PartitionedEntities" && version_ >= 40) {
      groups_.read_partitioned_entities();
    } else if (name == "$Nodes") {
      version_ >= 40 ? read_nodes_4() : read_nodes_before_4();
    } else if (name == "$Elements") {
      version_ >= 40 ? read_elements_4() : read_elements_before_4();
    } else {
      cursor_.skip_to_line(end);
    }
    cursor_.expect(end);
  }

  /// Numbers of nodes and elements have 8 bytes in 4.1, before it 4.
  std::int64_t next_tag() { return version_ == 41 ? cursor_.next_long() : cursor_.next_int(); }

  // ---- 4.x: nodes and elements come by entity ----

  void read_nodes_4() {
    const std::size_t n_blocks = cursor_.checked(cursor_.next_long(), 4, 20);
    const std::size_t n_nodes = cursor_.checked(cursor_.next_long(), 4, 28);
    skip_range();
    reserve_nodes(n_nodes);
    for (std::size_t b = 0; b < n_blocks; ++b) read_node_block();
    check_total("nodes", n_nodes, n_nodes_);
  }

  /// 4.1 says which numbers are the smallest and the largest.
  void skip_range() {
    if (version_ != 41) return;
    cursor_.next_long();
    cursor_.next_long();
  }

  /// 4.0 has the number first, 4.1 the dimension.
  GmshGroups::Entity next_entity() {
    const int first = cursor_.next_int(), second = cursor_.next_int();
    return version_ == 41 ? GmshGroups::Entity{first, second} : GmshGroups::Entity{second, first};
  }

  void read_node_block() {
    const int dimension = next_entity().first;
    const int n_parameters = cursor_.next_int() == 0 ? 0 : dimension;
    if (n_parameters < 0 || n_parameters > 3) {
      cursor_.fail(fmt::format("nodes of an entity of dimension {}: the file is damaged", dimension));
    }
    const auto n = static_cast<std::int64_t>(cursor_.checked(cursor_.next_long(), 4, 28));
    const Range wanted = Range{0, n}.overlap(wanted_.nodes.from(n_nodes_));
    n_nodes_ += n;
    if (version_ == 40) return read_numbered_nodes(n, wanted, n_parameters);
    skip_numbers<std::int64_t>(wanted.begin);
    for (std::int64_t i = 0; i < wanted.size(); ++i) result_.node_tags.push_back(cursor_.next_long());
    skip_numbers<std::int64_t>(n - wanted.end);
    skip_numbers<double>(wanted.begin * (3 + n_parameters));
    for (std::int64_t i = 0; i < wanted.size(); ++i) {
      read_coordinates();
      for (int p = 0; p < n_parameters; ++p) cursor_.next_real();
    }
    skip_numbers<double>((n - wanted.end) * (3 + n_parameters));
  }

  /// Of 4.0: each node with its number.
  void read_numbered_nodes(std::int64_t n, const Range& wanted, int n_parameters) {
    for (std::int64_t i = 0; i < n; ++i) {
      if (!wanted.has(i)) {
        skip_numbers<int>(1);
        skip_numbers<double>(3 + n_parameters);
        continue;
      }
      result_.node_tags.push_back(cursor_.next_int());
      read_coordinates();
      for (int p = 0; p < n_parameters; ++p) cursor_.next_real();
    }
  }

  void read_elements_4() {
    const std::size_t n_blocks = cursor_.checked(cursor_.next_long(), 4, 20);
    const std::size_t n_elements = cursor_.checked(cursor_.next_long(), 2, 8);
    skip_range();
    reserve_elements(n_elements);
    for (std::size_t b = 0; b < n_blocks; ++b) read_element_block();
    check_total("elements", n_elements, n_elements_so_far());
  }

  void read_element_block() {
    const GmshGroups::Entity entity = next_entity();
    const int number_of_kind = cursor_.next_int();
    const int groups = groups_.list_of_entity(entity);
    const auto n = static_cast<std::int64_t>(cursor_.checked(cursor_.next_long(), 2, 8));
    if (n == 0) return;
    const GmshKind& kind =
        find_kind(number_of_kind) == nullptr ? kind_of(next_tag(), number_of_kind) : *find_kind(number_of_kind);
    const int dimension_of_kind = dimension(kind.shape);
    groups_.use(dimension_of_kind, groups);
    const Range wanted = Range{0, n}.overlap(wanted_.elements[dimension_of_kind].from(n_elements_[dimension_of_kind]));
    n_elements_[dimension_of_kind] += n;
    skip_tags(wanted.begin * (1 + kind.n_nodes));
    for (std::int64_t i = 0; i < wanted.size(); ++i) {
      const std::int64_t tag = next_tag();
      read_corners(tag, kind, groups);
    }
    skip_tags((n - wanted.end) * (1 + kind.n_nodes));
  }

  // ---- before 4: counts are text, numbers have 4 bytes ----

  void read_nodes_before_4() {
    const std::int64_t count = cursor_.ascii_long();
    skip_to_data();
    const std::size_t n_nodes = cursor_.checked(count, 4, 28);
    reserve_nodes(n_nodes);
    for (std::size_t i = 0; i < n_nodes; ++i) {
      if (wanted_.nodes.has(n_nodes_++)) {
        result_.node_tags.push_back(cursor_.next_int());
        read_coordinates();
      } else {
        skip_numbers<int>(1);
        skip_numbers<double>(3);
      }
      if (version_ == 30) skip_place_on_entity();
    }
  }

  void skip_place_on_entity() {
    if (cursor_.next_int() == 0) return;
    for (int dimension = cursor_.next_int(); dimension > 0; --dimension) cursor_.next_real();
  }

  void read_elements_before_4() {
    const std::int64_t count = cursor_.ascii_long();
    skip_to_data();
    const std::size_t n_elements = cursor_.checked(count, 4, 8);
    reserve_elements(n_elements);
    const auto end = static_cast<std::int64_t>(n_elements);
    while (n_elements_so_far() < end) {
      if (version_ == 30) {
        read_element_3();
      } else if (cursor_.binary()) {
        read_binary_run(static_cast<std::size_t>(end - n_elements_so_far()));
      } else {
        read_element();
      }
    }
  }

  /// number, kind, entity, count of what follows: nodes, then partitions
  void read_element_3() {
    const int tag = cursor_.next_int(), number_of_kind = cursor_.next_int(), entity = cursor_.next_int();
    const int n_numbers = cursor_.next_int();
    const GmshKind& kind = kind_of(tag, number_of_kind);
    read_or_skip_corners(tag, kind, groups_.list_of_entity({dimension(kind.shape), entity}));
    for (int n = n_numbers - kind.n_nodes; n > 0; --n) cursor_.next_int();
  }

  /// number, kind, number of tags, tags, nodes
  void read_element() {
    const int number = cursor_.next_int(), kind = cursor_.next_int(), n_tags = cursor_.next_int();
    read_tags_and_corners(number, kind, n_tags);
  }

  /// kind, number of elements, number of tags; then for each element its number, tags, nodes
  void read_binary_run(std::size_t most) {
    const int kind = cursor_.next_int(), n_elements = cursor_.next_int(), n_tags = cursor_.next_int();
    if (n_elements < 1 || static_cast<std::size_t>(n_elements) > most) {
      cursor_.fail(
          fmt::format("a run of {} elements, where 1 to {} can follow: the file is damaged", n_elements, most));
    }
    for (int i = 0; i < n_elements; ++i) {
      const int number = cursor_.next_int();
      read_tags_and_corners(number, kind, n_tags);
    }
  }

  void read_tags_and_corners(int number, int number_of_kind, int n_tags) {
    int group = 0;  // the first tag; 0 is none
    for (int t = 0; t < n_tags; ++t) {
      const int tag = cursor_.next_int();
      if (t == 0) group = tag;
    }
    read_or_skip_corners(number, kind_of(number, number_of_kind), groups_.list_of_group(group));
  }

  void read_or_skip_corners(std::int64_t tag, const GmshKind& kind, int groups) {
    const int dimension_of_kind = dimension(kind.shape);
    groups_.use(dimension_of_kind, groups);
    const bool is_wanted = wanted_.elements[dimension_of_kind].has(n_elements_[dimension_of_kind]++);
    is_wanted ? read_corners(tag, kind, groups) : skip_tags(kind.n_nodes);
  }

  // ---- common to all ----

  void skip_to_data() {
    if (cursor_.binary()) cursor_.skip_line_break();
  }

  std::int64_t n_elements_so_far() const {
    return std::accumulate(n_elements_.begin(), n_elements_.end(), std::int64_t{0});
  }

  /// Whoever wants nothing looks for mistakes; but binary 4.x is gone through by blocks.
  template <class Number>
  void skip_numbers(std::int64_t n) {
    const bool checks = counts_only_ && !(cursor_.binary() && version_ >= 40);
    if (!checks) return cursor_.skip_numbers(static_cast<std::size_t>(n), sizeof(Number));
    for (; n > 0; --n) {
      if constexpr (std::is_same_v<Number, double>) {
        cursor_.next_real();
      } else if constexpr (std::is_same_v<Number, int>) {
        cursor_.next_int();
      } else {
        cursor_.next_long();
      }
    }
  }

  void skip_tags(std::int64_t n) { version_ == 41 ? skip_numbers<std::int64_t>(n) : skip_numbers<int>(n); }

  void reserve_nodes(std::size_t announced) {
    const auto n = static_cast<std::size_t>(announced_range(announced).overlap(wanted_.nodes).size());
    result_.node_tags.reserve(n);
    result_.coordinates.reserve(n);
  }

  /// For the share of all as if all were of one dimension.
  void reserve_elements(std::size_t announced) {
    std::int64_t most = 0;
    for (const Range& range : wanted_.elements) most += announced_range(announced).overlap(range).size();
    const std::size_t n = std::min(announced, static_cast<std::size_t>(most));
    result_.element_tags.reserve(n);
    result_.shapes.reserve(n);
    result_.element_groups.reserve(n);
    result_.first_node.reserve(n + 1);
  }

  void read_coordinates() {
    auto& point = result_.coordinates.emplace_back();
    for (auto& x : point) x = cursor_.next_real();
  }

  const GmshKind& kind_of(std::int64_t tag, int number_of_kind) const {
    if (const GmshKind* kind = find_kind(number_of_kind)) return *kind;
    cursor_.fail(
        fmt::format("element {} is of gmsh's kind {}; allowed are triangles and quadrangles in 2D, tetrahedra, "
                    "pyramids, prisms and hexahedra in 3D, of first or second order (Mesh.ElementOrder)",
                    tag, number_of_kind));
  }

  void read_corners(std::int64_t tag, const GmshKind& kind, int groups) {
    result_.begin_element(tag, kind.shape, groups);
    const int n_corners = n_nodes(kind.shape);
    for (int i = 0; i < n_corners; ++i) result_.element_nodes.push_back(next_tag());
    result_.end_element();
    if (kind.n_nodes == n_corners) return;
    for (int i = n_corners; i < kind.n_nodes; ++i) result_.mid_nodes.push_back(next_tag());
    ++result_.n_second_order[dimension(kind.shape)];
  }

  static Range announced_range(std::size_t n) { return {0, static_cast<std::int64_t>(n)}; }

  void check_total(const char* what, std::size_t announced, std::int64_t found) {
    if (found == static_cast<std::int64_t>(announced)) return;
    cursor_.fail(fmt::format("{} {} announced, {} found: the file is damaged", announced, what, found));
  }

  FileCursor cursor_;
  Parts wanted_;
  bool counts_only_;
  std::int64_t n_nodes_ = 0;  // read or passed over so far
  std::array<std::int64_t, 4> n_elements_{};
  MeshFile result_;
  GmshGroups groups_{cursor_, result_};
  int version_ = 0;  // 22 for 2.2
  std::set<std::string> sections_;
};

Counts counts_of(const std::string& file) {
  Reader reader(file, nothing, Reader::Purpose::count);
  reader.read();
  return reader.counts();
}

}  // namespace

MeshFile read_gmsh_file(const std::string& file, const Share& share) {
  return Reader(file, share.is_whole() ? all : share_of(counts_of(file), share)).read();
}

MeshFile read_gmsh_file(const base::Comm& comm, const std::string& file) {
  const Share share = {comm.getRank(), comm.getSize()};
  Parts wanted = all;
  if (!share.is_whole()) {
    Counts counts;
    base::on_all_ranks(comm, [&] {
      if (share.rank == 0) counts = counts_of(file);
    });
    wanted = share_of(base::gather_on_all(comm, counts), share);
  }
  MeshFile part;
  base::on_all_ranks(comm, [&] { part = Reader(file, wanted).read(); });
  return part;
}

}  // namespace perimorph::mesh_files
