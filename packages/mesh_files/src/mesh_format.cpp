#include "mesh_format.hpp"

#include <filesystem>
#include <fstream>
#include <map>

#include "text_fields.hpp"

namespace perimorph::mesh_files {

namespace {

constexpr int most_lines = 10000;  // before one that says what the file is: comments, a heading

MeshFormat format_of_ending(const std::string& file) {
  static const std::map<std::string, MeshFormat> formats = {
      {".msh", MeshFormat::gmsh},    {".e", MeshFormat::exodus},     {".exo", MeshFormat::exodus},
      {".g", MeshFormat::exodus},    {".gen", MeshFormat::exodus},   {".ex2", MeshFormat::exodus},
      {".exii", MeshFormat::exodus}, {".exoii", MeshFormat::exodus}, {".cdb", MeshFormat::ansys},
      {".inp", MeshFormat::abaqus}};
  const auto found = formats.find(lower(std::filesystem::path(file).extension()));
  return found == formats.end() ? MeshFormat::unknown : found->second;
}

/// The first word of a line, in lower case.
std::string first_word(const std::string& line) {
  const std::size_t begin = std::min(line.find_first_not_of(" \t\r"), line.size());
  const std::size_t end = std::min(line.find_first_of(" \t\r,", begin), line.size());
  return lower(line.substr(begin, end - begin));
}

MeshFormat format_of_line(const std::string& line) {
  static const std::map<std::string, MeshFormat> formats = {
      {"$meshformat", MeshFormat::gmsh}, {"/prep7", MeshFormat::ansys},     {"/com", MeshFormat::ansys},
      {"/batch", MeshFormat::ansys},     {"/title", MeshFormat::ansys},     {"et", MeshFormat::ansys},
      {"etblock", MeshFormat::ansys},    {"nblock", MeshFormat::ansys},     {"*heading", MeshFormat::abaqus},
      {"*node", MeshFormat::abaqus},     {"*element", MeshFormat::abaqus},  {"*part", MeshFormat::abaqus},
      {"*assembly", MeshFormat::abaqus}, {"*preprint", MeshFormat::abaqus}, {"*include", MeshFormat::abaqus}};
  const auto found = formats.find(first_word(line));
  return found == formats.end() ? MeshFormat::unknown : found->second;
}

MeshFormat format_of_content(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return MeshFormat::unknown;
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  for (int n = 0; n < most_lines && std::getline(stream, line); ++n) {
    const bool is_binary = n == 0 && (line.rfind("CDF", 0) == 0 || line.rfind("\x89HDF", 0) == 0);
    if (is_binary) return MeshFormat::exodus;
    if (const MeshFormat format = format_of_line(line); format != MeshFormat::unknown) return format;
  }
  return MeshFormat::unknown;
}

}  // namespace

MeshFormat format_of(const std::string& file) {
  const MeshFormat format = format_of_content(file);
  return format == MeshFormat::unknown ? format_of_ending(file) : format;
}

}  // namespace perimorph::mesh_files
