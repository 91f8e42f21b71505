#pragma once

#include <exodusII.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "share.hpp"

namespace perimorph::mesh_files {

enum class Container { netcdf, hdf5 };

/// What the first bytes say that an Exodus file is, before a library opens it. Local.
/// @throws base::UserError if it is neither, or if a netCDF file's header does not fit the file.
Container container_of(const std::string& file);

/// An Exodus file, of which any part can be read by itself. Places in it are counted from 0, its nodes and elements
/// from
/// 1. All functions are local, and throw base::UserError with the file's name if it cannot hold what it announces or
/// something cannot be read.
class ExodusInput {
 public:
  struct Block {
    std::int64_t id;
    std::string name, type;
    std::int64_t n_elements = 0, n_nodes = 0;  ///< nodes per element
  };

  struct Set {
    ex_entity_type kind;
    std::int64_t id;
    std::string name;
    std::int64_t n_members = 0;
  };

  explicit ExodusInput(const std::string& file);
  ~ExodusInput();
  ExodusInput(const ExodusInput&) = delete;
  ExodusInput& operator=(const ExodusInput&) = delete;

  int n_dimensions() const { return static_cast<int>(sizes_.num_dim); }
  std::int64_t n_nodes() const { return sizes_.num_nodes; }
  std::int64_t n_elements() const { return sizes_.num_elem; }

  /// In the file's order. Those without a name are called by their number.
  std::vector<Block> blocks() const;
  std::vector<Set> side_sets() const { return sets(EX_SIDE_SET, sizes_.num_side_sets, "side sets", "sides"); }
  std::vector<Set> node_sets() const { return sets(EX_NODE_SET, sizes_.num_node_sets, "node sets", "nodes"); }

  /// The numbers that the file gives to nodes (EX_NODE_MAP) or elements (EX_ELEM_MAP).
  std::vector<std::int64_t> numbers(ex_entity_type map, const Range& range) const;

  /// By axis, (3, range.size()); z is 0 if the file has none.
  std::array<std::vector<double>, 3> coordinates(const Range& range) const;

  /// Throws unless the file can hold so many elements with so many nodes.
  void check_size(const Block& block) const {
    held(block.n_elements, block.n_nodes * static_cast<std::int64_t>(sizeof(int)), "elements");
  }

  /// The nodes of elements of a block, one element after the other.
  std::vector<std::int64_t> nodes_of_elements(const Block& block, const Range& range) const;

  /// Calls visit(place in the set, node or element, side of it) for all members of a set, some of them read at a time.
  void for_each_member(const Set& set,
                       const std::function<void(std::int64_t, std::int64_t, std::int64_t)>& visit) const;

  template <class... Arguments>
  [[noreturn]] void fail(fmt::format_string<Arguments...> what, Arguments&&... arguments) const {
    fail_with(fmt::format(what, std::forward<Arguments>(arguments)...));
  }

 private:
  [[noreturn]] void fail_with(const std::string& what) const;
  void read_sizes();
  void check(int status, const std::string& what) const;
  std::int64_t held(std::int64_t count, std::int64_t bytes, const std::string& what) const;
  std::vector<std::int64_t> ids(ex_entity_type kind, std::int64_t count, const std::string& what) const;
  std::string name_of(ex_entity_type kind, std::int64_t id, const char* unnamed) const;
  Block block(std::int64_t id) const;
  std::vector<Set> sets(ex_entity_type kind, std::int64_t count, const std::string& what, const char* unnamed) const;

  std::string file_;
  Container container_;
  int id_ = -1;
  ex_init_params sizes_{};
};

/// How many elements, or members of a set, are read at a time.
constexpr std::int64_t most_at_once = std::int64_t{1} << 20;

}  // namespace perimorph::mesh_files
