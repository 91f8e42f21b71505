#include "case_checks.hpp"

#include <Eigen/Geometry>
#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

#include "choices.hpp"
#include "perimorph/base/text.hpp"
#include "perimorph/input/literal.hpp"

namespace perimorph::fracture {

namespace {

using input::in_quotes;
using input::Mistakes;
using input::Resolved;
using Numbers = Teuchos::Array<double>;
using Teuchos::ParameterList;

/// One section: its values, if they are sound, and where to say that they do not fit together.
class Section {
 public:
  Section(const Resolved& resolved, Mistakes& mistakes, const ParameterList& list, std::string path)
      : resolved_(resolved), mistakes_(mistakes), list_(list), path_(std::move(path)) {}

  Section sub(const std::string& name) const {
    return Section(resolved_, mistakes_, list_.sublist(name), path_ + "/" + name);
  }
  std::vector<Section> subs(const std::string& name) const {
    std::vector<Section> all;
    const Section parent = sub(name);
    for (const auto& item : parent.list_) all.push_back(parent.sub(item.first));
    return all;
  }

  const double* number(const std::string& name) const { return list_.getPtr<double>(name); }
  const int* count(const std::string& name) const { return list_.getPtr<int>(name); }
  const std::string* text(const std::string& name) const { return list_.getPtr<std::string>(name); }
  const Numbers* numbers(const std::string& name) const { return list_.getPtr<Numbers>(name); }
  const Teuchos::Array<std::string>* texts(const std::string& name) const {
    return list_.getPtr<Teuchos::Array<std::string>>(name);
  }
  std::string shown(const std::string& name) const { return input::to_literal(list_.getEntry(name)); }
  const std::string& path() const { return path_; }

  /// In the file or on the command line, be it sound or not.
  bool given(const std::string& name) const { return resolved_.given(path_ + "/" + name); }

  void mistake(const std::string& name, const std::string& what) const {
    const std::string path = path_ + "/" + name;
    mistakes_.add(resolved_.line(path), path, what);
  }

