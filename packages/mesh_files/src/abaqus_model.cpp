#include "abaqus_model.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <unordered_map>

#include "abaqus_elements.hpp"
#include "perimorph/base/errors.hpp"
#include "text_fields.hpp"

namespace perimorph::mesh_files {

bool AbaqusRun::operator<(const AbaqusRun& other) const {
  return std::tie(first, last, step) < std::tie(other.first, other.last, other.step);
}
bool AbaqusRun::operator==(const AbaqusRun& other) const {
  return std::tie(first, last, step) == std::tie(other.first, other.last, other.step);
}

void AbaqusSet::add(std::int64_t number) {
  if (!runs.empty() && runs.back().step == 1 && runs.back().last + 1 == number) {
    runs.back().last = number;
  } else {
    runs.push_back({number, number, 1});
  }
}

void AbaqusSet::add(const AbaqusSet& other) {
  for (const auto& [into, from] : {std::pair{&runs, &other.runs}, {&nodes_of, &other.nodes_of}}) {
    into->insert(into->end(), from->begin(), from->end());
    std::sort(into->begin(), into->end());
    into->erase(std::unique(into->begin(), into->end()), into->end());
  }
}

void AbaqusSet::shift(std::int64_t offset) {
  for (auto* list : {&runs, &nodes_of}) {
    for (AbaqusRun& run : *list) run = {run.first + offset, run.last + offset, run.step};
  }
}

void AbaqusSurface::shift(std::int64_t offset) {
  nodes.shift(offset);
  for (Item& item : items) item.elements.shift(offset);
}

void AbaqusPart::shift(std::int64_t offset) {
  for (std::int64_t& number : node_numbers) number += offset;
  for (AbaqusElement& element : elements) {
    element.number += offset;
    for (std::int64_t& node : element.nodes) node += offset;
  }
  for (AbaqusSets* sets : {&node_sets, &element_sets}) {
    for (auto& [key, set] : *sets) set.shift(offset);
  }
  for (AbaqusSurface& surface : surfaces) surface.shift(offset);
}

void AbaqusPart::move(const Eigen::Isometry3d& placement) {
  for (auto& point : coordinates) {
    Eigen::Map<Eigen::Vector3d> x(point.data());
    x = placement * Eigen::Vector3d(x);
  }
}

namespace {

const char* const advice =
    "write continuum elements of plane stress or strain (CPS, CPE) for a 2D case, C3D for a 3D one";

/// Makes the MeshFile.
class Builder {
 public:
  Builder(const std::string& file, const std::vector<AbaqusPart>& instances, const AbaqusPart& rest)
      : instances_(instances), rest_(rest) {
    result_.name = file;
    result_.advice = advice;
    result_.sides_follow_from_node_sets = true;
  }

  MeshFile build() {
    for_each_part([this](const AbaqusPart& part) { add_nodes_and_elements(part); });
    std::sort(sorted_nodes_.begin(), sorted_nodes_.end());
    std::sort(sorted_elements_.begin(), sorted_elements_.end());
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    const auto twice = std::adjacent_find(sorted_elements_.begin(), sorted_elements_.end(), same);
    if (twice != sorted_elements_.end()) fail(fmt::format("two elements have the number {}", twice->first));
    const std::size_t n_body = result_.n_elements();
    for (int dimension = 1; dimension <= 3; ++dimension) add_blocks(dimension);
    for_each_part([&](const AbaqusPart& part) {
      for (const AbaqusSurface& surface : part.surfaces) add_surface(part, surface, n_body);
    });
    for_each_part([&](const AbaqusPart& part) {
      for (const auto& [key, set] : part.node_sets) add_node_set(part, set);
    });
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw base::UserError(result_.name + ": " + what); }

  template <class Use>
  void for_each_part(Use use) const {
    use(rest_);
    for (const AbaqusPart& instance : instances_) use(instance);
  }

  void add_nodes_and_elements(const AbaqusPart& part) {
    result_.node_tags.insert(result_.node_tags.end(), part.node_numbers.begin(), part.node_numbers.end());
    result_.coordinates.insert(result_.coordinates.end(), part.coordinates.begin(), part.coordinates.end());
    for (const std::int64_t node : part.node_numbers) sorted_nodes_.emplace_back(node, 0);
    for (const AbaqusElement& element : part.elements) {
      sorted_elements_.emplace_back(element.number, result_.n_elements());
      result_.add_element(element.number, element.shape, 0, element.nodes);
      if (dimension(element.shape) == 2) ++result_.n_plane_bodies;
      set_of_.push_back(element.set.empty() ? "" : name_in(part, element.set));
    }
  }

  /// A set's or surface's name: with its instance before it where there are several.
  std::string name_in(const AbaqusPart& part, const std::string& name) const {
    return instances_.size() > 1 && &part != &rest_ ? part.name + "." + name : name;
  }

  int add_group(int dimension, const std::string& name) {
    const int number = static_cast<int>(result_.group_names.size()) + 1;
    result_.group_names[{dimension, number}] = name;
    return result_.add_group_list({number});
  }

  using Numbered = std::vector<std::pair<std::int64_t, std::size_t>>;  // number, place; ascending

  template <class Use>
  static void for_each_in(const std::vector<AbaqusRun>& runs, const Numbered& all, Use use) {
    for (const auto& [first, last, step] : runs) {
      auto it = std::lower_bound(all.begin(), all.end(), std::make_pair(first, std::size_t{0}));
      for (; it != all.end() && it->first <= last; ++it) {
        if ((it->first - first) % step == 0) use(*it);
      }
    }
  }

  // ---- blocks ----

