#include "perimorph/io/exodus.hpp"

#include <exodusII.h>

#include <algorithm>
#include <climits>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <regex>

#include "perimorph/base/errors.hpp"
#include "perimorph/io/disk.hpp"

namespace perimorph::io {

namespace {

constexpr std::size_t usual_name_length = 64;

std::string name_in_series(const std::string& first, int number) {
  return number == 1 ? first : fmt::format("{}-s{:04d}", first, number);
}

/// As ParaView and the SEACAS tools expect it: the rank with as many digits as the number of ranks.
std::string ending_of(const SpreadPart& part) {
  return fmt::format(".{}.{:0{}}", part.n_ranks, part.rank, std::to_string(part.n_ranks).size());
}

/// What the Exodus library says about its last error: codes above 0 are the system's (28: no space left on device).
std::string last_reason() {
  const char* message = nullptr;
  const char* function = nullptr;
  int code = 0;
  ex_get_err(&message, &function, &code);
  if (code > 0 && code < EX_MEMFAIL) return std::strerror(code);
  return fmt::format("{} (netCDF or Exodus error {})", message == nullptr ? "" : message, code);
}

[[noreturn]] void fail(const std::string& file, const char* what) {
  throw base::ComputationError(fmt::format("{}: the {} cannot be written: {}", file, what, last_reason()));
}

/// The file under construction. Warnings (status above 0) are not errors.
struct File {
  int id;
  std::string name;
  void check(int status, const char* what) const {
    if (status < 0) fail(name, what);
  }
};

/// The C interface takes arrays of char* that it does not change.
std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size());
  for (const auto& text : texts) result.push_back(const_cast<char*>(text.c_str()));
  return result;
}

std::vector<int> one_based(const std::vector<int>& indices) {
  std::vector<int> result(indices);
  for (int& index : result) ++index;
  return result;
}

/// Lines short enough that the library writes the zero after them too (after a full line it leaves what the disk held);
/// a UTF-8 character is not cut in two.
std::vector<std::string> split_lines(const std::vector<std::string>& lines) {
  const auto continues_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  constexpr std::size_t longest = MAX_LINE_LENGTH - 1;
  std::vector<std::string> result;
  for (const auto& line : lines) {
    std::size_t begin = 0;
    do {
      std::size_t end = std::min(begin + longest, line.size());
      while (end < line.size() && end > begin + 1 && continues_character(line[end])) --end;
      result.push_back(line.substr(begin, end - begin));
      begin = end;
    } while (begin < line.size());
  }
  return result;
}

std::string now(const char* format) {
  const std::time_t time = std::time(nullptr);
  std::tm local{};
  localtime_r(&time, &local);
  char text[MAX_STR_LENGTH + 1];
  std::strftime(text, sizeof text, format, &local);
  return text;
}

void put_records(const File& file, const std::vector<std::string>& information) {
  std::vector<std::string> record = {"perimorph", PERIMORPH_VERSION, now("%Y-%m-%d"), now("%H:%M:%S")};
  const std::vector<char*> fields = pointers(record);
  char* quality_record[1][4] = {{fields[0], fields[1], fields[2], fields[3]}};
  file.check(ex_put_qa(file.id, 1, quality_record), "QA record");

  const std::vector<std::string> lines = split_lines(information);
  if (lines.empty()) return;
  file.check(ex_put_info(file.id, static_cast<int>(lines.size()), pointers(lines).data()), "info records");
}

template <int dim>
std::vector<int> sizes_of(const ExodusModel<dim>& model) {
  std::vector<int> sizes;
  for (const auto& block : model.blocks) {
    const std::size_t n = block.element_ids.size();
    const bool is_part = !model.node_ids.empty() || model.coordinates.empty();  // perhaps of a rank without elements
    PERIMORPH_ASSERT(n > 0 || is_part, "block {} is empty", block.name);
    PERIMORPH_ASSERT(block.connectivity.size() == n * mesh::n_corners(block.type),
                     "block {} has {} elements but {} corners", block.name, n, block.connectivity.size());
    sizes.push_back(static_cast<int>(n));
  }
  return sizes;
}

/// Exodus would cut longer names, of which two may then be one.
template <int dim>
std::size_t longest_name(const ExodusModel<dim>& model, const typename ExodusSeries<dim>::Names& names) {
  std::size_t longest = usual_name_length;
  const auto include = [&](const std::string& name) { longest = std::max(longest, name.size()); };
  for (const auto& block : model.blocks) include(block.name);
  for (const auto& set : model.node_sets) include(set.first);
  for (const auto& set : model.side_sets) include(set.first);
  for (const auto* variables : {&names.globals, &names.nodal, &names.element}) {
    for (const auto& name : *variables) include(name);
  }
  return longest;
}

