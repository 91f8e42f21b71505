#include "hdf5_layout.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdlib>

#include "perimorph/base/errors.hpp"

namespace perimorph::io {

using base::GlobalId;

namespace {

/// An HDF5 identifier that is closed when it goes.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw base::Bug("HDF5 refused a call");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(bool succeeded) {
  if (!succeeded) throw base::Bug("HDF5 failed");
}

Handle new_access() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // we report what goes wrong
  return {H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
}

/// The memory in which HDF5 makes a file: only as far as it writes, which is not where values will stand. It is still
/// there when the file has been closed.
class Image {
 public:
  Image() = default;
  ~Image() { std::free(bytes_); }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  H5FD_file_image_callbacks_t callbacks() {
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.image_realloc = [](void*, size_t size, H5FD_file_image_op_t, void* image) {
      return static_cast<Image*>(image)->resize(size);
    };
    callbacks.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
    callbacks.udata_copy = [](void* image) { return image; };
    callbacks.udata_free = [](void*) -> herr_t { return 0; };
    callbacks.udata = this;
    return callbacks;
  }

  /// From one place in the file to another. What HDF5 has never written is zero.
  std::string between(GlobalId from, GlobalId to) const {
    std::string content(static_cast<std::size_t>(to - from), '\0');
    const auto end = std::min(to, static_cast<GlobalId>(size_));
    if (end > from) std::copy(bytes_ + from, bytes_ + end, content.begin());
    return content;
  }

 private:
  char* bytes_ = nullptr;
  std::size_t size_ = 0;

  void* resize(std::size_t size) {
    auto* larger = static_cast<char*>(std::realloc(bytes_, size));
    if (larger == nullptr) return nullptr;
    bytes_ = larger;
    size_ = size;
    return larger;
  }
};

hid_t type_of(DataSet::Kind kind) {
  if (kind == DataSet::Kind::numbers) return H5T_NATIVE_DOUBLE;
  return kind == DataSet::Kind::integers ? H5T_NATIVE_LLONG : H5T_NATIVE_CHAR;
}

/// Values have their place at once, but are not written.
void place_without_writing(hid_t creation) {
  require(H5Pset_layout(creation, H5D_CONTIGUOUS) >= 0);
  require(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY) >= 0);
  require(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER) >= 0);
  require(H5Pset_obj_track_times(creation, false) >= 0);
}

GlobalId offset_of(hid_t data, GlobalId bytes) {
  if (bytes == 0) return 0;  // it has no place
  const haddr_t offset = H5Dget_offset(data);
  require(offset != HADDR_UNDEF);
  return static_cast<GlobalId>(offset);
}

void create(hid_t file, hid_t creation, DataSet& set) {
  const hsize_t sizes[2] = {static_cast<hsize_t>(set.n_rows), static_cast<hsize_t>(set.width)};
  const Handle space(H5Screate_simple(set.is_in_rows ? 2 : 1, sizes, nullptr), H5Sclose);
  const Handle data(H5Dcreate2(file, set.name.c_str(), type_of(set.kind), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                    H5Dclose);
  set.offset = offset_of(data, set.bytes());
}

/// HDF5 makes the file in memory; the image keeps what it has written. Returns the size.
GlobalId create_in(Image& image, std::vector<DataSet>& sets) {
  constexpr std::size_t growth = 4096, bytes_of_group = 2048, bytes_of_set = 512;  // more than HDF5 needs
  const Handle access = new_access();
  require(H5Pset_fapl_core(access, growth, false) >= 0);
  auto callbacks = image.callbacks();
  require(H5Pset_file_image_callbacks(access, &callbacks) >= 0);
  // All of the structure comes before all values: the image ends where values begin.
  require(H5Pset_meta_block_size(access, bytes_of_group + bytes_of_set * sets.size()) >= 0);
  const Handle file(H5Fcreate("image", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  place_without_writing(creation);
  for (auto& set : sets) create(file, creation, set);
  hsize_t size = 0;
  require(H5Fget_filesize(file, &size) >= 0);
  return static_cast<GlobalId>(size);
}

/// The data set that is opened, if it is one that lay_out() makes.
DataSet describe(hid_t data, const char* name) {
  const Handle type(H5Dget_type(data), H5Tclose), space(H5Dget_space(data), H5Sclose);
  DataSet set;
  set.name = name;
  for (const auto kind : {DataSet::Kind::numbers, DataSet::Kind::integers, DataSet::Kind::text}) {
    if (H5Tequal(type, type_of(kind)) > 0) set.kind = kind;
  }
  require(H5Tequal(type, type_of(set.kind)) > 0);
  const int n_dimensions = H5Sget_simple_extent_ndims(space);
  require(n_dimensions == 1 || n_dimensions == 2);
  hsize_t sizes[2] = {0, 1};
  require(H5Sget_simple_extent_dims(space, sizes, nullptr) == n_dimensions);
  set.is_in_rows = n_dimensions == 2;
  set.n_rows = static_cast<GlobalId>(sizes[0]);
  set.width = static_cast<GlobalId>(sizes[1]);
  set.offset = offset_of(data, set.bytes());
  return set;
}

}  // namespace

Structure lay_out(std::vector<DataSet> sets) {
  Image image;
  Structure structure;
  structure.size = create_in(image, sets);
  auto by_place = sets;
  std::sort(by_place.begin(), by_place.end(), [](const DataSet& a, const DataSet& b) { return a.offset < b.offset; });
  GlobalId end = 0;
  for (const auto& set : by_place) {
    if (set.bytes() == 0) continue;
    PERIMORPH_ASSERT(set.offset >= end, "{} begins at byte {}, what comes before ends at {}", set.name, set.offset,
                     end);
    if (set.offset > end) structure.stretches.push_back({end, image.between(end, set.offset)});
    end = set.offset + set.bytes();
  }
  if (structure.size > end) structure.stretches.push_back({end, image.between(end, structure.size)});
  structure.sets = std::move(sets);
  return structure;
}

std::vector<DataSet> data_sets_of(const std::string& name) {
  const Handle access = new_access();
#if H5_VERSION_GE(1, 12, 1) || (H5_VERSION_GE(1, 10, 7) && !H5_VERSION_GE(1, 12, 0))
  require(H5Pset_file_locking(access, false, true) >= 0);  // not every disk has locks, and nobody writes it
#endif
  const Handle file(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  H5G_info_t group;
  require(H5Gget_info(file, &group) >= 0);
  std::vector<DataSet> sets;
  for (hsize_t i = 0; i < group.nlinks; ++i) {
    char link[256];
    require(H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, i, link, sizeof link, H5P_DEFAULT) > 0);
    const Handle data(H5Dopen2(file, link, H5P_DEFAULT), H5Dclose);
    sets.push_back(describe(data, link));
  }
  return sets;
}

}  // namespace perimorph::io