  /// By section, or else by the sets of *ELEMENT; elements of a lower dimension are groups of sides by those alone.
  void add_blocks(int dimension_of_elements) {
    const bool has_higher = std::any_of(result_.shapes.begin(), result_.shapes.end(),
                                        [&](Shape shape) { return dimension(shape) > dimension_of_elements; });
    std::vector<std::string> names = has_higher ? set_of_ : by_section();
    if (!is_complete(names, dimension_of_elements)) names = set_of_;
    if (!has_higher && !is_complete(names, dimension_of_elements)) return;
    std::map<std::string, int> list_of_name;
    for (std::size_t e = 0; e < names.size(); ++e) {
      if (dimension(result_.shapes[e]) != dimension_of_elements || names[e].empty()) continue;
      const auto [list, is_new] = list_of_name.emplace(names[e], 0);
      if (is_new) list->second = add_group(dimension_of_elements, names[e]);
      result_.element_groups[e] = list->second;
    }
  }

  bool is_complete(const std::vector<std::string>& names, int dimension_of_elements) const {
    for (std::size_t e = 0; e < names.size(); ++e) {
      if (dimension(result_.shapes[e]) == dimension_of_elements && names[e].empty()) return false;
    }
    return true;
  }

  /// For each element the set of its one section, or "".
  std::vector<std::string> by_section() const {
    std::vector<std::string> names(set_of_.size());
    std::vector<int> n_sections(set_of_.size(), 0);
    for_each_part([&](const AbaqusPart& part) {
      for (const std::string& section : part.sections) {
        const auto set = part.element_sets.find(lower(section));
        if (set == part.element_sets.end()) continue;
        for_each_in(set->second.runs, sorted_elements_, [&](const auto& element) {
          names[element.second] = name_in(part, set->second.name);
          ++n_sections[element.second];
        });
      }
    });
    for (std::size_t e = 0; e < names.size(); ++e) {
      if (n_sections[e] != 1) names[e].clear();
    }
    return names;
  }

  // ---- surfaces and node sets ----

  std::vector<std::int64_t> nodes_of(std::size_t element) const {
    const auto nodes = result_.element_nodes.begin();
    return {nodes + static_cast<std::ptrdiff_t>(result_.first_node[element]),
            nodes + static_cast<std::ptrdiff_t>(result_.first_node[element + 1])};
  }

  void add_surface(const AbaqusPart& part, const AbaqusSurface& surface, std::size_t n_body) {
    const std::string name = name_in(part, surface.name);
    if (!surface.nodes.runs.empty() || !surface.nodes.nodes_of.empty()) add_node_set(part, surface.nodes);
    std::map<int, int> list_of_dimension;
    for (const auto& [elements, side] : surface.items) {
      for_each_in(elements.runs, sorted_elements_, [&, side = side](const auto& element) {
        for (const auto& nodes : sides_of(element.second, side, n_body)) {
          const Shape shape = nodes.size() == 2 ? Shape::line : nodes.size() == 3 ? Shape::triangle : Shape::quadrangle;
          const auto [list, is_new] = list_of_dimension.emplace(dimension(shape), 0);
          if (is_new) list->second = add_group(dimension(shape), name);
          result_.add_element(element.first, shape, list->second, nodes);
        }
      });
    }
  }

  /// The nodes of an element's side, or of all its sides that no other element has.
  std::vector<std::vector<std::int64_t>> sides_of(std::size_t element, int side, std::size_t n_body) {
    const Shape shape = result_.shapes[element];
    std::vector<std::vector<std::int64_t>> found;
    for (int s = 1; s <= n_abaqus_sides(shape); ++s) {
      if (side != 0 && s != side) continue;
      const auto nodes = side_nodes(element, s);
      if (side == 0 && n_elements_at(nodes, n_body) > 1) continue;
      found.push_back(nodes);
    }
    return found;
  }

  std::vector<std::int64_t> side_nodes(std::size_t element, int side) const {
    std::vector<std::int64_t> nodes;
    for (const int corner : abaqus_side(result_.shapes[element], side)) {
      nodes.push_back(result_.element_nodes[result_.first_node[element] + static_cast<std::size_t>(corner)]);
    }
    return nodes;
  }

  int n_elements_at(std::vector<std::int64_t> nodes, std::size_t n_body) {
    if (n_elements_at_.empty()) {
      for (std::size_t e = 0; e < n_body; ++e) {
        for (int s = 1; s <= n_abaqus_sides(result_.shapes[e]); ++s) {
          ++n_elements_at_[different(side_nodes(e, s))];
        }
      }
    }
    return n_elements_at_[different(std::move(nodes))];
  }

  /// In ascending order.
  static std::vector<std::int64_t> different(std::vector<std::int64_t> nodes) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  void add_node_set(const AbaqusPart& part, const AbaqusSet& set) {
    std::set<std::int64_t> nodes;
    for_each_in(set.runs, sorted_nodes_, [&](const auto& node) { nodes.insert(node.first); });
    for_each_in(set.nodes_of, sorted_elements_, [&](const auto& element) {
      for (const std::int64_t node : nodes_of(element.second)) nodes.insert(node);
    });
    if (nodes.empty()) return;
    const int list = add_group(0, name_in(part, set.name));
    for (const std::int64_t node : nodes) result_.add_element(node, Shape::point, list, {node});
  }

  const std::vector<AbaqusPart>& instances_;
  const AbaqusPart& rest_;
  MeshFile result_;
  Numbered sorted_nodes_, sorted_elements_;
  std::vector<std::string> set_of_;                         // by element, of its *ELEMENT
  std::map<std::vector<std::int64_t>, int> n_elements_at_;  // by sorted nodes of a side; filled when first needed
};

}  // namespace

MeshFile abaqus_mesh(const std::string& file, const std::vector<AbaqusPart>& instances, const AbaqusPart& rest) {
  return Builder(file, instances, rest).build();
}

}  // namespace perimorph::mesh_files
