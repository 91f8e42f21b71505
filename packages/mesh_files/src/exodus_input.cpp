#include "exodus_input.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "classic_header.hpp"
#include "file_cursor.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int longest_name = 256;
constexpr std::int64_t best_packing = 1032;  // of HDF5's compression (deflate)

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

std::string without_padding(std::string text) {
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

}  // namespace

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

ExodusInput::ExodusInput(const std::string& file) : file_(file), container_(container_of(file)) {
  int our_word_size = sizeof(double), file_word_size = 0;
  float version = 0.F;
  {
    const Silence silence;
    const std::string path = std::filesystem::absolute(file).lexically_normal();  // a relative one may be an address
    id_ = ex_open(path.c_str(), EX_READ | EX_ALL_INT64_API, &our_word_size, &file_word_size, &version);
  }
  if (id_ < 0) fail("the file cannot be opened: it is truncated or damaged, or holds no Exodus data");
  try {
    read_sizes();
  } catch (...) {
    ex_close(id_);
    throw;
  }
}

ExodusInput::~ExodusInput() { ex_close(id_); }

void ExodusInput::fail_with(const std::string& what) const { throw base::UserError(file_ + ": " + what); }

/// A status below 0 is an error, one above a warning.
void ExodusInput::check(int status, const std::string& what) const {
  if (status < 0) fail("the {} cannot be read: the file is truncated or damaged", what);
}

/// A count, if a file of this size can hold so many items of so many bytes.
std::int64_t ExodusInput::held(std::int64_t count, std::int64_t bytes, const std::string& what) const {
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file_));
  const std::int64_t most = (container_ == Container::hdf5 ? best_packing : 1) * size / bytes;
  if (count < 0 || count > most) {
    fail("{} {} announced, but a file of {} bytes holds at most {}: it is damaged", count, what, size, most);
  }
  return count;
}

void ExodusInput::read_sizes() {
  check(ex_get_init_ext(id_, &sizes_), "header");
  if (sizes_.num_dim != 2 && sizes_.num_dim != 3) fail("found {} dimensions; allowed are 2 and 3", sizes_.num_dim);
  held(sizes_.num_nodes, sizes_.num_dim * static_cast<std::int64_t>(sizeof(float)), "nodes");
  held(sizes_.num_elem, sizeof(int), "elements");
  held(sizes_.num_elem_blk, sizeof(int), "element blocks");
  held(sizes_.num_node_sets, sizeof(int), "node sets");
  held(sizes_.num_side_sets, sizeof(int), "side sets");
  const auto longest = ex_inquire_int(id_, EX_INQ_DB_MAX_USED_NAME_LENGTH);
  ex_set_max_name_length(id_, static_cast<int>(std::clamp<std::int64_t>(longest, 32, longest_name)));
}

std::vector<std::int64_t> ExodusInput::ids(ex_entity_type kind, std::int64_t count, const std::string& what) const {
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
  if (count > 0) check(ex_get_ids(id_, kind, numbers.data()), "numbers of the " + what);
  return numbers;
}

std::string ExodusInput::name_of(ex_entity_type kind, std::int64_t id, const char* unnamed) const {
  std::string name(longest_name + 1, '\0');
  if (ex_get_name(id_, kind, id, name.data()) < 0) name.clear();
  name = without_padding(name);
  if (base::has_control_characters(name)) {
    fail("the name \"{}\" has control characters; allowed are readable names", excerpt(name));
  }
  return name.empty() ? fmt::format("{}_{}", unnamed, id) : name;
}

std::vector<ExodusInput::Block> ExodusInput::blocks() const {
  std::vector<Block> all;
  std::int64_t n_elements = 0;
  for (const std::int64_t id : ids(EX_ELEM_BLOCK, sizes_.num_elem_blk, "element blocks")) {
    const Block& read = all.emplace_back(block(id));
    if (read.n_elements < 0 || read.n_elements > sizes_.num_elem - n_elements) {
      fail("{} elements announced, but the blocks have more: the file is damaged", sizes_.num_elem);
    }
    n_elements += read.n_elements;
  }
  if (n_elements != sizes_.num_elem) {
    fail("{} elements announced, but the blocks have {}: the file is damaged", sizes_.num_elem, n_elements);
  }
  return all;
}

