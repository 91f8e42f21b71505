// Input files of Abaqus: the keywords *NODE, *ELEMENT, *NSET, *ELSET, *SURFACE, *SOLID SECTION, *PART, *INSTANCE and
// *ASSEMBLY of its Keywords Reference.

#include "abaqus_file.hpp"

#include <cmath>
#include <limits>

#include "abaqus_elements.hpp"
#include "abaqus_lines.hpp"
#include "abaqus_model.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/text.hpp"
#include "text_fields.hpp"

namespace perimorph::mesh_files {

namespace {

using Fields = std::vector<std::string>;

/// Each instance has numbers of its own, from a multiple of this on; the assembly those after all instances.
constexpr std::int64_t numbers_per_instance = 1000000000, most_instances = 1000000;

constexpr std::size_t longest_name = 200;

constexpr const char* generators[] = {"ngen", "nfill", "ncopy", "nmap", "elgen", "elcopy", "system"};

class Reader {
 public:
  explicit Reader(const std::string& file) : name_(file), lines_(file) {}

  MeshFile read() {
    while (const auto keyword = lines_.next_keyword()) {
      if (keyword->name == "step") break;
      read_keyword(*keyword);
    }
    if (scope_ == Scope::part || scope_ == Scope::instance)
      lines_.fail("the file ends within *PART or *INSTANCE: it is truncated");
    if (instances_.empty() && !parts_.empty()) lines_.fail("there are parts, but no *INSTANCE places one");
    MeshFile mesh = abaqus_mesh(name_, instances_, rest_);
    for (const auto& [type, n] : passed_over_) {
      mesh.notes.push_back(
          fmt::format("{} elements of type {}, which have no body, are passed over", n, excerpt(type)));
    }
    return mesh;
  }

 private:
  enum class Scope { model, part, instance };

  /// What nodes, elements and sets now belong to.
  AbaqusPart& current() {
    return scope_ == Scope::part ? parts_[part_] : scope_ == Scope::instance ? instances_.back() : rest_;
  }

  void read_keyword(const AbaqusKeyword& keyword) {
    static const std::map<std::string, void (Reader::*)(const AbaqusKeyword&)> readers = {
        {"node", &Reader::read_nodes},           {"element", &Reader::read_elements},
        {"nset", &Reader::read_node_set},        {"elset", &Reader::read_element_set},
        {"surface", &Reader::read_surface},      {"solidsection", &Reader::read_section},
        {"shellsection", &Reader::read_section}, {"membranesection", &Reader::read_section},
        {"part", &Reader::begin_part},           {"endpart", &Reader::end_part},
        {"assembly", &Reader::begin_assembly},   {"instance", &Reader::begin_instance},
        {"endinstance", &Reader::end_instance}};
    if (const auto reader = readers.find(keyword.name); reader != readers.end()) (this->*reader->second)(keyword);
    for (const char* generator : generators) {
      if (keyword.name != generator) continue;
      lines_.fail(
          fmt::format("*{} leaves making or moving nodes to Abaqus; allowed is a file in which they are written "
                      "out, as Abaqus/CAE does",
                      keyword.name));
    }
  }

  std::string name_in(const AbaqusKeyword& keyword, const std::string& parameter) const {
    std::string name = keyword.value(parameter);
    if (name.empty() || name.size() > longest_name || base::has_control_characters(name)) {
      lines_.fail(fmt::format("*{} needs {}= with a readable name of at most {} characters, found \"{}\"", keyword.name,
                              parameter, longest_name, excerpt(name)));
    }
    return name;
  }

  static AbaqusSet& set_in(AbaqusSets& sets, const std::string& name) {
    AbaqusSet& set = sets[lower(name)];
    if (set.name.empty()) set.name = name;
    return set;
  }

  // ---- parts and instances ----

