#include "perimorph/output/results_state.hpp"

#include <algorithm>
#include <filesystem>

#include "open_table.hpp"
#include "perimorph/base/errors.hpp"

namespace perimorph::output {

std::vector<io::FileExtent> files_of(const ResultsState& state) {
  auto files = state.tables;
  files.insert(files.end(), state.fields.begin(), state.fields.end());
  files.insert(files.end(), state.bonds.begin(), state.bonds.end());
  return files;
}

std::unique_ptr<io::History> open_table(const std::string& folder, const std::string& name,
                                        const std::vector<std::string>& columns,
                                        const std::optional<ResultsState>& earlier) {
  const std::string file = (std::filesystem::path(folder) / name).string();
  if (!earlier) return std::make_unique<io::History>(file, columns);
  const auto& tables = earlier->tables;
  const auto extent = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.name == name; });
  if (extent == tables.end()) throw base::UserError(file + ": it cannot be continued: the earlier run had none");
  return std::make_unique<io::History>(io::History::resume(file, columns, *extent));
}

}  // namespace perimorph::output
