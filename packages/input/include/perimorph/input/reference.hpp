#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>

namespace perimorph::input {

/// The schema as text: path, type, default, allowed values and documentation of each parameter. Local.
std::string describe(const Teuchos::ParameterList& schema);

/// The same in Markdown: a heading for each section, and a table of its parameters. Local.
std::string describe_in_markdown(const Teuchos::ParameterList& schema);

/// The schema in RELAX NG (XML syntax), for editors: names, types, and words where only some are allowed. Local.
std::string describe_in_relax_ng(const Teuchos::ParameterList& schema);

}  // namespace perimorph::input