template <int dim>
std::vector<int> ids_of(const std::vector<typename ExodusModel<dim>::Block>& blocks) {
  std::vector<int> ids;
  for (const auto& block : blocks) ids.push_back(block.id > 0 ? block.id : static_cast<int>(ids.size()) + 1);
  return ids;
}

template <int dim>
void define_sizes(const File& file, const ExodusModel<dim>& model, const std::string& title, int n_elements) {
  ex_init_params sizes{};
  title.copy(sizes.title, MAX_LINE_LENGTH);
  sizes.num_dim = dim;
  sizes.num_nodes = static_cast<int64_t>(model.coordinates.size());
  sizes.num_elem = n_elements;
  sizes.num_elem_blk = static_cast<int64_t>(model.blocks.size());
  sizes.num_node_sets = static_cast<int64_t>(model.node_sets.size());
  sizes.num_side_sets = static_cast<int64_t>(model.side_sets.size());
  file.check(ex_put_init_ext(file.id, &sizes), "header");
}

template <int dim>
void define_blocks_and_sets(const File& file, const ExodusModel<dim>& model) {
  const std::vector<int> ids = ids_of<dim>(model.blocks);
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const auto& block = model.blocks[b];
    const int id = ids[b];
    const auto type = mesh::exodus_name(block.type);
    file.check(ex_put_block(file.id, EX_ELEM_BLOCK, id, type.c_str(), static_cast<int64_t>(block.element_ids.size()),
                            mesh::n_corners(block.type), 0, 0, 0),
               "element blocks");
    file.check(ex_put_name(file.id, EX_ELEM_BLOCK, id, block.name.c_str()), "names of the element blocks");
  }
  const auto define_sets = [&](ex_entity_type kind, const auto& sets) {
    int number = 0;
    for (const auto& [name, members] : sets) {
      file.check(ex_put_set_param(file.id, kind, ++number, static_cast<int64_t>(members.size()), 0), "sets");
      file.check(ex_put_name(file.id, kind, number, name.c_str()), "names of the sets");
    }
  };
  define_sets(EX_NODE_SET, model.node_sets);
  define_sets(EX_SIDE_SET, model.side_sets);
}

void define_variables(const File& file, ex_entity_type kind, const std::vector<std::string>& names) {
  if (names.empty()) return;
  const int n = static_cast<int>(names.size());
  file.check(ex_put_variable_names(file.id, kind, n, pointers(names).data()), "names of the variables");
}

template <int dim>
void put_coordinates(const File& file, const std::vector<base::Point<dim>>& coordinates) {
  std::vector<std::vector<double>> axes(3, std::vector<double>(coordinates.size()));
  for (std::size_t n = 0; n < coordinates.size(); ++n) {
    for (int d = 0; d < dim; ++d) axes[d][n] = coordinates[n][d];
  }
  const std::vector<std::string> names = {"x", "y", "z"};
  file.check(ex_put_coord_names(file.id, pointers(names).data()), "names of the coordinates");
  file.check(ex_put_coord(file.id, axes[0].data(), axes[1].data(), axes[2].data()), "coordinates");
}

/// Defines a map and writes it: comes before the large data.
void put_ids(const File& file, ex_entity_type kind, const std::vector<base::GlobalId>& ids) {
  std::vector<int> numbers;
  for (const base::GlobalId id : ids) {
    PERIMORPH_ASSERT(id < INT_MAX, "id {} is too large for an Exodus map of ints", id);
    numbers.push_back(static_cast<int>(id) + 1);
  }
  if (!numbers.empty()) file.check(ex_put_id_map(file.id, kind, numbers.data()), "ids");
}

template <int dim>
std::vector<base::GlobalId> element_ids(const ExodusModel<dim>& model) {
  std::vector<base::GlobalId> ids;
  for (const auto& block : model.blocks) ids.insert(ids.end(), block.element_ids.begin(), block.element_ids.end());
  return ids;
}

template <int dim>
void put_elements(const File& file, const std::vector<typename ExodusModel<dim>::Block>& blocks) {
  const std::vector<int> ids = ids_of<dim>(blocks);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].element_ids.empty()) continue;
    const std::vector<int> corners = one_based(blocks[b].connectivity);
    file.check(ex_put_conn(file.id, EX_ELEM_BLOCK, ids[b], corners.data(), nullptr, nullptr), "elements");
  }
}

template <int dim>
void put_sets(const File& file, const ExodusModel<dim>& model) {
  int id = 0;
  for (const auto& [name, nodes] : model.node_sets) {
    ++id;
    if (nodes.empty()) continue;
    file.check(ex_put_set(file.id, EX_NODE_SET, id, one_based(nodes).data(), nullptr), "node sets");
  }
  id = 0;
  for (const auto& [name, members] : model.side_sets) {
    ++id;
    if (members.empty()) continue;
    std::vector<int> elements, sides;
    for (const auto& member : members) {
      elements.push_back(member.element + 1);
      sides.push_back(member.side + 1);
    }
    file.check(ex_put_set(file.id, EX_SIDE_SET, id, elements.data(), sides.data()), "side sets");
  }
}

