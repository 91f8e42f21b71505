#include "nearby_elements.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "perimorph/base/point_tree.hpp"

namespace perimorph::mesh {

namespace {

template <int dim>
using Box = Eigen::AlignedBox<double, dim>;

/// Around an element, as it is sent, [length].
template <int dim>
struct Ball {
  std::array<double, dim> center;
  double radius;

  Ball() = default;
  Ball(const Mesh<dim>& mesh, int element) : radius(mesh::radius(mesh, element)) {
    Eigen::Map<Point<dim>>(center.data()) = centroid(mesh, element);
  }
  Point<dim> point() const { return Eigen::Map<const Point<dim>>(center.data()); }
};

/// A box around the centres of some of a rank's active elements, as it is sent.
template <int dim>
struct RankBox {
  std::array<double, dim> lowest, highest;
  double reach;  ///< how near another element's ball must come to the box, [length]
  int rank;

  Box<dim> box() const {
    return {Eigen::Map<const Point<dim>>(lowest.data()), Eigen::Map<const Point<dim>>(highest.data())};
  }
};

/// A rank's active elements, which can be asked whether one of them comes near another element.
template <int dim>
class ActiveBalls {
 public:
  ActiveBalls(const std::vector<std::vector<Ball<dim>>>& from_ranks, double halo_width)
      : balls_(joined(from_ranks)), halo_width_(halo_width), tree_(centers()) {
    for (const auto& ball : balls_) largest_radius_ = std::max(largest_radius_, ball.radius);
  }

  /// |c_e - c_a| <= halo_width + R_e + R_a for any of them.
  bool is_near(const Ball<dim>& other) const {
    const Point<dim> center = other.point();
    return tree_.any_within(center, (reach() + other.radius) * (1. + 1e-9), [&](int i) {
      return (center - balls_[i].point()).norm() <= halo_width_ + other.radius + balls_[i].radius;
    });
  }

  /// A few boxes that hold all centres: rough enough that all ranks may know them, fine enough to leave out most
  /// others.
  std::vector<RankBox<dim>> boxes(int rank) const {
    constexpr int halvings = 4;
    std::vector<RankBox<dim>> boxes;
    auto all = centers();
    add_boxes(all.begin(), all.end(), halvings, rank, boxes);
    return boxes;
  }

 private:
  using Iterator = typename std::vector<Point<dim>>::iterator;

  static std::vector<Ball<dim>> joined(const std::vector<std::vector<Ball<dim>>>& lists) {
    std::vector<Ball<dim>> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
  }

  std::vector<Point<dim>> centers() const {
    std::vector<Point<dim>> points;
    for (const auto& ball : balls_) points.push_back(ball.point());
    return points;
  }

  double reach() const { return halo_width_ + largest_radius_; }

  void add_boxes(Iterator begin, Iterator end, int halvings, int rank, std::vector<RankBox<dim>>& boxes) const {
    if (begin == end) return;
    Box<dim> box;
    for (auto x = begin; x != end; ++x) box.extend(*x);
    if (halvings == 0) {
      boxes.push_back({{}, {}, reach(), rank});
      Eigen::Map<Point<dim>>(boxes.back().lowest.data()) = box.min();
      Eigen::Map<Point<dim>>(boxes.back().highest.data()) = box.max();
      return;
    }
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    add_boxes(begin, middle, halvings - 1, rank, boxes);
    add_boxes(middle, end, halvings - 1, rank, boxes);
  }

  std::vector<Ball<dim>> balls_;
  double halo_width_, largest_radius_ = 0.;
  base::PointTree<dim> tree_;
};

/// Per rank, the elements near one of its boxes.
template <int dim>
std::vector<std::vector<int>> near_boxes(const std::vector<Ball<dim>>& balls, const std::vector<RankBox<dim>>& boxes,
                                         int n_ranks) {
  Box<dim> around;
  double largest_radius = 0.;
  for (const auto& ball : balls) {
    around.extend(ball.point());
    largest_radius = std::max(largest_radius, ball.radius);
  }
  std::vector<std::vector<int>> near(n_ranks);
  if (balls.empty()) return near;
  constexpr double rounding = 1. + 1e-9;
  for (const auto& one : boxes) {
    const auto box = one.box();
    if (box.exteriorDistance(around) > (one.reach + largest_radius) * rounding) continue;
    for (std::size_t e = 0; e < balls.size(); ++e) {
      if (box.exteriorDistance(balls[e].point()) > (one.reach + balls[e].radius) * rounding) continue;
      near[one.rank].push_back(static_cast<int>(e));
    }
  }
  for (auto& elements : near) {
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  }
  return near;
}

template <int dim>
std::vector<std::vector<Ball<dim>>> chosen(const std::vector<Ball<dim>>& balls,
                                           const std::vector<std::vector<int>>& elements) {
  std::vector<std::vector<Ball<dim>>> lists(elements.size());
  for (std::size_t rank = 0; rank < elements.size(); ++rank) {
    for (const int e : elements[rank]) lists[rank].push_back(balls[e]);
  }
  return lists;
}

}  // namespace

template <int dim>
std::vector<std::vector<int>> needed_elements(const base::Comm& comm, const Mesh<dim>& part,
                                              const std::vector<std::vector<int>>& active, double halo_width) {
  std::vector<Ball<dim>> balls;
  for (int e = 0; e < part.n_owned_elements; ++e) balls.emplace_back(part, e);
  const ActiveBalls<dim> here(base::exchange(comm, chosen(balls, active)), halo_width);
  auto candidates = near_boxes(balls, base::gather_on_all(comm, here.boxes(comm.getRank())), comm.getSize());
  for (std::size_t rank = 0; rank < candidates.size(); ++rank) {
    std::vector<int> others;
    std::set_difference(candidates[rank].begin(), candidates[rank].end(), active[rank].begin(), active[rank].end(),
                        std::back_inserter(others));
    candidates[rank] = std::move(others);
  }

  const auto asked = base::exchange(comm, chosen(balls, candidates));
  std::vector<std::vector<char>> answers(asked.size());
  for (std::size_t rank = 0; rank < asked.size(); ++rank) {
    for (const auto& ball : asked[rank]) answers[rank].push_back(static_cast<char>(here.is_near(ball)));
  }
  const auto are_near = base::exchange(comm, answers);
  std::vector<std::vector<int>> needed = active;
  for (std::size_t rank = 0; rank < needed.size(); ++rank) {
    for (std::size_t i = 0; i < candidates[rank].size(); ++i) {
      if (are_near[rank][i] != 0) needed[rank].push_back(candidates[rank][i]);
    }
    std::sort(needed[rank].begin(), needed[rank].end());
  }
  return needed;
}

template std::vector<std::vector<int>> needed_elements(const base::Comm&, const Mesh<2>&,
                                                       const std::vector<std::vector<int>>&, double);
template std::vector<std::vector<int>> needed_elements(const base::Comm&, const Mesh<3>&,
                                                       const std::vector<std::vector<int>>&, double);

}  // namespace perimorph::mesh
