#include "file_nodes.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>

#include "over_ranks.hpp"
#include "perimorph/base/inquiry.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr GlobalId unnumbered = 0;            // in the mesh, but as yet without number
constexpr double flatness = 1e-10;            // of z, relative to the body's size
constexpr std::size_t most_listed = 5;        // items shown in a note
constexpr double largest_coordinate = 1e100;  // so that squares and volumes are finite numbers, too

std::vector<GlobalId> numbered_from(GlobalId first, std::size_t n) {
  std::vector<GlobalId> numbers(n);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

}  // namespace

template <int dim>
FileNodes<dim>::FileNodes(const base::Comm& comm, const MeshFile& slice, double scale, const Remarks& remarks)
    : comm_(comm),
      slice_(slice),
      scale_(scale),
      remarks_(remarks),
      places_(base::Slices::of(comm, slice.node_tags.size())),
      place_of_tag_(comm, slice.node_tags, numbered_from(first_place(), slice.node_tags.size())),
      ids_(slice.node_tags.size(), none) {
  const auto by_place = [](const auto& a, const auto& b) { return a.place < b.place; };
  const auto& repeated = place_of_tag_.repeated();
  const auto first_here = std::min_element(repeated.begin(), repeated.end(), by_place);
  const auto first_of_all =
      least(comm, first_here == repeated.end() ? std::nullopt : std::optional(*first_here), by_place);
  if (first_of_all) remarks.fail("two nodes have the number {}", first_of_all->tag);
}

template <int dim>
std::vector<GlobalId> FileNodes<dim>::places_of(const std::vector<std::int64_t>& tags) const {
  return place_of_tag_.places_of(tags);
}

template <int dim>
std::vector<int> FileNodes<dim>::holders_of(const std::vector<GlobalId>& places) const {
  std::vector<int> holders;
  holders.reserve(places.size());
  for (const GlobalId place : places) holders.push_back(places_.holder(place));
  return holders;
}

template <int dim>
std::vector<UsedNode<dim>> FileNodes<dim>::use(const std::vector<GlobalId>& places) {
  const base::Inquiry<GlobalId> inquiry(comm_, holders_of(places), places);
  for (const auto& some : inquiry.received()) {
    for (const GlobalId place : some) ids_[index_of(place)] = unnumbered;
  }
  check_flat();
  check_size();
  const auto n_here = static_cast<std::size_t>(std::count(ids_.begin(), ids_.end(), unnumbered));
  const auto ids = base::Slices::of(comm_, n_here);
  n_used_ = ids.n();
  GlobalId next = ids.begin(comm_.getRank());
  for (GlobalId& id : ids_) {
    if (id != none) id = next++;
  }
  return inquiry.answers<UsedNode<dim>>([&](GlobalId place) {
    return UsedNode<dim>{ids_[index_of(place)], scaled(index_of(place))};
  });
}

/// The coordinates that a mesh of this dimension leaves out are all equal.
template <int dim>
void FileNodes<dim>::check_flat() const {
  using Coordinates = std::array<double, 3>;
  const auto array = [](const Coordinates& x) { return Eigen::Map<const Eigen::Array3d>(x.data()); };
  Eigen::Array3d lowest = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()), highest = -lowest;
  const auto extend = [&](const Eigen::Array3d& low, const Eigen::Array3d& high) {
    lowest = lowest.min(low);
    highest = highest.max(high);
  };
  for (std::size_t n = 0; n < ids_.size(); ++n) {
    if (ids_[n] != none) extend(array(slice_.coordinates[n]), array(slice_.coordinates[n]));
  }
  const std::vector<Coordinates> box = {{lowest[0], lowest[1], lowest[2]}, {highest[0], highest[1], highest[2]}};
  const std::vector<Coordinates> boxes = base::gather_on_all(comm_, box);
  for (std::size_t i = 0; i < boxes.size(); i += 2) extend(array(boxes[i]), array(boxes[i + 1]));
  const Eigen::Array3d extent = highest - lowest;
  if ((extent.tail(3 - dim) > flatness * extent.maxCoeff()).any()) {
    remarks_.fail("a {}D mesh must lie in the plane z = constant, but its nodes have z from {} to {}", dim, lowest[2],
                  highest[2]);
  }
}

template <int dim>
std::array<double, dim> FileNodes<dim>::scaled(std::size_t index) const {
  std::array<double, dim> x;
  for (std::size_t d = 0; d < dim; ++d) x[d] = scale_ * slice_.coordinates[index][d];
  return x;
}

template <int dim>
void FileNodes<dim>::check_size() const {
  base::on_all_ranks(comm_, [&] {
    for (std::size_t n = 0; n < ids_.size(); ++n) {
      if (ids_[n] == none) continue;
      const double largest = Eigen::Map<const base::Point<dim>>(scaled(n).data()).cwiseAbs().maxCoeff();
      if (largest < largest_coordinate) continue;
      remarks_.fail("node {} has a coordinate of {} after scaling by {}; allowed are absolute values < {}",
                    slice_.node_tags[n], largest, scale_, largest_coordinate);
    }
  });
}

template <int dim>
std::vector<GlobalId> FileNodes<dim>::ids_of(const std::vector<GlobalId>& places) const {
  const base::Inquiry<GlobalId> inquiry(comm_, holders_of(places), places);
  return inquiry.answers<GlobalId>([&](GlobalId place) { return ids_[index_of(place)]; });
}

/// Of each of the slice's nodes, whether some element of second order has it so.
template <int dim>
std::vector<char> FileNodes<dim>::are_between_corners() const {
  std::vector<char> are_between(ids_.size(), 0);
  if (sum(comm_, slice_.mid_nodes.size()) == 0) return are_between;
  std::vector<std::int64_t> tags = slice_.mid_nodes;
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  std::vector<GlobalId> places = places_of(tags);
  places.erase(std::remove(places.begin(), places.end(), none), places.end());
  const base::Inquiry<GlobalId> telling(comm_, holders_of(places), places);
  for (const auto& some : telling.received()) {
    for (const GlobalId place : some) are_between[index_of(place)] = 1;
  }
  return are_between;
}

template <int dim>
void FileNodes<dim>::note_unused(GlobalId n_elements, Remarks& remarks) const {
  const std::vector<char> are_between = are_between_corners();
  std::size_t n_between = 0, n_others = 0;
  std::vector<std::int64_t> first_others;
  for (std::size_t n = 0; n < ids_.size(); ++n) {
    if (ids_[n] != none) continue;
    if (are_between[n] != 0) {
      ++n_between;
    } else if (n_others++ < most_listed) {
      first_others.push_back(slice_.node_tags[n]);
    }
  }
  n_between = sum(comm_, n_between);
  n_others = sum(comm_, n_others);
  first_others = base::gather_on_all(comm_, first_others);
  if (const std::size_t n = sum(comm_, slice_.n_second_order[dim]); n > 0) {
    remarks.note(
        "{} of {} elements are of second order: they are taken by their corners, with straight edges, and {} "
        "between the corners are dropped",
        n, n_elements, base::counted(n_between, "node"));
  }
  if (n_others == 0) return;
  first_others.resize(std::min(n_others, most_listed));
  remarks.note("dropped: {} in no {}D element ({}{})", base::counted(n_others, "node"), dim,
               fmt::join(first_others, ", "), n_others > most_listed ? ", ..." : "");
}

template class FileNodes<2>;
template class FileNodes<3>;

}  // namespace perimorph::mesh_files
