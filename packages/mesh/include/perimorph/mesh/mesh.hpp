#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "perimorph/base/algebra.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/mesh/element_type.hpp"

namespace perimorph::mesh {

using base::GlobalId;
using base::Point;

/// A side (edge in 2D, face in 3D) of an element: local index of the element, number of the side as in sides(type).
struct Side {
  int element;
  int side;
};

/// A plane across an axis, beyond which the body goes on as its mirror image.
struct SymmetryPlane {
  int axis;
  double place;            ///< along that axis, [length]
  std::vector<int> nodes;  ///< local nodes on it, ascending
};

/// The mirror image of an element, across one plane of symmetry or more.
template <int dim>
struct Image {
  int element;       ///< local, that it is the image of
  Point<dim> signs;  ///< 1 or -1, by which components of vectors there become those of the image
};

/// A node in the middle of an edge, or of a quadrilateral face, of a larger element, which is connected to the smaller
/// ones beyond by its displacement there: the mean of that edge's or face's corners.
struct HangingNode {
  int node;
  int n_parents;               ///< 2 or 4
  std::array<int, 4> parents;  ///< local nodes, none of which hangs itself
};

/// The reference mesh, or the part of it that one rank holds: its own elements and a halo of its neighbours'.
/// A whole one lies on rank 0 and belongs to rank 0, other ranks have nothing; distribute() gives every rank its part.
/// Nothing in it changes afterwards: elements that become discontinuous change only degrees of freedom.
///
/// Local indices are ints. Local elements are ordered: owned ones first, then the halo, each by ascending global id.
/// Local nodes likewise: owned, then others, by ascending global id. A rank's part holds all elements around each node
/// that it owns, and around each that hangs on one of these. Images of elements beyond planes of symmetry (images.hpp)
/// are the last of its elements: they are no part of the body and belong to no rank, but have neighbours in it. They
/// share the nodes on the planes with it.
template <int dim>
struct Mesh {
  // Nodes, indexed by local node.
  std::vector<Point<dim>> coordinates;  ///< [length]
  std::vector<GlobalId> node_ids;       ///< 0-based, contiguous over the whole mesh
  std::vector<int> node_owners;         ///< rank

  // Elements, indexed by local element.
  std::vector<ElementType> types;
  std::vector<int> blocks;            ///< index into block_names
  std::vector<GlobalId> element_ids;  ///< 0-based, contiguous over the whole mesh
  std::vector<int> element_owners;    ///< rank
  std::vector<int> first_corner = {
      0};                    ///< corners of element e: corners[first_corner[e]] ... corners[first_corner[e+1]-1]
  std::vector<int> corners;  ///< local node of each corner

  // Groups: every physical group of the mesh's own dimension is a block, one of lower dimension a node set, one of
  // dimension dim-1 also a side set. All names are known on all ranks, also where the local list is empty.
  std::vector<std::string> block_names;
  std::map<std::string, std::vector<int>> node_sets;   ///< local nodes, ascending
  std::map<std::string, std::vector<Side>> side_sets;  ///< sides of local elements

  /// Sides of local elements that belong to one element of the whole body only: its boundary, pre-cracks included.
  std::vector<Side> boundary;

  /// Of a mesh that is refined in places (refinement.hpp), by ascending node; of a rank's part those whose parents it
  /// has, which are all that its active elements have (distribute.hpp).
  std::vector<HangingNode> hanging_nodes;

  std::vector<SymmetryPlane> symmetry_planes;
  std::vector<Image<dim>> images;  ///< what the last elements are images of, in their order

  std::vector<std::string> notes;  ///< of a whole mesh: what was changed when it was read, a line each, for the user

  int rank = 0;
  int n_owned_nodes = 0;
  int n_owned_elements = 0;
  GlobalId n_global_nodes = 0;
  GlobalId n_global_elements = 0;

  int n_nodes() const { return static_cast<int>(coordinates.size()); }
  int n_elements() const { return static_cast<int>(types.size()); }
  int n_real_elements() const { return n_elements() - static_cast<int>(images.size()); }
  bool is_image(int element) const { return element >= n_real_elements(); }
  const Image<dim>& image(int element) const {
    PERIMORPH_DEBUG_ASSERT(is_image(element) && has_element(element), "element {} of {} is no image", element,
                           n_elements());
    return images[element - n_real_elements()];
  }
  int n_corners(int element) const {
    PERIMORPH_DEBUG_ASSERT(has_element(element), "element {} of {}", element, n_elements());
    return first_corner[element + 1] - first_corner[element];
  }
  /// The element's local nodes, (n_corners).
  const int* corners_of(int element) const {
    PERIMORPH_DEBUG_ASSERT(has_element(element), "element {} of {}", element, n_elements());
    return corners.data() + first_corner[element];
  }

  bool has_element(int element) const { return element >= 0 && element < n_elements(); }
  /// Whether nothing of the body is on other ranks.
  bool is_whole() const { return n_global_elements == n_elements() && n_global_nodes == n_nodes(); }
};

/// Asserts what Mesh says of itself: that its lists are as long as they must be; in the presets debug and sanitize also
/// that every number in them names something, and that owned items come first, each part by ascending id. Local.
/// @throws Bug
template <int dim>
void check_consistency(const Mesh<dim>& mesh);

/// Mean of an element's corners, (dim), [length].
/// @param element local index, here and below
template <int dim>
Point<dim> centroid(const Mesh<dim>& mesh, int element);

/// Largest distance from an element's centroid to one of its corners, [length].
template <int dim>
double radius(const Mesh<dim>& mesh, int element);

/// Corners of a side, in its outward order, (n_corners of the side), [length].
template <int dim>
std::vector<Point<dim>> corner_points(const Mesh<dim>& mesh, const Side& side);

/// Mean length of the edges of the local elements, [length]: an inner edge counts once per element. Local.
template <int dim>
double mean_edge(const Mesh<dim>& mesh);

/// Fills boundary with the sides that only one element has, ascending. For a whole mesh, or one that is being built and
/// does not say yet how large the whole is. Local.
template <int dim>
void find_boundary(Mesh<dim>& mesh);

}  // namespace perimorph::mesh
