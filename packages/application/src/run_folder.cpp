#include "run_folder.hpp"

#include <Teuchos_XMLParameterListHelpers.hpp>
#include <filesystem>
#include <fstream>

#include "perimorph/base/errors.hpp"
#include "perimorph/output/results.hpp"

namespace perimorph::application {

namespace {

/// The names that a run writes to are none of those that it reads.
void check_not_overwritten(const cases::Case& input, const std::string& folder) {
  const auto is_result = [&](const std::string& file) {
    std::error_code ignored;
    for (const std::string& name :
         {folder + "/resolved.xml", folder + "/" + input.name + ".e", output::unfinished_file(folder, input.name)}) {
      if (std::filesystem::equivalent(name, file, ignored)) return true;
    }
    return false;
  };
  for (const auto& [file, what] : {std::pair{input.file, "case"}, {input.mesh.file, "mesh"}}) {
    if (!is_result(file)) continue;
    throw base::UserError(
        fmt::format("{}: the results would replace the {}: name another folder with --output", file, what));
  }
}

}  // namespace

RunFolder::RunFolder(const Teuchos::RCP<const base::Comm>& comm, const cases::Case& input, const std::string& path,
                     const base::Log& log)
    : comm_(comm),
      input_(input),
      path_(path),
      for_mesh_((std::filesystem::path(path) / "mesh.part").string()),
      log_(log) {
  using Rank = io::FolderLock::Rank;
  for (const Rank rank : {Rank::first, Rank::other}) {
    base::on_all_ranks(*comm_, [&] {
      if ((rank == Rank::first) != (comm_->getRank() == 0)) return;
      if (rank == Rank::first) make();
      lock_.emplace(path_, rank);
      std::error_code ignored;
      const bool meshes = rank == Rank::first && mesh_files::is_geometry(input_.mesh.file);
      if (meshes) std::filesystem::create_directory(for_mesh_, ignored);  // or gmsh says so
    });
  }
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (comm_->getRank() == 0) std::filesystem::remove_all(for_mesh_, ignored);
}

void RunFolder::make() const {
  check_not_overwritten(input_, path_);
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) throw base::UserError(fmt::format("{}: the output folder cannot be made: {}", path_, error.message()));
}

void RunFolder::open_log(bool append) {
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() == 0 && !has_log_) base::open_file(log_, path_ + "/run.log", append);
  });
  has_log_ = true;
}

void RunFolder::take_over(bool append_to_log) {
  open_log(append_to_log);
  base::on_all_ranks(*comm_, [&] {
    if (comm_->getRank() != 0) return;
    write_resolved();
    move_mesh();
  });
}

void RunFolder::write_resolved() const {
  const std::string file = path_ + "/resolved.xml";
  std::ofstream stream(file);
  Teuchos::writeParameterListToXmlOStream(input_.resolved, stream);
  stream.close();
  if (!stream) throw base::UserError(fmt::format("{}: cannot be written", file));
}

void RunFolder::move_mesh() const {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(for_mesh_, error)) {
    const auto file = std::filesystem::path(path_) / entry.path().filename();
    std::filesystem::rename(entry.path(), file, error);
    if (error) throw base::UserError(fmt::format("{}: cannot be written: {}", file.string(), error.message()));
  }
  std::filesystem::remove(for_mesh_, error);
}

}  // namespace perimorph::application
