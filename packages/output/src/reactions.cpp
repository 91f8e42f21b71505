#include "perimorph/output/reactions.hpp"

#include <cmath>

#include "component_names.hpp"
#include "own_nodes.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/base/sums.hpp"

namespace perimorph::output {

template <int dim>
std::vector<Reaction> reactions_of(const std::vector<std::string>& groups) {
  std::vector<Reaction> reactions;
  for (const auto& group : groups) {
    for (int c = 0; c < dim; ++c) reactions.push_back({group + "_" + axis_names[c], group, c});
  }
  return reactions;
}

template <int dim>
void measure(const base::Comm& comm, int increment, const fracture::Body<dim>& body, std::vector<Reaction>& reactions) {
  PERIMORPH_ASSERT(increment > 0, "increment {}", increment);
  struct Sum {
    double force = 0., displacement = 0., nodes = 0.;
  };
  std::vector<Sum> sums(reactions.size());
  std::vector<double*> values;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    PERIMORPH_ASSERT(reactions[i].component >= 0 && reactions[i].component < dim, "{}: component {}",
                     reactions[i].column, reactions[i].component);
    for (const int n : own_nodes_in(body, body.mesh().node_sets.at(reactions[i].group))) {
      sums[i].force += body.reaction(n)[reactions[i].component];
      sums[i].displacement += body.displacement()[n * dim + reactions[i].component];
      sums[i].nodes += 1.;
    }
    values.insert(values.end(), {&sums[i].force, &sums[i].displacement, &sums[i].nodes});
  }
  base::sum(comm, values);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    auto& reaction = reactions[i];
    reaction.force = sums[i].force;
    reaction.displacement = sums[i].displacement / std::max(sums[i].nodes, 1.);
    if (std::abs(reaction.force) <= std::abs(reaction.peak)) continue;
    reaction.peak = reaction.force;
    reaction.peak_increment = increment;
  }
}

#define PERIMORPH_INSTANTIATE(dim)                                                   \
  template std::vector<Reaction> reactions_of<dim>(const std::vector<std::string>&); \
  template void measure(const base::Comm&, int, const fracture::Body<dim>&, std::vector<Reaction>&);

PERIMORPH_INSTANTIATE(2)
PERIMORPH_INSTANTIATE(3)

}  // namespace perimorph::output
