#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perimorph/io/history.hpp"
#include "perimorph/output/results_state.hpp"

namespace perimorph::output {

/// A table in the folder of the results: a new one, or that of an earlier run, which is cut back to its state then.
/// Local (rank 0). @throws UserError if it cannot be written, or the earlier run had none.
std::unique_ptr<io::History> open_table(const std::string& folder, const std::string& name,
                                        const std::vector<std::string>& columns,
                                        const std::optional<ResultsState>& earlier);

}  // namespace perimorph::output
