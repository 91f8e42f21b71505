#include "place_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "body_parts.hpp"
#include "perimorph/cases/geometry.hpp"
#include "perimorph/elements/locator.hpp"
#include "perimorph/mesh/crack_place.hpp"

namespace perimorph::cases {

namespace {

using base::Point;
using mesh::CrackPlace;

template <int dim>
using Box = Eigen::AlignedBox<double, dim>;
template <int dim>
using Facets = std::vector<mesh::CrackFacet<dim>>;

template <int dim>
std::string extent(const Box<dim>& box) {
  return fmt::format("from {} to {}", shown<dim>(box.min()), shown<dim>(box.max()));
}

template <int dim>
Box<dim> box_around(const Facets<dim>& crack) {
  Box<dim> box;
  for (const auto& facet : crack) {
    for (const auto& corner : facet) box.extend(corner);
  }
  return box;
}

template <int dim>
Facets<dim> scaled(Facets<dim> crack, double factor) {
  for (auto& facet : crack) {
    for (auto& corner : facet) corner *= factor;
  }
  return crack;
}

template <int dim>
morphing::Zone<dim> scaled(morphing::Zone<dim> zone, double factor) {
  zone.lower *= factor;
  zone.upper *= factor;
  zone.inner_radius *= factor;
  zone.rim *= factor;
  return zone;
}

template <int dim>
Point<dim> middle(const morphing::Zone<dim>& zone) {
  return 0.5 * (zone.lower + zone.upper);
}

bool is_anywhere(const Seed& seed) { return seed.shape == SeedShape::automatic || seed.shape == SeedShape::everything; }

template <int dim>
bool reaches_nodes_or_centroids(const mesh::Mesh<dim>& mesh, const morphing::Zone<dim>& zone) {
  const auto is_in = [&](const Point<dim>& x) { return zone.alpha(x, morphing::BlendingFunction::linear) > 0.; };
  if (std::any_of(mesh.coordinates.begin(), mesh.coordinates.end(), is_in)) return true;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if (is_in(mesh::centroid(mesh, e))) return true;
  }
  return false;
}

template <int dim>
class PlaceChecks {
 public:
  PlaceChecks(const Case& input, const mesh::Mesh<dim>& whole, input::Mistakes& mistakes)
      : input_(input), mesh_(whole), mistakes_(mistakes) {
    for (const auto& x : whole.coordinates) box_.extend(x);
  }

  void run() {
    for (const auto& crack : input_.pre_cracks) check(crack);
    for (const auto& seed : input_.morphing.seeds) check(seed);
  }

 private:
  const Case& input_;
  const mesh::Mesh<dim>& mesh_;
  input::Mistakes& mistakes_;
  Box<dim> box_;
  std::unique_ptr<elements::Locator<dim>> locator_;  ///< made when it is needed

  void add(const std::string& path, const std::string& what) {
    mistakes_.add(input::line_of(input_.lines, path), path, what);
  }

  void check(const PreCrack& crack) {
    const auto facets = facets_of<dim>({crack});
    const double size = std::ldexp(1., -input_.numerical.refinement.levels);
    const auto place = mesh::place_of<dim>(mesh_, facets, size);
    if (place == CrackPlace::inside) return;
    const std::string allowed =
        place == CrackPlace::outside
            ? fmt::format("outside the body, which is {}; allowed are cracks in it", extent<dim>(box_))
            : "much shorter than the elements there, and parts nothing; allowed are cracks of their size or longer";
    add("/Pre-Cracks/" + crack.name, fmt::format("found a crack {}: it is {}{}", extent<dim>(box_around<dim>(facets)),
                                                 allowed, factor_that_fits([&](double factor) {
                                                   return mesh::place_of<dim>(mesh_, scaled<dim>(facets, factor),
                                                                              size) == CrackPlace::inside;
                                                 })));
  }

  void check(const Seed& seed) {
    if (is_anywhere(seed)) return;
    const auto zone = zone_of<dim>(seed);
    if (reaches_body(zone)) return;
    add("/Morphing/Seeds/" + seed.name,
        fmt::format(
            "found a zone around {}: it is outside the body, which is {}; allowed are zones that reach into it{}",
            shown<dim>(middle(zone)), extent<dim>(box_),
            factor_that_fits([&](double factor) { return reaches_body(scaled<dim>(zone, factor)); })));
  }

  bool reaches_body(const morphing::Zone<dim>& zone) {
    if (reaches_nodes_or_centroids(mesh_, zone)) return true;
    if (!locator_) locator_ = std::make_unique<elements::Locator<dim>>(mesh_);
    return locator_->find(middle(zone)).has_value();  // it is smaller than an element
  }

  /// The end of a message: what lengths would have to be multiplied by to fit the mesh.
  template <class Fits>
  std::string factor_that_fits(Fits fits) const {
    if (input_.mesh.scale != 1. && fits(input_.mesh.scale)) {
      return fmt::format(
          ". Scaled by {:.6g}, as the mesh is (/Mesh/Scale), it would be: the case's lengths are those of the "
          "scaled mesh",
          input_.mesh.scale);
    }
    for (const double factor : {1000., 100., 10., 0.1, 0.01, 0.001}) {
      if (fits(factor)) return fmt::format(". Scaled by {} it would be: are the units those of the mesh?", factor);
    }
    return "";
  }
};

}  // namespace

template <int dim>
void check_places(const Case& input, const mesh::Mesh<dim>& whole, input::Mistakes& mistakes) {
  PlaceChecks<dim>(input, whole, mistakes).run();
}

template <int dim>
bool are_surely_in_body(const base::Comm& comm, const Case& input, const mesh::Mesh<dim>& part) {
  std::vector<double> n_finds;  // on how many ranks each of them is in the body
  for (const auto& crack : input.pre_cracks) {
    const double size = std::ldexp(1., -input.numerical.refinement.levels);
    n_finds.push_back(mesh::place_of<dim>(part, facets_of<dim>({crack}), size) == CrackPlace::inside ? 1. : 0.);
  }
  for (const auto& seed : input.morphing.seeds) {
    if (is_anywhere(seed)) continue;
    n_finds.push_back(reaches_nodes_or_centroids(part, zone_of<dim>(seed)) ? 1. : 0.);
  }
  base::sum(comm, n_finds);
  return std::find(n_finds.begin(), n_finds.end(), 0.) == n_finds.end();
}

#define PERIMORPH_INSTANTIATE(dim)                                                   \
  template void check_places(const Case&, const mesh::Mesh<dim>&, input::Mistakes&); \
  template bool are_surely_in_body(const base::Comm&, const Case&, const mesh::Mesh<dim>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::cases
