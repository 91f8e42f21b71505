// "The NetCDF Classic Format Specification", with its names: header = magic numrecs dim_list gatt_list var_list.

#include "classic_header.hpp"

#include <cstdint>
#include <iterator>
#include <map>
#include <vector>

#include "mapped_file.hpp"

namespace perimorph::mesh_files {

namespace {

/// The dimensions of the variables that the reader uses; # is the same number in all.
const std::map<std::string, std::vector<std::string>> shapes = {{"connect#", {"num_el_in_blk#", "num_nod_per_el#"}},
                                                                {"elem_ss#", {"num_side_ss#"}},
                                                                {"side_ss#", {"num_side_ss#"}},
                                                                {"node_ns#", {"num_nod_ns#"}},
                                                                {"coord", {"num_dim", "num_nodes"}},
                                                                {"coordx", {"num_nodes"}},
                                                                {"coordy", {"num_nodes"}},
                                                                {"coordz", {"num_nodes"}},
                                                                {"node_num_map", {"num_nodes"}},
                                                                {"elem_num_map", {"num_elem"}},
                                                                {"elem_map", {"num_elem"}},
                                                                {"eb_status", {"num_el_blk"}},
                                                                {"ns_status", {"num_node_sets"}},
                                                                {"ss_status", {"num_side_sets"}},
                                                                {"eb_prop1", {"num_el_blk"}},
                                                                {"ns_prop1", {"num_node_sets"}},
                                                                {"ss_prop1", {"num_side_sets"}}};

/// The largest lengths of the attributes that the library reads into buffers of fixed size.
const std::map<std::string, std::uint64_t> longest_attributes = {
    {"elem_type", 33},          {"title", 81},
    {"api_version", 1},         {"version", 1},
    {"file_size", 1},           {"floating_point_word_size", 1},
    {"maximum_name_length", 1}, {"int64_status", 1}};

/// The digits at the end of a name: "12" of "connect12".
std::string number_at_end(const std::string& name) { return name.substr(name.find_last_not_of("0123456789") + 1); }

class Header {
 public:
  explicit Header(std::string_view bytes)
      : bytes_(bytes),
        count_size_(bytes_[3] == 5 ? 8 : 4),
        offset_size_(bytes_[3] == 1 ? 4 : 8),
        position_(4 + count_size_) {}  // magic, numrecs

  bool is_valid() {
    list([this] {
      const std::string name = text();
      dimensions_.push_back({name, count()});
    });
    attributes();
    list([this] { variable(); });
    return fits_;
  }

 private:
  std::uint64_t remaining() const { return bytes_.size() - position_; }

  void skip(std::uint64_t n) {
    fits_ = fits_ && n <= remaining();
    if (fits_) position_ += n;
  }

  std::uint64_t number(std::size_t size) {
    std::uint64_t value = 0;
    const std::size_t begin = position_;
    skip(size);
    for (std::size_t i = 0; fits_ && i < size; ++i) value = value << 8U | static_cast<unsigned char>(bytes_[begin + i]);
    return value;
  }
  std::uint64_t count() { return number(count_size_); }

  void array(std::uint64_t n, std::uint64_t size) {
    fits_ = fits_ && n <= remaining() / size;
    if (fits_) skip((n * size + 3) / 4 * 4);
  }

  std::string text() {
    const std::uint64_t length = count();
    const std::size_t begin = position_;
    array(length, 1);
    return fits_ ? std::string(bytes_.substr(begin, length)) : "";
  }

  void variable() {
    const std::string name = text();
    std::vector<std::string> found;
    std::uint64_t n = count();
    fits_ = fits_ && n <= remaining() / count_size_;
    for (; fits_ && n > 0; --n) {
      const std::uint64_t dimension = count();
      // Length 0 marks the time steps, which come first: anywhere else the library would divide by it.
      fits_ = fits_ && dimension < dimensions_.size() && (found.empty() || dimensions_[dimension].length > 0);
      if (fits_) found.push_back(dimensions_[dimension].name);
    }
    fits_ = fits_ && has_its_shape(name, found);
    attributes();
    type_size(number(4));
    skip(count_size_ + offset_size_);
  }

  static bool has_its_shape(const std::string& name, std::vector<std::string> found) {
    const auto exact = shapes.find(name);
    if (exact != shapes.end()) return found == exact->second;
    const std::string number = number_at_end(name);
    const auto numbered = shapes.find(name.substr(0, name.size() - number.size()) + "#");
    if (number.empty() || numbered == shapes.end()) return true;
    for (std::string& dimension : found) {
      const std::string end = number_at_end(dimension);
      if (end != number) return false;
      dimension.replace(dimension.size() - end.size(), end.size(), "#");
    }
    return found == numbered->second;
  }

  void attributes() {
    list([this] {
      const auto longest = longest_attributes.find(text());
      const std::uint64_t type = number(4), length = count();
      fits_ = fits_ && (longest == longest_attributes.end() || length <= longest->second);
      array(length, type_size(type));
    });
  }

  template <class Item>
  void list(Item item) {
    number(4);  // tag
    std::uint64_t n = count();
    fits_ = fits_ && n <= remaining() / 8;  // the smallest item
    for (; fits_ && n > 0; --n) item();
  }

  std::uint64_t type_size(std::uint64_t type) {
    static constexpr std::uint64_t sizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // none, byte, char, short, int, ...
    fits_ = fits_ && type > 0 && type < std::size(sizes);
    return fits_ ? sizes[type] : 1;
  }

  std::string_view bytes_;
  std::size_t count_size_, offset_size_;
  std::size_t position_;
  bool fits_ = true;
  struct Dimension {
    std::string name;
    std::uint64_t length;
  };
  std::vector<Dimension> dimensions_;
};

}  // namespace

bool is_valid_header(const std::string& file) {
  const MappedFile mapped(file);
  return mapped.bytes().size() >= 16 && Header(mapped.bytes()).is_valid();
}

}  // namespace perimorph::mesh_files