  void begin_part(const AbaqusKeyword& keyword) {
    scope_ = Scope::part;
    const std::string name = name_in(keyword, "name");
    part_ = lower(name);
    parts_[part_].name = name;
  }

  void end_part(const AbaqusKeyword&) { scope_ = Scope::model; }

  void begin_assembly(const AbaqusKeyword&) { offset_of_rest_ = numbers_per_instance * most_instances; }

  void begin_instance(const AbaqusKeyword& keyword) {
    if (keyword.has("library")) lines_.fail("*INSTANCE from a library of results; allowed are instances of a *PART");
    if (static_cast<std::int64_t>(instances_.size()) >= most_instances) {
      lines_.fail(fmt::format("more than {} instances", most_instances));
    }
    const std::string name = name_in(keyword, "name"), part = name_in(keyword, "part");
    const auto found = parts_.find(lower(part));
    if (found == parts_.end())
      lines_.fail(fmt::format("*INSTANCE of the part \"{}\", which is not defined", excerpt(part)));
    if (!offset_of_.emplace(lower(name), numbers_per_instance * static_cast<std::int64_t>(instances_.size())).second) {
      lines_.fail(fmt::format("two instances are called \"{}\"", excerpt(name)));
    }
    instances_.push_back(found->second);
    instances_.back().name = name;
    scope_ = Scope::instance;
    placement_ = read_placement();
  }

  /// A translation; then, on a second line, two points of an axis and an angle in degrees.
  Eigen::Isometry3d read_placement() {
    Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();
    const auto translation = lines_.next_data();
    if (!translation) return placement;
    placement.translation() = vector(*translation, 0);
    const auto rotation = lines_.next_data();
    if (!rotation) return placement;
    const Eigen::Vector3d a = vector(*rotation, 0), axis = vector(*rotation, 3) - a;
    if (rotation->size() < 7 || !(axis.norm() > 0.))
      lines_.fail("a rotation needs two points of its axis and an angle");
    const double angle = lines_.real_number((*rotation)[6]) * M_PI / 180.;
    return Eigen::Translation3d(a) * Eigen::AngleAxisd(angle, axis.normalized()) * Eigen::Translation3d(-a) * placement;
  }

  Eigen::Vector3d vector(const Fields& fields, std::size_t first) const {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::size_t d = 0; d < 3 && first + d < fields.size(); ++d)
      x[static_cast<int>(d)] = lines_.real_number(fields[first + d]);
    return x;
  }

  void end_instance(const AbaqusKeyword&) {
    if (scope_ != Scope::instance) lines_.fail("*END INSTANCE without *INSTANCE before it");
    instances_.back().shift(offset_of_.at(lower(instances_.back().name)));
    instances_.back().move(placement_);
    scope_ = Scope::model;
  }

  /// What to add to numbers that stand outside parts and instances, by the keyword's INSTANCE=.
  std::int64_t offset_of(const AbaqusKeyword& keyword) const {
    if (scope_ != Scope::model) return 0;
    if (!keyword.has("instance")) return offset_of_rest_;
    const auto found = offset_of_.find(lower(keyword.value("instance")));
    if (found == offset_of_.end()) {
      lines_.fail(fmt::format("INSTANCE=\"{}\" is not defined", excerpt(keyword.value("instance"))));
    }
    return found->second;
  }

  // ---- nodes and elements ----

  void read_nodes(const AbaqusKeyword& keyword) {
    if (keyword.has("system") && lower(keyword.value("system")) != "r") {
      lines_.fail("*NODE with cylindrical or spherical coordinates; allowed are rectangular ones");
    }
    if (keyword.has("input")) lines_.include(keyword.value("input"));
    AbaqusPart& part = current();
    AbaqusSet* set = keyword.has("nset") ? &set_in(part.node_sets, name_in(keyword, "nset")) : nullptr;
    const std::int64_t offset = offset_of(keyword);
    while (const auto fields = lines_.next_data()) {
      const std::int64_t number = lines_.whole_number(fields->front()) + offset;
      const Eigen::Vector3d x = vector(*fields, 1);
      part.node_numbers.push_back(number);
      part.coordinates.push_back({x[0], x[1], x[2]});
      if (set != nullptr) set->add(number);
    }
  }