 private:
  const Resolved& resolved_;
  Mistakes& mistakes_;
  const ParameterList& list_;
  std::string path_;
};

void check_order(const Section& section, const std::string& smaller, const std::string& larger) {
  const double *low = section.number(smaller), *high = section.number(larger);
  if (low == nullptr || high == nullptr || *high > *low) return;
  section.mistake(larger, fmt::format("found {}; allowed is a number > \"{}\", which is {}", *high, smaller, *low));
}

/// A word that only the other dimension allows.
template <class E, std::size_t n>
void check_choice(const Section& section, const std::string& name, const std::array<Choice<E>, n>& choices,
                  int dimension) {
  const std::string* word = section.text(name);
  const auto allowed = words(choices, dimension);
  if (word == nullptr || std::find(allowed.begin(), allowed.end(), *word) != allowed.end()) return;
  section.mistake(name, fmt::format("found {}; allowed is {} in {} dimensions (/Dimension)", in_quotes(*word),
                                    base::quoted_list(allowed, " or "), dimension == 2 ? "two" : "three"));
}

void check_poissons_ratio(const Section& material) {
  const double* ratio = material.number("Poisson's Ratio");
  const std::string* model = material.text("Elastic Model");
  if (ratio == nullptr || model == nullptr) return;
  // 1e-3 relative, and a little, since 0.333 is exactly 1e-3 off 1/3.
  const double needed = poissons_ratio_of(*model);
  if (std::abs(*ratio - needed) <= 1.0001e-3 * needed) return;
  material.mistake(
      "Poisson's Ratio",
      fmt::format("found {}; allowed is {} for \"{}\": bond-based peridynamics, with central forces between "
                  "pairs of points, has this one ratio",
                  *ratio, needed == 0.25 ? "0.25 (1/4)" : "0.3333 (1/3)", *model));
}

void check_material(const Section& material, int dimension) {
  check_choice(material, "Elastic Model", elastic_models, dimension);
  check_poissons_ratio(material);
  if (material.given("Critical Stretch") && material.given("Fracture Energy")) {
    material.mistake("Fracture Energy",
                     "found beside \"Critical Stretch\"; allowed is one of the two: each follows from the other");
  }
}

void check_size(const Section& section, const std::string& name, int dimension) {
  const Numbers* values = section.numbers(name);
  if (values == nullptr || values->size() == dimension) return;
  section.mistake(name,
                  fmt::format("found {}; allowed are {} numbers, one per dimension", section.shown(name), dimension));
}

void check_corners(const Section& seed, int dimension) {
  const Numbers *lower = seed.numbers("Lower Corner"), *upper = seed.numbers("Upper Corner");
  if (lower == nullptr || upper == nullptr || lower->size() != dimension || upper->size() != dimension) return;
  for (int i = 0; i < dimension; ++i) {
    if ((*upper)[i] > (*lower)[i]) continue;
    seed.mistake("Upper Corner",
                 fmt::format("found {}; allowed is a corner above and to the right of \"Lower Corner\", which is {}",
                             seed.shown("Upper Corner"), seed.shown("Lower Corner")));
    return;
  }
}

template <class E>
struct ShapeParameter {
  E shape;
  const char* name;
  bool is_needed = true;
};
constexpr std::array<ShapeParameter<SeedShape>, 13> seed_parameters{{{SeedShape::ball, "Center"},
                                                                     {SeedShape::ball, "Inner Radius"},
                                                                     {SeedShape::ball, "Outer Radius"},
                                                                     {SeedShape::cylinder, "Start"},
                                                                     {SeedShape::cylinder, "End"},
                                                                     {SeedShape::cylinder, "Inner Radius"},
                                                                     {SeedShape::cylinder, "Outer Radius"},
                                                                     {SeedShape::box, "Lower Corner"},
                                                                     {SeedShape::box, "Upper Corner"},
                                                                     {SeedShape::box, "Rim"},
                                                                     {SeedShape::automatic, "Inner Radius", false},
                                                                     {SeedShape::automatic, "Outer Radius", false},
                                                                     {SeedShape::automatic, "Share", false}}};
constexpr std::array<ShapeParameter<PreCrackShape>, 5> pre_crack_parameters{{{PreCrackShape::polyline, "Points"},
                                                                             {PreCrackShape::polygon, "Points"},
                                                                             {PreCrackShape::disc, "Center"},
                                                                             {PreCrackShape::disc, "Normal"},
                                                                             {PreCrackShape::disc, "Radius"}}};

/// Each shape needs its own parameters and takes no others. @param what has the shape: "a seed"
template <class E, std::size_t n, std::size_t m>
void check_shape(const Section& section, const char* what, const std::array<Choice<E>, n>& shapes,
                 const std::array<ShapeParameter<E>, m>& parameters, int dimension) {
  const std::string* word = section.text("Shape");
  if (word == nullptr) return;
  check_choice(section, "Shape", shapes, dimension);
  struct Use {
    bool is_allowed = false, is_needed = false;
  };
  std::map<std::string, Use> uses;
  for (const auto& [shape, name, is_needed] : parameters) {
    Use& use = uses[name];
    const bool is_its_own = shape == value_of(shapes, *word);
    use.is_allowed |= is_its_own;
    use.is_needed |= is_its_own && is_needed;
  }
  for (const auto& [name, use] : uses) {
    if (use.is_needed && !section.given(name)) {
      section.mistake(name, fmt::format("missing; {} with \"Shape\" \"{}\" needs it", what, *word));
    } else if (!use.is_allowed && section.given(name)) {
      section.mistake(name, fmt::format("found in {} with \"Shape\" \"{}\"; allowed is only what describes that shape",
                                        what, *word));
    }
  }
}

void check_that_it_has_length(const Section& section, const std::string& name, const Numbers& direction) {
  if (std::any_of(direction.begin(), direction.end(), [](double value) { return value != 0.; })) return;
  section.mistake(name, fmt::format("found {}; allowed is a direction, which has a length", section.shown(name)));
}

void check_seed(const Section& seed, int dimension) {
  check_shape(seed, "a seed", seed_shapes, seed_parameters, dimension);
  const std::string* shape = seed.text("Shape");
  const bool is_automatic = shape != nullptr && value_of(seed_shapes, *shape) == SeedShape::automatic;
  if (is_automatic && seed.given("Outer Radius") && !seed.given("Inner Radius")) {
    seed.mistake("Inner Radius", "missing; an automatic seed with \"Outer Radius\" needs it");
  }
  check_order(seed, "Inner Radius", "Outer Radius");
  for (const char* name : {"Center", "Start", "End", "Lower Corner", "Upper Corner"}) check_size(seed, name, dimension);
  check_corners(seed, dimension);
  const Numbers *start = seed.numbers("Start"), *end = seed.numbers("End");
  if (start != nullptr && end != nullptr && *start == *end) {
    seed.mistake("End", fmt::format("found {}, which is \"Start\" too; allowed is an axis that has a length",
                                    seed.shown("End")));
  }
}

/// All corners of a polygon lie in one plane and turn the same way. @param corners no two in a row are the same
bool is_flat_and_convex(const std::vector<base::Point<3>>& corners) {
  constexpr double tolerance = 1e-6;  // of the polygon's size
  const auto n = corners.size();
  base::Point<3> normal = base::Point<3>::Zero();
  double size = 0.;
  for (std::size_t i = 0; i < n; ++i) {
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % n] - corners[0]);
    size = std::max(size, (corners[i] - corners[0]).norm());
  }
  if (normal.norm() <= tolerance * size * size) return false;
  normal.normalize();
  double turned = 0.;
  for (std::size_t i = 0; i < n; ++i) {
    const base::Point<3> to = corners[(i + 1) % n] - corners[i], from = corners[(i + 2) % n] - corners[(i + 1) % n];
    const double turn = normal.dot(to.cross(from)) / (to.norm() * from.norm());
    if (turn < -tolerance || std::abs(normal.dot(to)) > tolerance * size) return false;
    turned += std::atan2(turn, to.dot(from) / (to.norm() * from.norm()));
  }
  return turned < 7.;  // once around, 2 pi: a star goes around more often
}

