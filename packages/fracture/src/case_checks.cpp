#include "case_checks.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include "choices.hpp"
#include "literal.hpp"
#include "perimorph/base/text.hpp"

namespace perimorph::fracture {

namespace {

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
  const std::string* text(const std::string& name) const { return list_.getPtr<std::string>(name); }
  const Numbers* numbers(const std::string& name) const { return list_.getPtr<Numbers>(name); }
  const Teuchos::Array<std::string>* texts(const std::string& name) const {
    return list_.getPtr<Teuchos::Array<std::string>>(name);
  }
  std::string shown(const std::string& name) const { return to_literal(list_.getEntry(name)); }
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

void check_material(const Section& material) {
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

struct ShapeParameters {
  SeedShape shape;
  std::vector<std::string> needed, allowed;
};

const ShapeParameters& parameters_of(SeedShape shape) {
  static const std::vector<ShapeParameters> all = {
      {SeedShape::ball, {"Center", "Inner Radius", "Outer Radius"}, {}},
      {SeedShape::box, {"Lower Corner", "Upper Corner", "Rim"}, {}},
      {SeedShape::everything, {}, {}},
      {SeedShape::automatic, {}, {"Inner Radius", "Outer Radius", "Share"}}};
  return *std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.shape == shape; });
}

/// Each shape needs its own parameters and takes no others.
void check_seed(const Section& seed, int dimension) {
  const std::string* word = seed.text("Shape");
  if (word == nullptr) return;
  const auto& [shape, needed, allowed] = parameters_of(value_of(seed_shapes, *word));
  for (const char* name : {"Center", "Inner Radius", "Outer Radius", "Lower Corner", "Upper Corner", "Rim", "Share"}) {
    const bool is_needed = std::count(needed.begin(), needed.end(), name) > 0;
    const bool is_allowed = is_needed || std::count(allowed.begin(), allowed.end(), name) > 0;
    if (is_needed && !seed.given(name)) {
      seed.mistake(name, fmt::format("missing; a seed with \"Shape\" \"{}\" needs it", *word));
    } else if (!is_allowed && seed.given(name)) {
      seed.mistake(
          name, fmt::format("found in a seed with \"Shape\" \"{}\"; allowed is only what describes that shape", *word));
    }
  }
  if (shape == SeedShape::automatic && seed.given("Outer Radius") && !seed.given("Inner Radius")) {
    seed.mistake("Inner Radius", "missing; an automatic seed with \"Outer Radius\" needs it");
  }
  check_order(seed, "Inner Radius", "Outer Radius");
  for (const char* name : {"Center", "Lower Corner", "Upper Corner"}) check_size(seed, name, dimension);
  check_corners(seed, dimension);
}

void check_pre_crack(const Section& crack) {
  const Numbers* points = crack.numbers("Points");
  if (points == nullptr) return;
  if (points->size() < 4 || points->size() % 2 != 0) {
    crack.mistake("Points", fmt::format("found {} numbers; allowed are two points or more, {{x1, y1, x2, y2, ...}}",
                                        points->size()));
    return;
  }
  for (int i = 2; i + 1 < points->size(); i += 2) {
    if ((*points)[i] != (*points)[i - 2] || (*points)[i + 1] != (*points)[i - 1]) continue;
    crack.mistake("Points",
                  fmt::format("found the point ({}, {}) twice in a row; allowed are segments that have a length",
                              (*points)[i], (*points)[i + 1]));
  }
}

void check_displacements(const Section& conditions, int dimension) {
  std::map<std::pair<std::string, std::string>, std::string> seen;
  for (const Section& one : conditions.subs("Displacements")) {
    const std::string *group = one.text("Group"), *component = one.text("Component");
    if (component != nullptr && value_of(components, *component) >= dimension) {
      one.mistake("Component", fmt::format("found \"{}\"; allowed is \"x\" or \"y\" in two dimensions", *component));
    }
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
  const Numbers* points = probe.numbers("Points");
  if (points == nullptr || (!points->empty() && points->size() % dimension == 0)) return;
  probe.mistake("Points", fmt::format("found {} numbers; allowed are one point or more, {} numbers each",
                                      points->size(), dimension));
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
  const int dimension = 2;  // the schema allows no other yet
  const Section root(resolved, mistakes, resolved.list, "");
  check_material(root.sub("Material"));
  check_order(root.sub("Peridynamics"), "Characteristic Length", "Horizon");
  check_order(root.sub("Morphing"), "Growth Inner Radius", "Growth Outer Radius");
  for (const Section& seed : root.sub("Morphing").subs("Seeds")) check_seed(seed, dimension);
  for (const Section& crack : root.subs("Pre-Cracks")) check_pre_crack(crack);
  const Section conditions = root.sub("Boundary Conditions");
  check_displacements(conditions, dimension);
  for (const Section& traction : conditions.subs("Tractions")) check_load(traction, dimension);
  check_load(conditions.sub("Body Force"), dimension);
  check_reactions(root.sub("Output"));
  for (const Section& probe : root.sub("Output").subs("Probes")) check_probe(probe, dimension);
}

}  // namespace perimorph::fracture