  void read_elements(const AbaqusKeyword& keyword) {
    const std::string type = name_in(keyword, "type");
    if (keyword.has("input")) lines_.include(keyword.value("input"));
    AbaqusSet* set = keyword.has("elset") ? &set_in(current().element_sets, name_in(keyword, "elset")) : nullptr;
    const auto known = abaqus_type(type);
    if (!known && !is_without_body(type)) {
      lines_.fail(
          fmt::format("elements of type \"{}\"; allowed are C3D4, C3D5, C3D6, C3D8, CPS3, CPS4, CPE3, CPE4, shells and "
                      "membranes, those of second order, and elements without a body, which are passed over",
                      excerpt(type)));
    }
    if (!known) {
      while (lines_.next_data()) ++passed_over_[type];
      return;
    }
    const std::int64_t offset = offset_of(keyword);
    while (const auto fields = lines_.next_data()) {
      current().elements.push_back(read_element(*fields, *known, offset));
      current().elements.back().set = set == nullptr ? "" : set->name;
      if (set != nullptr) set->add(current().elements.back().number);
    }
  }

  /// Its nodes may go on in further lines.
  AbaqusElement read_element(Fields fields, const AbaqusType& type, std::int64_t offset) {
    const auto n_fields = static_cast<std::size_t>(type.n_nodes) + 1;
    while (fields.size() < n_fields) {
      const auto more = lines_.next_data();
      if (!more) break;
      fields.insert(fields.end(), more->begin(), more->end());
    }
    if (fields.size() != n_fields) {
      lines_.fail(fmt::format("an element with {} nodes; its type has {}", fields.size() - 1, type.n_nodes));
    }
    AbaqusElement element{lines_.whole_number(fields[0]) + offset, type.shape, "", {}};
    for (std::size_t i = 1; i < n_fields; ++i) element.nodes.push_back(lines_.whole_number(fields[i]) + offset);
    return element;
  }

  // ---- sets, sections and surfaces ----

  void read_node_set(const AbaqusKeyword& keyword) {
    AbaqusSet& set = set_in(current().node_sets, name_in(keyword, "nset"));
    if (keyword.has("elset")) {
      const AbaqusSet& elements = defined(current().element_sets, keyword.value("elset"), &AbaqusPart::element_sets);
      set.nodes_of.insert(set.nodes_of.end(), elements.runs.begin(), elements.runs.end());
    }
    read_members(keyword, set, &AbaqusPart::node_sets);
  }

  void read_element_set(const AbaqusKeyword& keyword) {
    read_members(keyword, set_in(current().element_sets, name_in(keyword, "elset")), &AbaqusPart::element_sets);
  }

  using SetsOfPart = AbaqusSets AbaqusPart::*;

  /// Numbers and names of other sets; with GENERATE first, last and step.
  void read_members(const AbaqusKeyword& keyword, AbaqusSet& set, SetsOfPart sets) {
    const std::int64_t offset = offset_of(keyword);
    while (const auto fields = lines_.next_data()) {
      if (keyword.has("generate")) {
        set.runs.push_back(generated(*fields, offset));
        continue;
      }
      for (const std::string& field : *fields) {
        if (field.empty()) continue;
        std::int64_t number = 0;
        if (parse_number(field, number)) {
          set.add(lines_.whole_number(field) + offset);
        } else {
          add_named(set, defined(current().*sets, field, sets));
        }
      }
    }
  }

  void add_named(AbaqusSet& set, const AbaqusSet& other) const {
    if (&set == &other) lines_.fail(fmt::format("the set \"{}\" contains itself", excerpt(set.name)));
    set.add(other);
  }