/// Which file of a series a name stands for, whole or spread over any number of ranks; 0 if for none.
int number_in_series(const std::string& first, const std::string& name) {
  static const std::regex ending(R"((?:-s(\d{4,9}))?(?:\.\d{1,9}\.\d{1,9})?)");
  std::smatch match;
  if (name.rfind(first, 0) != 0) return 0;
  const std::string rest = name.substr(first.size());
  if (!std::regex_match(rest, match, ending)) return 0;
  return match[1].matched ? std::stoi(match[1]) : 1;
}

/// In netCDF's classic formats bytes 4 to 7 are the number of records, which are the steps, high byte first.
void cut_steps(const std::string& file, int n_steps) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  char header[8] = {};
  stream.read(header, sizeof header);
  const bool is_classic = stream && std::memcmp(header, "CDF", 3) == 0 && (header[3] == 1 || header[3] == 2);
  unsigned int n_present = 0;
  for (int i = 4; i < 8; ++i) n_present = 256 * n_present + static_cast<unsigned char>(header[i]);
  if (!is_classic || n_present < static_cast<unsigned int>(n_steps)) {
    throw base::UserError(
        fmt::format("{}: the series cannot be continued: this is no file with {} steps or more", file, n_steps));
  }
  if (n_present == static_cast<unsigned int>(n_steps)) return;
  for (int i = 0; i < 4; ++i) header[7 - i] = static_cast<char>((n_steps >> 8 * i) & 255);
  stream.seekp(4);
  stream.write(header + 4, 4);
  stream.close();
  if (!stream) throw base::UserError(fmt::format("{}: the series cannot be written", file));
  bring_to_disk(file);
}

}  // namespace

template <int dim>
ExodusSeries<dim>::ExodusSeries(std::string file, std::string title, Names names, std::vector<std::string> information,
                                std::optional<SpreadPart> part)
    : file_(std::move(file)),
      title_(std::move(title)),
      part_(part),
      names_(std::move(names)),
      information_(std::move(information)) {
  PERIMORPH_ASSERT(!file_.empty(), "a series without a name");
  PERIMORPH_ASSERT(!part || (part->rank >= 0 && part->rank < part->n_ranks), "{}: part {} of {}", file_, part->rank,
                   part->n_ranks);
}

template <int dim>
ExodusSeries<dim>::~ExodusSeries() {
  // Every step has been flushed: nothing of value is lost if closing fails, and a destructor must not throw.
  if (exodus_id_ >= 0) ex_close(exodus_id_);
}

template <int dim>
std::string ExodusSeries<dim>::file(int number, int rank) const {
  return name_in_series(file_, number) + (part_ ? ending_of({rank, part_->n_ranks}) : "");
}

template <int dim>
std::string ExodusSeries<dim>::own_file(int number) const {
  return file(number, part_ ? part_->rank : 0);
}

template <int dim>
void ExodusSeries<dim>::check(int status, const char* what) const {
  if (status < 0) fail(own_file(n_files_), what);
}

template <int dim>
void ExodusSeries<dim>::close() {
  if (exodus_id_ < 0) return;
  const int id = exodus_id_;
  exodus_id_ = -1;
  check(ex_close(id), "end of the file");
}

template <int dim>
void ExodusSeries<dim>::resume(const SeriesExtent& extent) {
  PERIMORPH_ASSERT(exodus_id_ < 0, "{}: resumed after start()", file_);
  PERIMORPH_ASSERT(extent.files >= 0 && extent.steps >= 0, "{}: {} files, {} steps", file_, extent.files, extent.steps);
  n_files_ = n_on_disk_ = extent.files;
  n_steps_ = extent.steps;
}

template <int dim>
void ExodusSeries<dim>::remove_the_rest() const {
  const std::filesystem::path path(file_);
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::vector<std::filesystem::path> later;  // would be opened as part of this series
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const int number = number_in_series(path.filename(), entry.path().filename());
    if (number > n_files_) later.push_back(entry.path());
    if (number > 0 && number == n_files_) cut_steps(entry.path(), n_steps_);
  }
  for (const auto& other : later) std::filesystem::remove(other, error);
}

template <int dim>
base::GlobalId ExodusSeries<dim>::current_size() const {
  return size_of(own_file(n_files_));
}

template <int dim>
void ExodusSeries<dim>::bring_to_disk() {
  for (int number = n_on_disk_ + 1; number <= n_files_; ++number) io::bring_to_disk(own_file(number));
  if (exodus_id_ >= 0) n_on_disk_ = n_files_ - 1;  // more follows in the last one
}

