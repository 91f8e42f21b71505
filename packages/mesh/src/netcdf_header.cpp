// "The NetCDF Classic Format Specification", with its names: header = magic numrecs dim_list gatt_list var_list.

#include "netcdf_header.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>

namespace perimorph::mesh {

namespace {

class Header {
 public:
  explicit Header(std::string bytes)
      : bytes_(std::move(bytes)),
        count_size_(bytes_[3] == 5 ? 8 : 4),
        offset_size_(bytes_[3] == 1 ? 4 : 8),
        position_(4 + count_size_) {}  // magic, numrecs

  bool fits() {
    list([this] {  // dimensions
      text();
      skip(count_size_);
    });
    attributes();
    list([this] {  // variables
      text();
      array(count(), count_size_);
      attributes();
      skip(4 + count_size_ + offset_size_);
    });
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

  void text() { array(count(), 1); }

  void attributes() {
    list([this] {
      text();
      const std::uint64_t type = number(4);
      array(count(), type_size(type));
    });
  }

  template <class Item>
  void list(Item item) {
    number(4);  // tag
    std::uint64_t n = count();
    fits_ = fits_ && n <= remaining() / 8;  // the smallest item
    for (; fits_ && n > 0; --n) item();
  }

  static std::uint64_t type_size(std::uint64_t type) {
    static constexpr std::uint64_t sizes[] = {1, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // byte, char, short, int, ...
    return type < std::size(sizes) ? sizes[type] : 1;
  }

  std::string bytes_;
  std::size_t count_size_, offset_size_;
  std::size_t position_;
  bool fits_ = true;
};

}  // namespace

bool header_fits(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return bytes.size() >= 16 && Header(std::move(bytes)).fits();
}

}  // namespace perimorph::mesh
