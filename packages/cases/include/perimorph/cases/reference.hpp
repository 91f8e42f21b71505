#pragma once

#include <string>

namespace perimorph::cases {

/// The reference of the case file as text: path, type, default, allowed values and documentation of each parameter.
std::string describe_schema();

/// The same as a Markdown page, packages/PARAMETERS.md.
std::string describe_schema_in_markdown();

/// The schema in RELAX NG (XML syntax), for editors: names, types, and words where only some are allowed.
std::string describe_schema_in_relax_ng();

}  // namespace perimorph::cases
