#pragma once

#include <exodusII.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace perimorph::tests {

/// Reads an Exodus file by the Exodus library's own functions; sizes come from the file, never from the writer.
class ExodusFile {
 public:
  explicit ExodusFile(const std::string& file) {
    int our_word_size = sizeof(double), file_word_size = 0;
    float version = 0.;
    id_ = ex_open(file.c_str(), EX_READ, &our_word_size, &file_word_size, &version);
    EXPECT_GE(id_, 0) << file;
    ex_set_max_name_length(id_, longest_name);
    EXPECT_EQ(ex_get_init_ext(id_, &sizes), 0);
  }
  ~ExodusFile() { ex_close(id_); }
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;

  std::vector<std::vector<double>> coordinates() const {
    std::vector<std::vector<double>> axes(3, std::vector<double>(sizes.num_nodes));
    EXPECT_EQ(ex_get_coord(id_, axes[0].data(), axes[1].data(), axes[2].data()), 0);
    axes.resize(sizes.num_dim);
    return axes;
  }

  std::vector<std::string> names(ex_entity_type kind) const { return read_names(count(kind), kind, ex_get_names); }

  std::vector<std::string> variables(ex_entity_type kind) const {
    int n = 0;
    ex_get_variable_param(id_, kind, &n);
    return read_names(n, kind,
                      [n](int id, ex_entity_type of, char** names) { return ex_get_variable_names(id, of, n, names); });
  }

  std::string topology(int block) const {
    ex_block info{};
    info.id = block;
    info.type = EX_ELEM_BLOCK;
    EXPECT_EQ(ex_get_block_param(id_, &info), 0);
    return info.topology;
  }

  std::vector<int> connectivity(int block) const {
    ex_block info{};
    info.id = block;
    info.type = EX_ELEM_BLOCK;
    EXPECT_EQ(ex_get_block_param(id_, &info), 0);
    std::vector<int> corners(info.num_entry * info.num_nodes_per_entry);
    EXPECT_EQ(ex_get_conn(id_, EX_ELEM_BLOCK, block, corners.data(), nullptr, nullptr), 0);
    return corners;
  }

  std::vector<int> element_ids() const {
    std::vector<int> ids(sizes.num_elem);
    EXPECT_EQ(ex_get_id_map(id_, EX_ELEM_MAP, ids.data()), 0);
    return ids;
  }

  std::vector<int> node_ids() const {
    std::vector<int> ids(sizes.num_nodes);
    EXPECT_EQ(ex_get_id_map(id_, EX_NODE_MAP, ids.data()), 0);
    return ids;
  }

  /// Entries and extras (sides of a side set) of the set.
  std::pair<std::vector<int>, std::vector<int>> set(ex_entity_type kind, int number) const {
    int n = 0, n_factors = 0;
    EXPECT_EQ(ex_get_set_param(id_, kind, number, &n, &n_factors), 0);
    std::vector<int> entries(n), extras(kind == EX_SIDE_SET ? n : 0);
    if (n > 0) {
      EXPECT_EQ(ex_get_set(id_, kind, number, entries.data(), extras.empty() ? nullptr : extras.data()), 0);
    }
    return {entries, extras};
  }

  std::vector<double> times() const {
    std::vector<double> result(ex_inquire_int(id_, EX_INQ_TIME));
    EXPECT_EQ(ex_get_all_times(id_, result.data()), 0);
    return result;
  }

  /// Values of a variable (from 1) at a step (from 1).
  std::vector<double> values(int step, ex_entity_type kind, int variable, int object, int n) const {
    std::vector<double> result(n);
    EXPECT_EQ(ex_get_var(id_, step, kind, variable, object, n, result.data()), 0);
    return result;
  }

  std::vector<int> truth_table() const {
    int n_variables = 0;
    ex_get_variable_param(id_, EX_ELEM_BLOCK, &n_variables);
    std::vector<int> table(sizes.num_elem_blk * n_variables);
    EXPECT_EQ(ex_get_truth_table(id_, EX_ELEM_BLOCK, static_cast<int>(sizes.num_elem_blk), n_variables, table.data()),
              0);
    return table;
  }

  std::vector<std::string> information() const {
    const auto get = [](int id, ex_entity_type, char** lines) { return ex_get_info(id, lines); };
    return read_names(ex_inquire_int(id_, EX_INQ_INFO), EX_GLOBAL, get);
  }

  std::string program() const {
    char fields[4][MAX_STR_LENGTH + 1];
    char* record[1][4] = {{fields[0], fields[1], fields[2], fields[3]}};
    EXPECT_EQ(ex_inquire_int(id_, EX_INQ_QA), 1);
    EXPECT_EQ(ex_get_qa(id_, record), 0);
    return fields[0];
  }

  ex_init_params sizes{};

 private:
  static constexpr int longest_name = 255;

  int64_t count(ex_entity_type kind) const {
    if (kind == EX_ELEM_BLOCK) return sizes.num_elem_blk;
    return kind == EX_NODE_SET ? sizes.num_node_sets : sizes.num_side_sets;
  }

  template <class Get>
  std::vector<std::string> read_names(int64_t n, ex_entity_type kind, Get get) const {
    std::vector<std::string> buffers(n, std::string(longest_name + 1, '\0'));
    std::vector<char*> raw;
    for (auto& buffer : buffers) raw.push_back(buffer.data());
    EXPECT_EQ(get(id_, kind, raw.data()), 0);
    for (auto& buffer : buffers) buffer.resize(buffer.find('\0'));
    return buffers;
  }

  int id_ = -1;
};

}  // namespace perimorph::tests
