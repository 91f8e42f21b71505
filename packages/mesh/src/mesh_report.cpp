#include "perimorph/mesh/mesh_report.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/mesh/orientation.hpp"
#include "topology.hpp"

namespace perimorph::mesh {

namespace {

/// Smallest, mean and largest of some numbers.
class Range {
 public:
  void add(double value) {
    smallest_ = std::min(smallest_, value);
    largest_ = std::max(largest_, value);
    sum_ += value;
    ++count_;
  }
  double smallest() const { return smallest_; }
  double mean() const { return sum_ / static_cast<double>(count_); }
  double largest() const { return largest_; }

 private:
  double smallest_ = std::numeric_limits<double>::infinity(), largest_ = -smallest_, sum_ = 0.;
  long count_ = 0;
};

template <int dim>
std::string shown(const Point<dim>& point) {
  return fmt::format("({:.6g})", fmt::join(point.begin(), point.end(), ", "));
}

template <int dim>
std::string elements_by_kind(const Mesh<dim>& mesh) {
  std::map<ElementType, int> counts;
  for (const ElementType type : mesh.types) ++counts[type];
  std::string text;
  for (const auto& [type, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, exodus_name(type));
  }
  return text;
}

template <int dim>
std::string blocks(const Mesh<dim>& mesh) {
  std::vector<std::size_t> counts(mesh.block_names.size(), 0);
  for (const int block : mesh.blocks) ++counts[block];
  std::string text;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    text += fmt::format("\n  block          \"{}\": {}", mesh.block_names[b], base::counted(counts[b], "element"));
  }
  return text;
}

template <int dim>
std::string groups(const Mesh<dim>& mesh) {
  std::string text;
  for (const auto& [name, nodes] : mesh.node_sets) {
    const auto sides_of_group = mesh.side_sets.find(name);
    text += fmt::format("\n  group          \"{}\": {}", name, base::counted(nodes.size(), "node"));
    if (sides_of_group != mesh.side_sets.end()) text += ", " + base::counted(sides_of_group->second.size(), "side");
  }
  return text;
}

template <int dim>
Range edge_lengths(const Mesh<dim>& mesh) {
  Range lengths;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const shards::CellTopology element = topology(mesh.types[e]);
    const int* nodes = mesh.corners_of(e);
    for (unsigned edge = 0; edge < element.getEdgeCount(); ++edge) {
      const int first = nodes[element.getNodeMap(1, edge, 0)], second = nodes[element.getNodeMap(1, edge, 1)];
      lengths.add((mesh.coordinates[first] - mesh.coordinates[second]).norm());
    }
  }
  return lengths;
}

template <int dim>
std::string quality(const Mesh<dim>& mesh) {
  Range jacobians;
  int worst = 0;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    const double jacobian = smallest_corner_volume(mesh, e);
    if (jacobian < jacobians.smallest()) worst = e;
    jacobians.add(jacobian);
  }
  return fmt::format("scaled Jacobian {:.3g} at worst, in the element around {}; {:.3g} on average",
                     jacobians.smallest(), shown<dim>(centroid(mesh, worst)), jacobians.mean());
}

}  // namespace

template <int dim>
std::string describe(const Mesh<dim>& whole) {
  PERIMORPH_ASSERT(whole.is_whole() && whole.n_elements() > 0, "{} of {} elements are here", whole.n_elements(),
                   whole.n_global_elements);
  Eigen::AlignedBox<double, dim> box;
  for (const auto& point : whole.coordinates) box.extend(point);
  const Range edges = edge_lengths(whole);
  return fmt::format("elements         {} on {} nodes{}{}\n", elements_by_kind(whole), whole.n_nodes(), blocks(whole),
                     groups(whole)) +
         fmt::format("bounding box     {} to {}\n", shown<dim>(box.min()), shown<dim>(box.max())) +
         fmt::format("edge lengths     {:.4g} to {:.4g}, {:.4g} on average\n", edges.smallest(), edges.largest(),
                     edges.mean()) +
         fmt::format("quality          {}", quality(whole));
}

template std::string describe(const Mesh<2>&);
template std::string describe(const Mesh<3>&);

}  // namespace perimorph::mesh