  AbaqusRun generated(const Fields& fields, std::int64_t offset) const {
    if (fields.size() < 2) lines_.fail("GENERATE needs the first and the last number");
    const std::int64_t first = lines_.whole_number(fields[0]), last = lines_.whole_number(fields[1]);
    const std::int64_t step = fields.size() > 2 && !fields[2].empty() ? lines_.whole_number(fields[2]) : 1;
    if (last < first) lines_.fail(fmt::format("GENERATE from {} to {}; allowed are ascending numbers", first, last));
    return {first + offset, last + offset, step};
  }

  /// A set of the current part, or "instance.set".
  const AbaqusSet& defined(const AbaqusSets& here, const std::string& name, SetsOfPart sets) const {
    const std::string key = lower(name);
    if (const auto found = here.find(key); found != here.end()) return found->second;
    for (const AbaqusPart& instance : instances_) {
      const std::string prefix = lower(instance.name) + ".";
      if (key.rfind(prefix, 0) != 0) continue;
      if (const auto found = (instance.*sets).find(key.substr(prefix.size())); found != (instance.*sets).end()) {
        return found->second;
      }
    }
    lines_.fail(fmt::format("the set \"{}\" is not defined before it is used", excerpt(name)));
  }

  void read_section(const AbaqusKeyword& keyword) { current().sections.push_back(name_in(keyword, "elset")); }

  void read_surface(const AbaqusKeyword& keyword) {
    AbaqusSurface surface{name_in(keyword, "name"), {}, {}};
    surface.nodes.name = surface.name;
    const std::string type = keyword.has("combine") ? ""
                             : keyword.has("type")  ? lower(keyword.value("type"))
                                                    : "element";
    while (const auto fields = lines_.next_data()) {
      if (type == "node") {
        surface.nodes.add(members((*fields)[0], &AbaqusPart::node_sets, offset_of(keyword)));
      } else if (type == "element") {
        const int side = side_number(fields->size() > 1 ? lower((*fields)[1]) : "");
        if (side >= 0)
          surface.items.push_back({members((*fields)[0], &AbaqusPart::element_sets, offset_of(keyword)), side});
      }
    }
    current().surfaces.push_back(std::move(surface));
  }

  /// One node or element, or a set of them.
  AbaqusSet members(const std::string& field, SetsOfPart sets, std::int64_t offset) {
    std::int64_t number = 0;
    if (!parse_number(field, number)) return defined(current().*sets, field, sets);
    AbaqusSet one;
    one.add(lines_.whole_number(field) + offset);
    return one;
  }

  /// 0: all that no other element has; -1: a shell's face or an edge, which is no side of a body.
  int side_number(const std::string& field) const {
    if (field.empty()) return 0;
    std::int64_t number = 0;
    if (field[0] == 's' && parse_number(field.substr(1), number) && number >= 1 && number <= 6)
      return static_cast<int>(number);
    if (field == "spos" || field == "sneg" || field[0] == 'e') return -1;
    lines_.fail(fmt::format("a side S1 to S6 expected, found \"{}\"", excerpt(field)));
  }

  std::string name_;
  AbaqusLines lines_;
  Scope scope_ = Scope::model;
  std::string part_;  ///< the current one
  std::map<std::string, AbaqusPart> parts_;
  std::vector<AbaqusPart> instances_;
  AbaqusPart rest_;                                ///< of a file without parts all, otherwise what the assembly has
  std::map<std::string, std::int64_t> offset_of_;  ///< of an instance's numbers
  std::int64_t offset_of_rest_ = 0;
  Eigen::Isometry3d placement_ = Eigen::Isometry3d::Identity();
  std::map<std::string, std::size_t> passed_over_;
};

}  // namespace

MeshFile read_abaqus_file(const std::string& file) { return Reader(file).read(); }

}  // namespace perimorph::mesh_files
