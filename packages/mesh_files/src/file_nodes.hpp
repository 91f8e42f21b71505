#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mesh_file.hpp"
#include "perimorph/base/slices.hpp"
#include "remarks.hpp"
#include "tag_directory.hpp"

namespace perimorph::mesh_files {

/// Numbers tags from 0 by their first appearance. Local.
class TagNumbers {
 public:
  int number_of(std::int64_t tag) {
    const auto [entry, is_new] = numbers_.emplace(tag, static_cast<int>(tags_.size()));
    if (is_new) tags_.push_back(tag);
    return entry->second;
  }
  const std::vector<std::int64_t>& tags() const { return tags_; }  ///< by number

 private:
  std::vector<std::int64_t> tags_;
  std::unordered_map<std::int64_t, int> numbers_;
};

/// A node of the mesh: its number there, and where it is, [length].
template <int dim>
struct UsedNode {
  GlobalId id;
  std::array<double, dim> x;
};

/// The nodes of a file, of which each rank has a slice, and which of them the mesh has. A node's place is where it
/// stands in the file.
template <int dim>
class FileNodes {
 public:
  static constexpr GlobalId none = TagDirectory::none;

  /// Collective.
  /// @param slice is kept as a reference
  /// @param scale factor on coordinates [-]
  /// @throws UserError if two nodes have one tag
  FileNodes(const base::Comm& comm, const MeshFile& slice, double scale, const Remarks& remarks);

  /// The place of each tag, none if the file does not list it. Collective.
  std::vector<GlobalId> places_of(const std::vector<std::int64_t>& tags) const;

  /// Makes nodes those of the mesh, numbered in the file's order. Collective; called once.
  /// @param places that this rank's elements use
  /// @return of each place the node
  /// @throws UserError if they do not lie in a plane, or are too far away for numbers
  std::vector<UsedNode<dim>> use(const std::vector<GlobalId>& places);

  /// How many nodes the mesh has.
  GlobalId n_used() const { return n_used_; }

  /// The number in the mesh of the node at each place, or none if the mesh does not use it. Collective.
  std::vector<GlobalId> ids_of(const std::vector<GlobalId>& places) const;

  /// Notes which nodes are not used, those between the corners of elements of second order apart. Collective.
  /// @param n_elements of the mesh
  void note_unused(GlobalId n_elements, Remarks& remarks) const;

 private:
  std::vector<int> holders_of(const std::vector<GlobalId>& places) const;
  std::size_t index_of(GlobalId place) const { return static_cast<std::size_t>(place - first_place()); }
  GlobalId first_place() const { return places_.begin(comm_.getRank()); }
  void check_flat() const;
  void check_size() const;
  std::array<double, dim> scaled(std::size_t index) const;
  std::vector<char> are_between_corners() const;

  const base::Comm& comm_;
  const MeshFile& slice_;
  double scale_;
  const Remarks& remarks_;
  base::Slices places_;
  TagDirectory place_of_tag_;
  std::vector<GlobalId> ids_;  // in the mesh, of the slice's nodes
  GlobalId n_used_ = 0;
};

}  // namespace perimorph::mesh_files
