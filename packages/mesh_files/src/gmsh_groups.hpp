#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "file_cursor.hpp"
#include "mesh_file.hpp"

namespace perimorph::mesh_files {

/// The groups of a MSH file. In 3.0 and 4.x points, curves, surfaces and volumes (entities) have groups, and elements
/// name their entity; before, elements name their group.
class GmshGroups {
 public:
  /// A point, curve, surface or volume: its dimension and number.
  using Entity = std::pair<int, int>;

  /// @param cursor at which sections are read; @param result whose groups are filled
  GmshGroups(FileCursor& cursor, MeshFile& result) : cursor_(cursor), result_(result) {}

  /// @param version 22 for 2.2
  void set_version(int version) { version_ = version; }

  // What sections hold.
  void read_names();
  void read_entities();
  void read_partitioned_entities();

  /// The place in group_lists for elements of an entity, or of a group (0 is none; a negative number stands for
  /// the group with reversed orientation).
  int list_of_entity(const Entity& entity);
  int list_of_group(int signed_number);

  /// That there are elements of this dimension with this place in group_lists.
  void use(int dimension, int list) { lists_in_use_.insert({dimension, list}); }

  /// After all sections: which groups there are, and their names. @throws base::UserError if partitions are missing.
  void finish();

 private:
  std::vector<int> read_groups();
  void skip_list();
  void read_entities_3();
  void read_entities_4();
  std::vector<int> read_text_list();
  template <class ReadEntity>
  void read_all_entities(ReadEntity read_entity);
  void skip_box(int dimension);
  void check_all_partitions_are_there();
  void put_elements_in_groups();
  void name_the_unnamed();
  std::string name_of(const GroupKey& group) const;

  FileCursor& cursor_;
  MeshFile& result_;
  int version_ = 0;
  std::map<GroupKey, std::string> names_;
  std::map<Entity, int> groups_of_;       // place in group_lists of an entity's groups
  std::map<Entity, int> list_of_entity_;  // place in group_lists that an entity's elements have
  std::map<Entity, Entity> parents_;      // of a partition's entity: what it is a part of
  std::int64_t n_partitions_ = 0;
  std::set<int> partitions_;
  std::map<int, int> list_of_group_;            // 2.x
  std::set<std::pair<int, int>> lists_in_use_;  // dimension and place in group_lists
};

}  // namespace perimorph::mesh_files
