#include "perimorph/cases/reference.hpp"

#include <fmt/format.h>

#include "perimorph/cases/case.hpp"
#include "perimorph/input/reference.hpp"

namespace perimorph::cases {

namespace {

constexpr const char* title = "Every parameter of a case file";
constexpr const char* units = "any consistent set will do (mm, N and MPa; or m, N and Pa)";

}  // namespace

std::string describe_schema() {
  return fmt::format(
             "{}. A path such as /Solver/Tolerance is\n"
             "    <ParameterList name=\"Solver\"> <Parameter name=\"Tolerance\" type=\"double\" value=\"1e-6\"/> "
             "</ParameterList>\n"
             "in the file, and --set \"Solver/Tolerance=1e-6\" on the command line; * is a name of your choice.\n"
             "Units are in brackets; {}.\n\n",
             title, units) +
         input::describe(case_schema());
}

std::string describe_schema_in_markdown() {
  return fmt::format(
             "# {}\n\n"
             "Made by `perimorph params --markdown` from the sections in `cases/src`; change it there. "
             "`/Solver/Tolerance` is\n\n"
             "```xml\n<ParameterList name=\"Solver\">\n  <Parameter name=\"Tolerance\" type=\"double\" "
             "value=\"1e-6\"/>\n"
             "</ParameterList>\n```\n\n"
             "in the file, and `--set \"Solver/Tolerance=1e-6\"` on the command line; `*` is a name of your choice.\n"
             "Units are in brackets; {}. Keys such as WHL19 are in [README.md](README.md).\n",
             title, units) +
         input::describe_in_markdown(case_schema());
}

std::string describe_schema_in_relax_ng() { return input::describe_in_relax_ng(case_schema()); }

}  // namespace perimorph::cases