void check_points(const Section& crack, const Numbers& points, int dimension) {
  const bool is_polygon = dimension == 3;
  const int n = static_cast<int>(points.size()) / dimension;
  if (n < dimension || points.size() % dimension != 0) {
    crack.mistake("Points", fmt::format("found {} numbers; allowed are {}", points.size(),
                                        is_polygon ? "three points or more, {x1, y1, z1, x2, ...}"
                                                   : "two points or more, {x1, y1, x2, y2, ...}"));
    return;
  }
  bool is_sound = true;
  for (int i = is_polygon ? 0 : 1; i < n; ++i) {
    const auto point = points.begin() + i * dimension, before = points.begin() + (i + n - 1) % n * dimension;
    if (!std::equal(point, point + dimension, before)) continue;
    is_sound = false;
    crack.mistake("Points", fmt::format("found the point ({}) twice in a row; allowed are segments that have a length",
                                        fmt::join(point, point + dimension, ", ")));
  }
  if (!is_polygon || !is_sound) return;
  std::vector<base::Point<3>> corners;
  for (int i = 0; i < n; ++i) corners.emplace_back(Eigen::Map<const base::Point<3>>(&points[i * 3]));
  if (is_flat_and_convex(corners)) return;
  crack.mistake("Points", fmt::format("found {}; allowed are the corners of a flat convex polygon, one after the other "
                                      "around it; other shapes are several pre-cracks",
                                      crack.shown("Points")));
}

