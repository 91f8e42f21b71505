#include "group_checks.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <set>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::cases {

namespace {

using input::in_quotes;
using input::Mistakes;
using Teuchos::ParameterList;

template <int dim>
class GroupChecks {
 public:
  GroupChecks(const ParameterList& list, const std::map<std::string, int>& lines, const mesh::Mesh<dim>& whole,
              Mistakes& mistakes)
      : list_(list), lines_(lines), mesh_(whole), mistakes_(mistakes) {}

  void run() {
    auto is_held = check_conditions("Displacements", mesh_.node_sets, "nodes");
    is_held.merge(check_conditions("Rigid Groups", mesh_.node_sets, "nodes"));
    check_conditions("Symmetry Planes", mesh_.side_sets, "sides");
    check_conditions("Tractions", mesh_.side_sets, "sides");
    check_conditions("Pressures", mesh_.side_sets, "sides");
    check_blocks(list_.sublist("Materials"), "/Materials/");
    check_blocks(list_.sublist("Boundary Conditions").sublist("Temperatures"), "/Boundary Conditions/Temperatures/");
    check_measure();
    check_refinement();
    const ParameterList& output = list_.sublist("Output");
    if (!output.isParameter("Reactions")) return;
    for (const auto& group : output.get<Teuchos::Array<std::string>>("Reactions")) {
      if (is_held.count(group) == 0) check("/Output/Reactions", group, mesh_.node_sets, "nodes");
    }
  }

 private:
  /// Returns the groups.
  template <class Groups>
  std::set<std::string> check_conditions(const std::string& section, const Groups& groups, const char* members) {
    std::set<std::string> named;
    const ParameterList& conditions = list_.sublist("Boundary Conditions").sublist(section);
    for (const auto& item : conditions) {
      const ParameterList& condition = conditions.sublist(item.first);
      if (!condition.isParameter("Group")) continue;
      const auto group = condition.get<std::string>("Group");
      check("/Boundary Conditions/" + section + "/" + item.first + "/Group", group, groups, members);
      named.insert(group);
    }
    return named;
  }

  void check_refinement() {
    const ParameterList& refinement = list_.sublist("Mesh").sublist("Refinement");
    if (!refinement.isParameter("Groups")) return;
    for (const auto& group : refinement.get<Teuchos::Array<std::string>>("Groups")) {
      check("/Mesh/Refinement/Groups", group, mesh_.node_sets, "nodes");
    }
  }

  void check_measure() {
    const ParameterList& measure = list_.sublist("Loading").sublist("Measure");
    for (const char* name : {"Group", "Other Group"}) {
      if (!measure.isParameter(name)) continue;
      check(std::string("/Loading/Measure/") + name, measure.get<std::string>(name), mesh_.node_sets, "nodes");
    }
  }

  /// Those that the entries of a section name.
  void check_blocks(const ParameterList& entries, const std::string& path) {
    std::map<std::string, int> blocks;
    for (const auto& name : mesh_.block_names) blocks[name] = 0;
    for (const auto& item : entries) {
      const ParameterList& entry = entries.sublist(item.first);
      if (!entry.isParameter("Blocks")) continue;
      for (const auto& block : entry.get<Teuchos::Array<std::string>>("Blocks")) {
        check(path + item.first + "/Blocks", block, blocks, "elements");
      }
    }
  }

  template <class Groups>
  void check(const std::string& path, const std::string& group, const Groups& groups, const char* members) {
    if (groups.count(group) != 0) return;
    std::vector<std::string> names;
    for (const auto& entry : groups) names.push_back(entry.first);
    mistakes_.add(input::line_of(lines_, path), path,
                  fmt::format("the mesh {} has no group of {} called {}; it has {}{}{}",
                              list_.sublist("Mesh").get<std::string>("File"), members, in_quotes(group),
                              names.empty() ? "none" : base::quoted_list(names), what_it_is(group),
                              base::did_you_mean(group, names)));
  }

  /// Of a group that exists, but has members of another dimension.
  std::string what_it_is(const std::string& group) const {
    const auto& blocks = mesh_.block_names;
    if (std::find(blocks.begin(), blocks.end(), group) != blocks.end()) {
      return fmt::format(" ({} is a group of elements)", in_quotes(group));
    }
    for (const std::string& note : mesh_.notes) {
      if (note.find(in_quotes(group)) != std::string::npos) return fmt::format(" ({})", note);
    }
    return mesh_.node_sets.count(group) != 0 ? fmt::format(" ({} has nodes only)", in_quotes(group)) : "";
  }

  const ParameterList& list_;
  const std::map<std::string, int>& lines_;
  const mesh::Mesh<dim>& mesh_;
  Mistakes& mistakes_;
};

}  // namespace

template <int dim>
void check_groups(const ParameterList& list, const std::map<std::string, int>& lines, const mesh::Mesh<dim>& whole,
                  input::Mistakes& mistakes) {
  GroupChecks<dim>(list, lines, whole, mistakes).run();
}

template void check_groups(const ParameterList&, const std::map<std::string, int>&, const mesh::Mesh<2>&,
                           input::Mistakes&);
template void check_groups(const ParameterList&, const std::map<std::string, int>&, const mesh::Mesh<3>&,
                           input::Mistakes&);

}  // namespace perimorph::cases
