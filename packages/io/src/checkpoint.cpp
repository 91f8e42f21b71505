#include "perimorph/io/checkpoint.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "checksum.hpp"
#include "perimorph/base/errors.hpp"
#include "perimorph/io/disk.hpp"

namespace perimorph::io {

namespace {

constexpr std::size_t n_kept = 2;
constexpr const char* unfinished = ".part";

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

/// HDF5 works in memory only, on the image of a file: it has trouble with disks that fill up.
Handle in_memory() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // we report what goes wrong
  return {H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
}

void put(hid_t file, const std::string& name, hid_t type, std::size_t size, const void* values) {
  const hsize_t length = size;
  const Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
  const Handle data(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (size > 0) require(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
}

template <class Values>
Values get(hid_t data, hid_t type) {
  const Handle space(H5Dget_space(data), H5Sclose);
  const hssize_t size = H5Sget_simple_extent_npoints(space);
  require(size >= 0);
  Values values(static_cast<std::size_t>(size), {});
  if (size > 0) require(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  return values;
}

std::string image_of(const Checkpoint& checkpoint) {
  constexpr std::size_t growth = 1 << 20;  // of the image, bytes
  const Handle access = in_memory();
  require(H5Pset_fapl_core(access, growth, false) >= 0);
  const Handle file(H5Fcreate("image", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  for (const auto& [name, values] : checkpoint.numbers) {
    put(file, name, H5T_NATIVE_DOUBLE, values.size(), values.data());
  }
  for (const auto& [name, values] : checkpoint.integers) {
    put(file, name, H5T_NATIVE_LLONG, values.size(), values.data());
  }
  for (const auto& [name, text] : checkpoint.texts) put(file, name, H5T_NATIVE_CHAR, text.size(), text.data());
  require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0);
  const auto size = H5Fget_file_image(file, nullptr, 0);
  require(size > 0);
  std::string image(static_cast<std::size_t>(size), '\0');
  require(H5Fget_file_image(file, image.data(), image.size()) == size);
  return image;
}

Checkpoint checkpoint_in(std::string image) {
  const Handle access = in_memory();
  require(H5Pset_fapl_core(access, image.size(), false) >= 0);
  require(H5Pset_file_image(access, image.data(), image.size()) >= 0);
  const Handle file(H5Fopen("image", H5F_ACC_RDONLY, access), H5Fclose);
  H5G_info_t group;
  require(H5Gget_info(file, &group) >= 0);
  Checkpoint checkpoint;
  for (hsize_t i = 0; i < group.nlinks; ++i) {
    char name[256];
    require(H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT) > 0);
    const Handle data(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(data), H5Tclose);
    if (H5Tget_class(type) == H5T_FLOAT) {
      checkpoint.numbers[name] = get<std::vector<double>>(data, H5T_NATIVE_DOUBLE);
    } else if (H5Tget_size(type) == 1) {
      checkpoint.texts[name] = get<std::string>(data, H5T_NATIVE_CHAR);
    } else {
      checkpoint.integers[name] = get<std::vector<base::GlobalId>>(data, H5T_NATIVE_LLONG);
    }
  }
  return checkpoint;
}

/// The checksum stands behind the image, where HDF5 does not look: it is of all bytes, HDF5's own structures among
/// them.
std::string with_checksum(std::string image) {
  const Checksum checksum = checksum_of(image);
  return image.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
}

/// The image that a file's bytes hold, if they are those that were written.
std::string checked_image(std::string bytes) {
  require(bytes.size() > sizeof(Checksum));
  const std::size_t size = bytes.size() - sizeof(Checksum);
  Checksum there = 0;
  std::memcpy(&there, bytes.data() + size, sizeof there);
  require(there == checksum_of({bytes.data(), size}));
  bytes.resize(size);
  return bytes;
}

/// Writes the bytes and waits until the disk has them; returns what went wrong, or 0.
int write_to_disk(const std::string& file, const std::string& bytes) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (descriptor < 0) return errno;
  int error = 0;
  for (std::size_t done = 0; done < bytes.size() && error == 0;) {
    const auto n = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR) error = errno;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  if (error == 0 && fsync(descriptor) != 0) error = errno;
  if (close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

std::vector<CheckpointId> CheckpointFolder::list() const {
  std::vector<CheckpointId> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename();
    CheckpointId id;
    const int n_numbers = std::sscanf(name.c_str(), "checkpoint-%d_%d", &id.increment, &id.solves);
    if (n_numbers >= 1 && name == std::filesystem::path(file(id)).filename()) found.push_back(id);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string CheckpointFolder::file(CheckpointId id) const {
  std::string name = fmt::format("checkpoint-{:06d}", id.increment);
  if (id.solves > 0) name += fmt::format("_{:06d}", id.solves);
  return (std::filesystem::path(folder_) / (name + ".h5")).string();
}

void CheckpointFolder::write(CheckpointId id, const Checkpoint& checkpoint) const {
  const std::string name = file(id), beside = name + unfinished;
  int error = write_to_disk(beside, with_checksum(image_of(checkpoint)));
  if (error == 0 && std::rename(beside.c_str(), name.c_str()) != 0) error = errno;
  if (error != 0) {
    std::remove(beside.c_str());
    throw base::ComputationError(fmt::format("{}: the checkpoint cannot be written: {}", name, std::strerror(error)));
  }
  bring_to_disk(folder_);
  const auto all = list();
  for (std::size_t i = 0; i + n_kept < all.size(); ++i) std::remove(file(all[i]).c_str());
}

Checkpoint CheckpointFolder::read(CheckpointId id) const {
  std::ifstream stream(file(id), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  try {
    return checkpoint_in(checked_image(std::move(bytes)));
  } catch (const base::Bug&) {
    throw base::UserError(fmt::format("{}: the checkpoint cannot be read, or is damaged", file(id)));
  }
}

void CheckpointFolder::remove_after(CheckpointId id) const {
  for (const auto& other : list()) {  // the newest at last, so that none counts again that had been superseded
    if (id < other) std::remove(file(other).c_str());
  }
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename();
    const bool is_unfinished = name.rfind("checkpoint-", 0) == 0 && entry.path().extension() == unfinished;
    if (is_unfinished) std::filesystem::remove(entry.path(), ignored);
  }
  bring_to_disk(folder_);
}

}  // namespace perimorph::io
