#include "perimorph/model/refinement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/fracture_body.hpp"

namespace perimorph::tests {
namespace {

using model::Refinement;

/// 16 x 16 elements of size 2 with a zone of radius 2 in the middle; a growth's is 4.
Specimen specimen() {
  Specimen specimen{grid({16, 16, 32., 32.}), 1., 0.3};
  specimen.seeds = {Zone<2>::ball({16., 16.}, 1.5, 2.)};
  return specimen;
}

model::NumericalOptions options_of(const Specimen& specimen) {
  auto options = make_options(specimen);
  options.refinement.levels = 2;
  return options;
}

Refinement<2> refinement_of(const Specimen& specimen, const model::Problem<2>& problem,
                            const model::NumericalOptions& options) {
  return {Tpetra::getDefaultComm(), specimen.whole, problem, options};
}

double length_of_boundary(const mesh::Mesh<2>& mesh) {
  double length = 0.;
  for (const auto& side : mesh.boundary) {
    const auto ends = mesh::corner_points(mesh, side);
    length += (ends[1] - ends[0]).norm();
  }
  return length;
}

double smallest_radius_near(const mesh::Mesh<2>& mesh, const Point2& place) {
  double smallest = 1e30;
  for (int e = 0; e < mesh.n_elements(); ++e) {
    if ((mesh::centroid(mesh, e) - place).norm() < 1.5) smallest = std::min(smallest, mesh::radius(mesh, e));
  }
  return smallest;
}

constexpr double finest = 0.25 * 1.4142135623730951;

TEST(Refinement, ElementsAreFinestAroundZonesAndGroups) {
  const auto body = specimen();
  const auto problem = make_problem(body);
  auto options = options_of(body);
  const auto refinement = refinement_of(body, problem, options);

  EXPECT_NEAR(smallest_radius_near(refinement.mesh(), {16., 16.}), finest, 1e-12);
  EXPECT_GT(smallest_radius_near(refinement.mesh(), {0., 0.}), 3. * finest);
  EXPECT_GT(smallest_radius_near(refinement.mesh(), {32., 0.}), 3. * finest);
  EXPECT_THAT(refinement.description(), testing::HasSubstr("of the 4096 that are as fine everywhere"));

  auto whole = body;
  whole.whole.node_sets["corner"] = {0};
  options.refinement.groups = {"corner"};
  const auto with_group = refinement_of(whole, problem, options);
  EXPECT_NEAR(smallest_radius_near(with_group.mesh(), {0., 0.}), finest, 1e-12);
  EXPECT_GT(smallest_radius_near(with_group.mesh(), {32., 0.}), 3. * finest);
}

TEST(Refinement, PreCracksThroughElementsOpenWhereSmallerOnesLieAlongThem) {
  auto body = specimen();
  body.pre_cracks = {{Point2(10., 15.), Point2(16., 15.)}};
  const auto problem = make_problem(body);

  const auto refinement = refinement_of(body, problem, options_of(body));

  EXPECT_NEAR(length_of_boundary(refinement.mesh()), 4. * 32. + 2. * 6., 1e-9);
  EXPECT_NEAR(smallest_radius_near(refinement.mesh(), {10., 15.}), finest, 1e-12);
}

TEST(Refinement, SaysWhenNothingIsDivided) {
  auto body = specimen();
  const auto options = options_of(body);
  const auto problem = make_problem(body);
  EXPECT_TRUE(refinement_of(body, problem, options).warnings().empty());
  body.seeds.clear();
  const auto without = make_problem(body);

  EXPECT_THAT(refinement_of(body, without, options).warnings(),
              testing::ElementsAre(testing::HasSubstr("no element is divided")));
}

TEST(Refinement, FollowsFlagPointsAndGoesBack) {
  const auto body = specimen();
  const auto problem = make_problem(body);
  const auto options = options_of(body);
  auto refinement = refinement_of(body, problem, options);
  const auto first = refinement.mesh().coordinates;
  const Refinement<2>::FlagPoints near = {{0, 1, {16.25, 16.25}}}, far = {near[0], {1, 2, {24.25, 16.25}}};

  EXPECT_TRUE(refinement.serves({}));
  EXPECT_FALSE(refinement.serves(far));
  const auto n = refinement.mesh().n_elements();
  const auto descents = refinement.follow(far);

  EXPECT_TRUE(refinement.serves(far));
  EXPECT_GT(refinement.mesh().n_elements(), n);
  EXPECT_EQ(static_cast<int>(descents.size()), refinement.mesh().n_elements());
  EXPECT_NEAR(smallest_radius_near(refinement.mesh(), {24., 16.}), finest, 1e-12);
  EXPECT_EQ(refinement.calls(), std::vector<base::GlobalId>{2});
  const auto second = refinement.mesh().coordinates;

  refinement.go_to({}, {});
  EXPECT_EQ(refinement.mesh().coordinates, first);
  refinement.go_to(far, {2});
  EXPECT_EQ(refinement.mesh().coordinates, second);
}

}  // namespace
}  // namespace perimorph::tests