ExodusInput::Block ExodusInput::block(std::int64_t id) const {
  Block block{id, "", std::string(MAX_STR_LENGTH + 1, '\0')};
  std::int64_t n_edges = 0, n_faces = 0, n_attributes = 0;
  check(ex_get_block(id_, EX_ELEM_BLOCK, id, block.type.data(), &block.n_elements, &block.n_nodes, &n_edges, &n_faces,
                     &n_attributes),
        fmt::format("element block {}", id));
  block.type = without_padding(block.type);
  block.name = name_of(EX_ELEM_BLOCK, id, "block");
  return block;
}

std::vector<ExodusInput::Set> ExodusInput::sets(ex_entity_type kind, std::int64_t count, const std::string& what,
                                                const char* unnamed) const {
  std::vector<Set> all;
  for (const std::int64_t id : ids(kind, count, what)) {
    Set& set = all.emplace_back(Set{kind, id, name_of(kind, id, unnamed)});
    std::int64_t n_factors = 0;
    check(ex_get_set_param(id_, kind, id, &set.n_members, &n_factors), fmt::format("set \"{}\"", set.name));
    held(set.n_members, sizeof(int), "members of a set");
  }
  return all;
}

std::vector<std::int64_t> ExodusInput::numbers(ex_entity_type map, const Range& range) const {
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(range.size()));
  if (range.size() > 0) {
    check(ex_get_partial_id_map(id_, map, range.begin + 1, range.size(), numbers.data()),
          map == EX_NODE_MAP ? "node numbers" : "element numbers");
  }
  return numbers;
}

std::array<std::vector<double>, 3> ExodusInput::coordinates(const Range& range) const {
  std::array<std::vector<double>, 3> axes;
  for (auto& axis : axes) axis.assign(static_cast<std::size_t>(range.size()), 0.);
  if (range.size() > 0) {
    check(ex_get_partial_coord(id_, range.begin + 1, range.size(), axes[0].data(), axes[1].data(),
                               n_dimensions() == 3 ? axes[2].data() : nullptr),
          "coordinates");
  }
  return axes;
}

std::vector<std::int64_t> ExodusInput::nodes_of_elements(const Block& block, const Range& range) const {
  std::vector<std::int64_t> nodes(static_cast<std::size_t>(range.size() * block.n_nodes));
  if (range.size() > 0) {
    check(ex_get_partial_conn(id_, EX_ELEM_BLOCK, block.id, range.begin + 1, range.size(), nodes.data(), nullptr,
                              nullptr),
          fmt::format("elements of block \"{}\"", block.name));
  }
  return nodes;
}

void ExodusInput::for_each_member(const Set& set,
                                  const std::function<void(std::int64_t, std::int64_t, std::int64_t)>& visit) const {
  for (std::int64_t begin = 0; begin < set.n_members; begin += most_at_once) {
    const std::int64_t n = std::min(most_at_once, set.n_members - begin);
    std::vector<std::int64_t> entries(static_cast<std::size_t>(n)), sides(static_cast<std::size_t>(n));
    check(set.kind == EX_SIDE_SET ? ex_get_partial_side_set(id_, set.id, begin + 1, n, entries.data(), sides.data())
                                  : ex_get_partial_node_set(id_, set.id, begin + 1, n, entries.data()),
          fmt::format("set \"{}\"", set.name));
    for (std::size_t i = 0; i < entries.size(); ++i) visit(begin + static_cast<std::int64_t>(i), entries[i], sides[i]);
  }
}

}  // namespace perimorph::mesh_files
