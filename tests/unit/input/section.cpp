// Parameters declared beside the variables that they fill, in a section that has nothing to do with fracture.

#include "perimorph/input/section.hpp"

#include <gmock/gmock.h>

#include "perimorph/input/resolved.hpp"

namespace perimorph::input {
namespace {

using testing::ElementsAre;

enum class Color { red, green };
struct Word {
  const char* word;
  Color value;
};
constexpr Word colors[] = {{"Red", Color::red}, {"Green", Color::green}};

struct Wheel {
  std::string name;
  double radius = 0.3;
};

struct Car {
  int doors = 4;
  Color color = Color::green;
  std::string plate;
  std::optional<double> load;
  std::vector<double> lamps;
  std::vector<Wheel> wheels;
  Teuchos::ParameterList radio;
};

void declare_wheel(const Section& section, Wheel& wheel) {
  section.parameter("Radius", wheel.radius, above(0.), "r [length].");
}

void declare_car(const Section& section, Car& car) {
  section.parameter("Doors", car.doors, count(), "[-].");
  section.choice("Color", car.color, colors, "Any.");
  section.changeable().required("Plate", car.plate, "A 1", text("a text"), "For people.");
  section.optional("Load", car.load, 100., above(0.), "[mass].");
  section.optional("Lamps", car.lamps, {1., 2.}, numbers("numbers"), "[length].");
  section.entries("Wheels", car.wheels, declare_wheel, "All wheels.", "One wheel.");
  section.changeable().anything("Radio", car.radio, "Any.");
}

Teuchos::ParameterList schema() {
  Teuchos::ParameterList list("car");
  Car defaults;
  declare_car(Section::of_schema(list), defaults);
  return list;
}

/// As a file would have them.
Teuchos::ParameterList values() {
  Teuchos::ParameterList list("car");
  list.set("Doors", 2);
  list.set("Color", "Red");
  list.set("Plate", "B 2");
  list.set("Lamps", Teuchos::Array<double>{{3., 4., 5.}});
  list.sublist("Wheels").sublist("front").set("Radius", 0.4);
  list.sublist("Wheels").sublist("rear").set("Radius", 0.5);
  list.sublist("Radio").set("volume", 11);
  return list;
}

TEST(Section, DefaultsAreTheValuesOfTheVariables) {
  const auto list = schema();
  EXPECT_EQ(list.get<int>("Doors"), 4);
  EXPECT_EQ(list.get<std::string>("Color"), "Green");
  EXPECT_EQ(list.sublist("Wheels").sublist("*").get<double>("Radius"), 0.3);
}

TEST(Section, RulesSayWhatMustBeGiven) {
  const auto list = schema();
  const auto presence = [&](const char* name) { return rule_of(list.getEntry(name)).presence(); };
  EXPECT_EQ(presence("Doors"), Presence::defaulted);
  EXPECT_EQ(presence("Plate"), Presence::required);
  EXPECT_EQ(presence("Load"), Presence::optional);
  EXPECT_THAT(rule_of(list.getEntry("Color")).choices(), ElementsAre("Red", "Green"));
}

TEST(Section, ValuesArriveInTheVariables) {
  const Mistakes none("car.xml");
  const auto list = values();
  Car car;

  declare_car(Section::of_values(list, none), car);

  EXPECT_EQ(car.doors, 2);
  EXPECT_EQ(car.color, Color::red);
  EXPECT_EQ(car.plate, "B 2");
  EXPECT_FALSE(car.load);
  EXPECT_THAT(car.lamps, ElementsAre(3., 4., 5.));
  ASSERT_EQ(car.wheels.size(), 2u);
  EXPECT_EQ(car.wheels[1].name, "rear");
  EXPECT_EQ(car.wheels[1].radius, 0.5);
  EXPECT_EQ(car.radio.get<int>("volume"), 11);
}

TEST(Section, EntriesWithMistakesAreLeftOut) {
  Mistakes mistakes("car.xml");
  mistakes.add(7, "/Wheels/front/Radius", "found -1; allowed is a number > 0");
  const auto list = values();
  Car car;

  declare_car(Section::of_values(list, mistakes), car);

  ASSERT_EQ(car.wheels.size(), 1u);
  EXPECT_EQ(car.wheels[0].name, "rear");
}

TEST(DecidingListing, HasAllButWhatMayChange) {
  EXPECT_EQ(deciding_listing(values(), schema()),
            "/Doors = 2\n"
            "/Color = Red\n"
            "/Lamps = {3, 4, 5}\n"
            "/Wheels/front/Radius = 0.4\n"
            "/Wheels/rear/Radius = 0.5\n");
}

TEST(DecidingListing, ATextWithSeveralLinesLooksLikeNoOtherParameter) {
  auto list = values();
  list.set("Color", std::string("Red\n/Lamps = {3, 4, 5}"));
  EXPECT_THAT(deciding_listing(list, schema()), testing::HasSubstr("/Color = Red\\n/Lamps = {3, 4, 5}\n/Lamps ="));
  list.set("Color", std::string("Red\\n"));
  EXPECT_THAT(deciding_listing(list, schema()), testing::HasSubstr("/Color = Red\\\\n\n"));
}

}  // namespace
}  // namespace perimorph::input
