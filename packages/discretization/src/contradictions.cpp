#include <fmt/ranges.h>

#include <Eigen/QR>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "perimorph/discretization/boundary_conditions.hpp"

namespace perimorph::discretization {

namespace {

using base::Point;

/// What is prescribed at one node, along directions that do not follow from each other.
template <int dim>
class PrescribedAtNode {
 public:
  /// The condition that a further one contradicts, by its place in the list; -1: none.
  int contradicted_by(const std::vector<PrescribedComponent>& conditions, int added) {
    constexpr double independent = 1e-4;
    const Point<dim> direction = direction_of<dim>(conditions[added]);
    const auto n = static_cast<Eigen::Index>(numbers_.size());
    const Eigen::VectorXd shares =
        n == 0 ? Eigen::VectorXd() : Eigen::VectorXd(directions_.leftCols(n).colPivHouseholderQr().solve(direction));
    if ((directions_.leftCols(n) * shares - direction).norm() > independent) {
      directions_.col(n) = direction;
      numbers_.push_back(added);
      return -1;
    }
    return first_other_than(conditions, conditions[added].value, shares);
  }

 private:
  std::vector<int> numbers_;                                                              ///< of conditions
  Eigen::Matrix<double, dim, dim> directions_ = Eigen::Matrix<double, dim, dim>::Zero();  ///< columns: theirs

  /// The first condition that has a share in a value which is not the sum of them all; -1 if it is.
  int first_other_than(const std::vector<PrescribedComponent>& conditions, const Ramp<double>& value,
                       const Eigen::VectorXd& shares) const {
    constexpr double felt = 1e-9;
    Ramp<double> sum{0., 0., value.amplitude};
    double size = std::abs(value.rate) + std::abs(value.constant);
    int first = -1;
    bool is_of_one_course = true;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const double share = shares[static_cast<Eigen::Index>(i)];
      if (std::abs(share) < felt) continue;
      const auto& other = conditions[numbers_[i]].value;
      if (first < 0) first = numbers_[i];
      sum.rate += share * other.rate;
      sum.constant += share * other.constant;
      size += std::abs(other.rate) + std::abs(other.constant);
      is_of_one_course = is_of_one_course && (other.rate == 0. || value.has_course_of(other));
    }
    const bool is_sum =
        std::abs(sum.rate - value.rate) <= felt * size && std::abs(sum.constant - value.constant) <= felt * size;
    return is_sum && is_of_one_course ? -1 : first;
  }
};

}  // namespace

std::string name_of_displacement(const PrescribedComponent& condition) {
  if (!condition.direction.empty()) {
    return fmt::format("displacement along ({:.6g})", fmt::join(condition.direction, ", "));
  }
  const bool is_rotation = condition.component >= PrescribedComponent::first_rotation;
  return fmt::format(is_rotation ? "rotation about {}" : "{} displacement", "xyz"[condition.component % 3]);
}

template <int dim>
Point<dim> direction_of(const PrescribedComponent& condition) {
  if (condition.direction.empty()) {
    PERIMORPH_ASSERT(condition.component >= 0 && condition.component < dim, "\"{}\" prescribes component {}",
                     condition.name, condition.component);
    return Point<dim>::Unit(condition.component);
  }
  PERIMORPH_ASSERT(condition.direction.size() == dim, "\"{}\" has a direction of {} numbers", condition.name,
                   condition.direction.size());
  return Eigen::Map<const Point<dim>>(condition.direction.data());
}

template <int dim>
std::vector<Contradiction> contradictions(const mesh::Mesh<dim>& mesh,
                                          const std::vector<PrescribedComponent>& conditions,
                                          const std::vector<RigidGroup>& groups) {
  std::set<double> beginnings;
  for (const auto& condition : conditions) beginnings.insert(condition.value.begin);
  std::set<std::tuple<int, int, int>> all;  // second, first, node
  for (const double begin : beginnings) {
    std::map<int, PrescribedAtNode<dim>> nodes;
    for (int i = 0; i < static_cast<int>(conditions.size()); ++i) {
      const auto& value = conditions[i].value;
      const auto set = mesh.node_sets.find(conditions[i].node_set);
      const bool holds = value.begin <= begin && value.end > begin;  // just after it
      if (!holds || set == mesh.node_sets.end() || moved_by(conditions[i], groups) != nullptr) continue;
      for (const int node : set->second) {
        const int first = nodes[node].contradicted_by(conditions, i);
        if (first >= 0) all.emplace(i, first, node);
      }
    }
  }
  std::vector<Contradiction> listed;
  for (const auto& [second, first, node] : all) listed.push_back({first, second, node});
  return listed;
}

#define PERIMORPH_INSTANTIATE(dim)                                                                                    \
  template base::Point<dim> direction_of<dim>(const PrescribedComponent&);                                            \
  template std::vector<Contradiction> contradictions(const mesh::Mesh<dim>&, const std::vector<PrescribedComponent>&, \
                                                     const std::vector<RigidGroup>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::discretization