void check_pre_crack(const Section& crack, int dimension) {
  check_shape(crack, "a pre-crack", pre_crack_shapes, pre_crack_parameters, dimension);
  if (const Numbers* points = crack.numbers("Points")) check_points(crack, *points, dimension);
  for (const char* name : {"Center", "Normal"}) check_size(crack, name, dimension);
  if (const Numbers* normal = crack.numbers("Normal")) check_that_it_has_length(crack, "Normal", *normal);
}

void check_displacements(const Section& conditions, int dimension) {
  std::map<std::pair<std::string, std::string>, std::string> seen;
  for (const Section& one : conditions.subs("Displacements")) {
    const std::string *group = one.text("Group"), *component = one.text("Component");
    check_choice(one, "Component", components, dimension);
    if (group == nullptr || component == nullptr) continue;
    const auto [first, is_new] = seen.emplace(std::make_pair(*group, *component), one.path());
    if (is_new) continue;
    one.mistake("Component",
                fmt::format("found the group {} with \"{}\" again; {} prescribes that displacement already",
                            in_quotes(*group), *component, first->second));
  }
}

/// No numbers at all stand for zeros.
void check_load(const Section& load, int dimension) {
  for (const char* name : {"Rate", "Constant"}) {
    const Numbers* values = load.numbers(name);
    if (values != nullptr && !values->empty()) check_size(load, name, dimension);
  }
}

void check_probe(const Section& probe, int dimension) {
  constexpr std::int64_t most_places = 1'000'000;
  const Numbers* points = probe.numbers("Points");
  if (points == nullptr) return;
  if (points->empty() || points->size() % dimension != 0) {
    probe.mistake("Points", fmt::format("found {} numbers; allowed are one point or more, {} numbers each",
                                        points->size(), dimension));
    return;
  }
  const int* divisions = probe.count("Divisions");
  const std::int64_t n_segments = points->size() / dimension - 1;
  if (divisions == nullptr || n_segments * *divisions < most_places) return;
  probe.mistake("Divisions",
                fmt::format("found {}; allowed are less than {} places in one probe", *divisions, most_places));
}

void check_reactions(const Section& output) {
  const auto* groups = output.texts("Reactions");
  if (groups == nullptr) return;
  std::set<std::string> seen;
  for (const auto& group : *groups) {
    if (seen.insert(group).second) continue;
    output.mistake("Reactions", fmt::format("found {} twice; allowed is each group once", in_quotes(group)));
  }
}

}  // namespace

double poissons_ratio_of(const std::string& elastic_model) {
  return materials::bond_based_poissons_ratio(value_of(elastic_models, elastic_model));
}

void check_case(const Resolved& resolved, Mistakes& mistakes) {
  const Section root(resolved, mistakes, resolved.list, "");
  const int* given_dimension = resolved.list.getPtr<int>("Dimension");
  if (given_dimension == nullptr) return;  // what is wrong depends on it
  const int dimension = *given_dimension;
  check_material(root.sub("Material"), dimension);
  check_order(root.sub("Peridynamics"), "Characteristic Length", "Horizon");
  check_order(root.sub("Morphing"), "Growth Inner Radius", "Growth Outer Radius");
  for (const Section& seed : root.sub("Morphing").subs("Seeds")) check_seed(seed, dimension);
  for (const Section& crack : root.subs("Pre-Cracks")) check_pre_crack(crack, dimension);
  const Section conditions = root.sub("Boundary Conditions");
  check_displacements(conditions, dimension);
  for (const Section& traction : conditions.subs("Tractions")) check_load(traction, dimension);
  check_load(conditions.sub("Body Force"), dimension);
  check_reactions(root.sub("Output"));
  for (const Section& probe : root.sub("Output").subs("Probes")) check_probe(probe, dimension);
}

}  // namespace perimorph::fracture
