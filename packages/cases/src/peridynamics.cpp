#include "perimorph/cases/peridynamics.hpp"

#include <array>

#include "choices.hpp"

namespace perimorph::cases {

namespace {

enum class Micromodulus { exponential };
constexpr std::array<Choice<Micromodulus>, 1> micromoduli{{{"Exponential", Micromodulus::exponential}}};

using discretization::CrackFaces;
constexpr std::array<Choice<CrackFaces>, 2> crack_faces{{{"Free", CrackFaces::free}, {"Contact", CrackFaces::contact}}};

}  // namespace

void declare(const input::Section& section, Peridynamics& peridynamics, model::NumericalOptions& numerical) {
  using namespace input;
  section.required("Horizon", peridynamics.horizon, 1.5, above(0.),
                   "delta [length]: the longest bond. Four element sizes, and twelve characteristic lengths, are a "
                   "good choice; WHL19 takes three and fifteen. Much less leaves too few bonds, and cracks follow the "
                   "mesh; more costs with its square, in three dimensions with its cube.");
  auto micromodulus = Micromodulus::exponential;  // there is no other yet
  section.choice("Micromodulus", micromodulus, micromoduli,
                 "Stiffness of a bond over its length: c0(xi) = tau0 exp(-|xi|/l) [WHL19, eq. 24]; tau0 follows from "
                 "Young's modulus [WHL19, eq. 17].");
  section.required(
      "Characteristic Length", peridynamics.characteristic_length, 0.1, above(0.),
      "l [length] in the micromodulus, below the horizon. A third of the element size is a good choice; with a fifth, "
      "as in WHL19, cracks are held up between elements, by 30 %. From a ninth of the horizon on, the horizon cuts the "
      "micromodulus off: the body is too soft and the fracture energy falls short.");
  section.choice("Crack Faces", peridynamics.crack_faces, crack_faces,
                 "What happens where a crack closes. \"Free\": its faces pass through each other (overlap in "
                 "history.csv). \"Contact\": they press on each other and may slide, which holds for small "
                 "sliding, and for pre-cracks and slits without width where the body is peridynamic on both sides: put "
                 "seeds along them.");
  section.parameter("Friction Coefficient", peridynamics.friction, at_least(0.),
                    "Of crack faces in contact (Coulomb): the largest friction over the normal force [-].");
  section.parameter(
      "Points per Direction", numerical.points_per_direction, either(2, 3),
      "Gauss points of a quadrilateral or hexahedron along each of its directions [-]: the material points that bonds "
      "join, and at which strains are taken. 2 or 3; of triangles then 3 or 6, of tetrahedra 4 or 11, of wedges 6 or "
      "18. 3 makes five times as many bonds, in three dimensions eleven times. With a characteristic length of a "
      "quarter of an element or less, cracks are then held up half as much; the calibration is as \"Analytic\".");
}

void check_peridynamics(const input::Values& root) {
  const auto section = root.sub("Peridynamics");
  const std::string* faces = section.text("Crack Faces");
  const bool is_contact = faces != nullptr && *faces == "Contact";
  if (is_contact && !root.sub("Boundary Conditions").subs("Symmetry Planes").empty()) {
    section.mistake("Crack Faces",
                    "found \"Contact\"; with /Boundary Conditions/Symmetry Planes allowed is \"Free\": contact across "
                    "the planes is not computed");
  }
  const std::string* discontinuous = root.sub("Morphing").text("Discontinuous Elements");
  if (is_contact && discontinuous != nullptr && *discontinuous == "Never") {
    section.mistake(
        "Crack Faces",
        "found \"Contact\"; with /Morphing/Discontinuous Elements = \"Never\" allowed is \"Free\": elements "
        "that do not part have no faces");
  }
  const double* friction = section.number("Friction Coefficient");
  if (faces != nullptr && friction != nullptr && *friction > 0. && !is_contact) {
    section.mistake("Friction Coefficient",
                    fmt::format("found {:.6g}; allowed with \"Crack Faces\" = \"{}\" is 0: faces rub where they press "
                                "on each other",
                                *friction, *faces));
  }
  input::check_order(section, "Characteristic Length", "Horizon");
  const double *horizon = section.number("Horizon"), *length = section.number("Characteristic Length");
  if (horizon == nullptr || length == nullptr || *horizon <= longest_horizon * *length) return;
  section.mistake("Horizon",
                  fmt::format("found {:.6g}; allowed is up to {:.0f} times \"Characteristic Length\", which is "
                              "{:.6g} (twelve times are usual)",
                              *horizon, longest_horizon, *length));
}

}  // namespace perimorph::cases
