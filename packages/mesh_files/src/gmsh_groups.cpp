#include "gmsh_groups.hpp"

#include <array>
#include <cstdlib>

#include "perimorph/base/errors.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int no_groups = 0;       // index into MeshFile::group_lists
constexpr int any_dimension = -1;  // of a name in 2.0

/// A negative number stands for the group with reversed orientation.
int group_number(int signed_number) { return static_cast<int>(std::abs(static_cast<long>(signed_number))); }

}  // namespace

void GmshGroups::read_entities() { version_ == 30 ? read_entities_3() : read_entities_4(); }

void GmshGroups::finish() {
  check_all_partitions_are_there();
  put_elements_in_groups();
  name_the_unnamed();
}

/// Text in all flavours: count, then lines: dimension (not in 2.0), number, name, which some programs write without
/// quotes.
void GmshGroups::read_names() {
  for (std::int64_t n = cursor_.ascii_long(); n > 0; --n) {
    const int dimension = version_ == 20 ? any_dimension : cursor_.ascii_int(), number = cursor_.ascii_int();
    std::string name = cursor_.line();
    if (const std::size_t begin = name.find('"'); begin != std::string::npos) {
      const std::size_t end = name.find('"', begin + 1);
      if (end == std::string::npos) {
        cursor_.fail(
            fmt::format("the name of physical group {} has one quote only, found \"{}\"", number, excerpt(name)));
      }
      name = name.substr(begin + 1, end - begin - 1);
    }
    names_[{dimension, number}] = name;
  }
}

std::vector<int> GmshGroups::read_groups() {
  std::vector<int> groups(cursor_.checked(cursor_.next_long(), 1, 4));
  for (auto& group : groups) group = group_number(cursor_.next_int());
  return groups;
}

void GmshGroups::skip_list() {
  for (std::size_t n = cursor_.checked(cursor_.next_long(), 1, 4); n > 0; --n) cursor_.next_int();
}

void GmshGroups::read_entities_4() {
  read_all_entities([this](int dimension) {
    const int number = cursor_.next_int();
    skip_box(dimension);
    const auto groups = read_groups();
    if (dimension > 0) skip_list();  // its boundary
    groups_of_[{dimension, number}] = result_.add_group_list(groups);
  });
}

/// In 3.0 all is text, the boundary comes first, and there is no box.
void GmshGroups::read_entities_3() {
  std::array<std::size_t, 4> counts;
  for (auto& count : counts) count = static_cast<std::size_t>(std::max(0, cursor_.ascii_int()));
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      const int number = cursor_.ascii_int();
      if (dimension > 0) read_text_list();
      groups_of_[{dimension, number}] = result_.add_group_list(read_text_list());
    }
  }
}

std::vector<int> GmshGroups::read_text_list() {
  std::vector<int> groups;
  for (int n = cursor_.ascii_int(); n > 0; --n) groups.push_back(group_number(cursor_.ascii_int()));
  return groups;
}

/// An entity of a partition has the groups of the one that it is a part of. Those between partitions, which are of
/// lower dimension than that, have none.
void GmshGroups::read_partitioned_entities() {
  n_partitions_ = cursor_.next_long();
  for (std::size_t n = cursor_.checked(cursor_.next_long(), 2, 8); n > 0; --n) {  // ghosts: entity, partition
    cursor_.next_int();
    cursor_.next_int();
  }
  read_all_entities([this](int dimension) {
    const int number = cursor_.next_int(), parent_dimension = cursor_.next_int(), parent = cursor_.next_int();
    std::vector<int> partitions(cursor_.checked(cursor_.next_long(), 1, 4));
    for (int& partition : partitions) partition = cursor_.next_int();
    if (partitions.size() == 1) partitions_.insert(partitions[0]);  // others are of what lies between partitions
    skip_box(dimension);
    read_groups();
    if (dimension > 0) skip_list();
    parents_[{dimension, number}] = {parent_dimension, parent};
  });
}

template <class ReadEntity>
void GmshGroups::read_all_entities(ReadEntity read_entity) {
  std::array<std::size_t, 4> counts;
  for (auto& count : counts) count = cursor_.checked(cursor_.next_long(), 2, 8);
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[dimension]; ++i) read_entity(dimension);
  }
}

void GmshGroups::skip_box(int dimension) {
  const int n = dimension == 0 && version_ == 41 ? 3 : 6;
  for (int i = 0; i < n; ++i) cursor_.next_real();
}

void GmshGroups::check_all_partitions_are_there() {
  if (n_partitions_ <= static_cast<std::int64_t>(partitions_.size())) return;
  cursor_.fail(fmt::format("the file holds partition {} of {} only: save the mesh as one file (without -part_split)",
                           fmt::join(partitions_, ", "), n_partitions_));
}

/// The place in group_lists for elements of an entity, filled when all of the file is read.
int GmshGroups::list_of_entity(const Entity& entity) {
  const auto [found, is_new] = list_of_entity_.emplace(entity, no_groups);
  if (is_new) found->second = result_.add_group_list({});
  return found->second;
}

void GmshGroups::put_elements_in_groups() {
  for (const auto& [entity, list] : list_of_entity_) {
    const auto part = parents_.find(entity);
    const Entity whole = part == parents_.end() ? entity : part->second;
    const auto groups = groups_of_.find(whole);
    if (groups == groups_of_.end() || whole.first != entity.first) continue;
    result_.group_lists[list] = result_.group_lists[groups->second];
  }
}

int GmshGroups::list_of_group(int signed_number) {
  const int group = group_number(signed_number);
  if (group == 0) return no_groups;
  const auto found = list_of_group_.find(group);
  return found != list_of_group_.end() ? found->second : list_of_group_[group] = result_.add_group_list({group});
}

void GmshGroups::name_the_unnamed() {
  static constexpr std::array<const char*, 4> entities = {"point", "curve", "surface", "volume"};
  for (const auto& [dimension, list] : lists_in_use_) {
    for (const int group : result_.group_lists[list]) {
      std::string& name = result_.group_names[{dimension, group}];
      if (name.empty()) name = name_of({dimension, group});
      if (name.empty()) name = fmt::format("{}_{}", entities[dimension], group);
    }
  }
}

/// As given in the file, or "".
std::string GmshGroups::name_of(const GroupKey& group) const {
  for (const int dimension : {group.first, any_dimension}) {
    if (const auto found = names_.find({dimension, group.second}); found != names_.end()) return found->second;
  }
  return "";
}

}  // namespace perimorph::mesh_files