template <int dim>
void ExodusSeries<dim>::start(const ExodusModel<dim>& model) {
  close();
  block_sizes_ = sizes_of(model);
  block_ids_ = ids_of<dim>(model.blocks);
  ++n_files_;
  n_steps_ = 0;

  // The 64-bit-offset format needs neither HDF5 nor MPI, and is as fast. netCDF drops blanks before a relative path,
  // and takes one such as http://x for an address.
  int our_word_size = sizeof(double), file_word_size = sizeof(double);
  const std::string path = std::filesystem::absolute(own_file(n_files_)).lexically_normal();
  exodus_id_ = ex_create(path.c_str(), EX_CLOBBER | EX_LARGE_MODEL, &our_word_size, &file_word_size);
  check(exodus_id_, "file");
  check(ex_set_max_name_length(exodus_id_, static_cast<int>(longest_name(model, names_))), "header");

  // All definitions first: a definition after data would move the data.
  const File file{exodus_id_, own_file(n_files_)};
  define_sizes(file, model, title_, std::accumulate(block_sizes_.begin(), block_sizes_.end(), 0));
  define_blocks_and_sets(file, model);
  const bool is_empty = model.coordinates.empty();  // a rank without elements has no variables on nodes and elements
  const auto nodal = is_empty ? std::vector<std::string>() : names_.nodal;
  const auto element = is_empty ? std::vector<std::string>() : names_.element;
  const int n_element_variables = static_cast<int>(element.size());
  std::vector<int> everywhere(block_sizes_.size() * n_element_variables, 1);
  check(ex_put_all_var_param(exodus_id_, static_cast<int>(names_.globals.size()), static_cast<int>(nodal.size()),
                             n_element_variables, everywhere.data(), 0, nullptr, 0, nullptr),
        "variables");
  define_variables(file, EX_GLOBAL, names_.globals);
  define_variables(file, EX_NODAL, nodal);
  define_variables(file, EX_ELEM_BLOCK, element);
  put_records(file, information_);  // after these, as what follows a line in it is what the file held there

  put_ids(file, EX_ELEM_MAP, element_ids(model));
  put_ids(file, EX_NODE_MAP, model.node_ids);
  put_elements<dim>(file, model.blocks);
  put_coordinates<dim>(file, model.coordinates);
  put_sets(file, model);
  check(ex_update(exodus_id_), "mesh");
}

template <int dim>
void ExodusSeries<dim>::write(const ExodusStep& step) {
  PERIMORPH_ASSERT(exodus_id_ >= 0, "{}: a step before start()", file_);
  const auto n_nodes = static_cast<std::size_t>(ex_inquire_int(exodus_id_, EX_INQ_NODES));
  const auto n_elements = static_cast<std::size_t>(std::accumulate(block_sizes_.begin(), block_sizes_.end(), 0));
  const auto n_wrong = [](const auto& variables, std::size_t size) {
    return std::count_if(variables.begin(), variables.end(), [&](const auto& v) { return v.size() != size; });
  };
  PERIMORPH_ASSERT(step.globals.size() == names_.globals.size() && step.nodal.size() == names_.nodal.size() &&
                       step.element.size() == names_.element.size(),
                   "{} global, {} nodal, {} element variables", step.globals.size(), step.nodal.size(),
                   step.element.size());
  PERIMORPH_ASSERT(n_wrong(step.nodal, n_nodes) == 0 && n_wrong(step.element, n_elements) == 0,
                   "a variable has not {} nodal or {} element values", n_nodes, n_elements);

  ++n_steps_;
  check(ex_put_time(exodus_id_, n_steps_, &step.time), "time");
  if (!step.globals.empty()) {
    const auto n = static_cast<int64_t>(step.globals.size());
    check(ex_put_var(exodus_id_, n_steps_, EX_GLOBAL, 1, 0, n, step.globals.data()), "global variables");
  }
  for (std::size_t v = 0; v < step.nodal.size() && n_nodes > 0; ++v) {
    const int variable = static_cast<int>(v) + 1;
    check(ex_put_var(exodus_id_, n_steps_, EX_NODAL, variable, 1, static_cast<int64_t>(n_nodes), step.nodal[v].data()),
          "nodal variables");
  }
  for (std::size_t v = 0; v < step.element.size(); ++v) {
    const double* values = step.element[v].data();
    for (std::size_t b = 0; b < block_sizes_.size(); ++b) {
      if (block_sizes_[b] == 0) continue;
      const int variable = static_cast<int>(v) + 1;
      check(ex_put_var(exodus_id_, n_steps_, EX_ELEM_BLOCK, variable, block_ids_[b], block_sizes_[b], values),
            "element variables");
      values += block_sizes_[b];
    }
  }
  check(ex_update(exodus_id_), "step");
}

template class ExodusSeries<2>;
template class ExodusSeries<3>;

}  // namespace perimorph::io
