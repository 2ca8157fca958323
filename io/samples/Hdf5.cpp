#include "io/samples/Hdf5.h"

#include "io/files/SystemError.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <mutex>

namespace palp {

namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>);

constexpr hsize_t kMostTexts = 1'000'000; ///< names of columns
constexpr std::size_t kLongestText = 4096;
constexpr std::size_t kMostDatasets = 10'000;
// To find a chunk by its number the library counts from the first one: 50 ns each time.
constexpr double kFewChunks = 1000, kBytesASquare = 25; ///< the time in which 500 MB/s would be read

/// Held by every call of the library, which has one state for the complete program.
std::unique_lock<std::mutex> inLibrary() {
  static std::mutex one;
  std::unique_lock lock(one);
  // Closing a file fails on a full disk, and closing it once more at the end of the program crashes (HDF5 1.10).
  [[maybe_unused]] static const herr_t kEndsWithoutClosing = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // it prints its errors else
  return lock;
}

/// Something of the library's that is closed again.
class Handle {
public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; } // NOLINT: used as the id everywhere

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

hid_t fileType(Hdf5Number number) {
  return number == Hdf5Number::Double ? H5T_IEEE_F64LE : H5T_STD_I32LE;
}

/// UTF-8 of `length` bytes; H5T_VARIABLE: of any length, which h5py reads as text.
hid_t textType(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, length);
  if (length != H5T_VARIABLE) H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

std::vector<hsize_t> shapeOf(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(0, rank)));
  if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

bool hasOurFilters(hid_t plan) {
  if (H5Pget_nfilters(plan) != 2) return false;
  constexpr H5Z_filter_t kOurs[] = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE};
  for (unsigned i = 0; i < 2; ++i) {
    unsigned flags = 0, settings = 0;
    std::size_t none = 0;
    if (H5Pget_filter2(plan, i, &flags, &none, nullptr, 0, nullptr, &settings) != kOurs[i]) return false;
  }
  return true;
}

/// The attribute's value as text; empty optional: it is of another kind.
bool readValue(hid_t attribute, std::string& value) {
  const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1) return false;
  const H5T_class_t kind = H5Tget_class(type);
  if (kind == H5T_STRING && H5Tis_variable_str(type) > 0) { // as h5py writes them
    const Handle memory(H5Tcopy(type), H5Tclose);
    char* held = nullptr;
    if (H5Aread(attribute, memory, static_cast<void*>(&held)) < 0 || held == nullptr) return false;
    value = held;
    H5free_memory(held);
    return true;
  }
  if (kind == H5T_STRING) {
    value.assign(H5Tget_size(type), '\0');
    if (value.size() > kLongestText || H5Aread(attribute, type, value.data()) < 0) return false;
    value.resize(std::strlen(value.c_str()));
    return true;
  }
  std::uint64_t whole = 0;
  std::int64_t withSign = 0;
  double real = 0;
  if (kind == H5T_FLOAT && H5Aread(attribute, H5T_NATIVE_DOUBLE, &real) >= 0)
    value = text(real);
  else if (kind == H5T_INTEGER && H5Tget_sign(type) == H5T_SGN_2 &&
           H5Aread(attribute, H5T_NATIVE_INT64, &withSign) >= 0)
    value = std::to_string(withSign);
  else if (kind == H5T_INTEGER && H5Aread(attribute, H5T_NATIVE_UINT64, &whole) >= 0)
    value = std::to_string(whole);
  else
    return false;
  return true;
}

/// As fixed text for all, padded by zeros; refuses nothing.
std::vector<std::string> readTexts(hid_t dataset, hsize_t count) {
  const Handle type(H5Dget_type(dataset), H5Tclose);
  std::vector<std::string> texts;
  if (H5Tget_class(type) != H5T_STRING) return texts;
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> held(count, nullptr);
    const Handle space(H5Dget_space(dataset), H5Sclose);
    if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(held.data())) < 0) return texts;
    for (const char* one : held) texts.emplace_back(one == nullptr ? "" : one);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, static_cast<void*>(held.data()));
    return texts;
  }
  const std::size_t length = H5Tget_size(type);
  if (length > kLongestText) return texts;
  std::vector<char> bytes(count * length);
  if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0) return texts;
  for (hsize_t i = 0; i < count; ++i) {
    const char* first = bytes.data() + i * length;
    texts.emplace_back(first, std::find(first, first + length, '\0'));
  }
  return texts;
}

constexpr const char* kOpenElsewhere =
    "is open for writing in another program, perhaps a notebook; close it there (h5clear "
    "-s FILE where that program was killed)";

/// By the lock that its writer holds, or by the mark in the file's head (version 3 of the superblock; HDF5 file format
/// specification, II.A).
bool isOpenElsewhere(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool locked = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  std::array<unsigned char, 12> head{};
  const bool marked =
      ::pread(file, head.data(), head.size(), 0) == ssize_t(head.size()) && head[8] == 3 && (head[11] & 1) != 0;
  ::close(file);
  return locked || marked;
}

} // namespace

Hdf5File::Hdf5File(std::filesystem::path path, Open how) : path_(std::move(path)) {
  const auto lock = inLibrary();
  errno = 0;
  if (how == Open::ForReading) {
    file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0) refuse(isOpenElsewhere(path_) ? kOpenElsewhere : "is damaged or cut off: not a complete HDF5 file");
    return;
  }
  const Handle plan(H5Pcreate(H5P_FILE_CREATE), H5Pclose), access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_obj_track_times(plan, false);      // the same bytes at any time
  H5Pset_file_locking(access, false, true); // the file is nobody else's, and some file systems have no locks
  file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, plan, access);
  if (file_ < 0) cannotWrite(path_);
}

Hdf5File::~Hdf5File() {
  const auto lock = inLibrary();
  for (const auto& [name, id] : datasets_) H5Dclose(id);
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::close() {
  const auto lock = inLibrary();
  errno = 0;
  bool whole = true;
  for (const auto& [name, id] : datasets_) whole = H5Dclose(id) >= 0 && whole;
  datasets_.clear();
  whole = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0 && whole;
  const std::string reason = systemMessage();
  whole = H5Fclose(file_) >= 0 && whole;
  file_ = -1;
  if (!whole) refuse("cannot be written: " + reason);
}

void Hdf5File::refuse(const std::string& sentence) const {
  throw Error(path_.string() + ": " + sentence);
}

std::int64_t Hdf5File::dataset(const std::string& name) const {
  const auto known = datasets_.find(name);
  if (known != datasets_.end()) return known->second;
  const hid_t id = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
  if (id < 0) refuse("has no dataset " + name);
  datasets_.emplace(name, id);
  return id;
}

void Hdf5File::setAttribute(const std::string& dataset, const std::string& key, const Hdf5Value& value) {
  const auto lock = inLibrary();
  const hid_t owner = dataset.empty() ? file_ : this->dataset(dataset);
  const auto* words = std::get_if<std::string>(&value);
  const auto* whole = std::get_if<std::uint64_t>(&value);
  const Handle type(
      words != nullptr ? textType(H5T_VARIABLE) : H5Tcopy(whole != nullptr ? H5T_STD_U64LE : H5T_IEEE_F64LE), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(owner, key.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* const letters = words != nullptr ? words->c_str() : nullptr;
  const void* bytes = words != nullptr   ? static_cast<const void*>(&letters)
                      : whole != nullptr ? static_cast<const void*>(whole)
                                         : static_cast<const void*>(&std::get<double>(value));
  if (H5Awrite(attribute, type, bytes) < 0) cannotWrite(path_);
}

std::map<std::string, std::string> Hdf5File::attributes() const {
  const auto lock = inLibrary();
  std::vector<std::string> names;
  const H5A_operator2_t add = [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  if (H5Aiterate2(file_, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add, &names) < 0)
    refuse("its attributes cannot be read; the file is damaged");
  std::map<std::string, std::string> values;
  for (const std::string& name : names) {
    const Handle attribute(H5Aopen(file_, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (attribute < 0) refuse("its attributes cannot be read; the file is damaged");
    std::string value;
    if (!readValue(attribute, value)) refuse("attribute " + name + " is neither one text nor one number");
    values.emplace(name, value);
  }
  return values;
}

void Hdf5File::addDataset(const std::string& name, Hdf5Number number, const std::vector<std::uint64_t>& shape,
                          std::uint64_t chunkRows) {
  const auto lock = inLibrary();
  std::vector<hsize_t> sizes(shape.begin(), shape.end()), chunk = sizes;
  chunk[0] = chunkRows;
  std::vector<hsize_t> most = sizes;
  most[0] = H5S_UNLIMITED; // a chunk is not cut to the rows that there are
  const Handle plan(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(plan, false);
  H5Pset_chunk(plan, static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(plan);
  H5Pset_deflate(plan, 1);
  H5Pset_fill_time(plan, H5D_FILL_TIME_NEVER);
  const Handle space(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), most.data()), H5Sclose);
  const hid_t id = H5Dcreate2(file_, name.c_str(), fileType(number), space, H5P_DEFAULT, plan, H5P_DEFAULT);
  if (id < 0) refuse("cannot be written: dataset " + name);
  datasets_.emplace(name, id);
}

void Hdf5File::addTexts(const std::string& name, const std::vector<std::string>& texts) {
  const auto lock = inLibrary();
  std::size_t length = 1;
  for (const std::string& one : texts) length = std::max(length, one.size());
  std::string bytes(length * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(bytes.data() + i * length, length);
  const hsize_t count = texts.size();
  const Handle type(textType(length), H5Tclose), space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle plan(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(plan, false);
  const Handle id(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, plan, H5P_DEFAULT), H5Dclose);
  if (id < 0 || H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    refuse("cannot be written: dataset " + name);
}

void Hdf5File::writeChunk(const std::string& name, std::uint64_t row, std::span<const unsigned char> packed) {
  const auto lock = inLibrary();
  const hid_t id = dataset(name);
  std::vector<hsize_t> place(shapeOf(id).size(), 0);
  place[0] = row;
  errno = 0;
  if (H5Dwrite_chunk(id, H5P_DEFAULT, 0, place.data(), packed.size(), packed.data()) < 0) cannotWrite(path_);
}

std::map<std::string, std::vector<std::uint64_t>> Hdf5File::shapes() const {
  const auto lock = inLibrary();
  std::vector<std::string> names;
  const H5L_iterate_t add = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    auto& all = *static_cast<std::vector<std::string>*>(to);
    all.emplace_back(name);
    return all.size() < kMostDatasets ? 0 : 1;
  };
  if (H5Lvisit(file_, H5_INDEX_NAME, H5_ITER_NATIVE, add, &names) < 0)
    refuse("its groups cannot be read; the file is damaged");
  std::map<std::string, std::vector<std::uint64_t>> shapes;
  for (const std::string& name : names) {
    const hid_t id = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (id < 0) continue; // a group
    const Handle open(id, H5Dclose), type(H5Dget_type(id), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    if (kind != H5T_INTEGER && kind != H5T_FLOAT) continue;
    const std::vector<hsize_t> shape = shapeOf(id);
    shapes[name] = {shape.begin(), shape.end()};
  }
  return shapes;
}

std::vector<std::uint64_t> Hdf5File::shape(const std::string& name) const {
  const auto lock = inLibrary();
  const std::vector<hsize_t> shape = shapeOf(dataset(name));
  return {shape.begin(), shape.end()};
}

Hdf5Layout Hdf5File::layout(const std::string& name, Hdf5Number number) const {
  const auto lock = inLibrary();
  const hid_t id = dataset(name);
  const Handle type(H5Dget_type(id), H5Tclose), plan(H5Dget_create_plist(id), H5Pclose);
  const H5T_class_t kind = H5Tget_class(type);
  const bool whole = number == Hdf5Number::Int32; // the library would cut fractions off
  if (kind != H5T_INTEGER && (whole || kind != H5T_FLOAT))
    refuse("dataset " + name + " does not contain " + (whole ? "whole numbers" : "numbers"));
  const std::vector<hsize_t> shape = shapeOf(id);
  Hdf5Layout found;
  found.shape.assign(shape.begin(), shape.end());
  if (shape.empty()) refuse("dataset " + name + ": " + gotExpected("one number", "a number per sample"));
  if (H5Pget_layout(plan) != H5D_CHUNKED) {
    const hsize_t all = static_cast<hsize_t>(H5Sget_simple_extent_npoints(Handle(H5Dget_space(id), H5Sclose)));
    if (H5Dget_storage_size(id) / H5Tget_size(type) < all) refuse("dataset " + name + " is not written completely");
    return found;
  }
  std::vector<hsize_t> chunk(shape.size());
  H5Pget_chunk(plan, static_cast<int>(chunk.size()), chunk.data());
  hsize_t wanted = 1, there = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) wanted *= (shape[i] + chunk[i] - 1) / chunk[i];
  const Handle space(H5Dget_space(id), H5Sclose);
  if (wanted > 0 && (H5Dget_num_chunks(id, space, &there) < 0 || there != wanted))
    refuse("dataset " + name + " is not written completely: " + std::to_string(there) + " of " +
           std::to_string(wanted) + " chunks");
  if (std::equal(shape.begin() + 1, shape.end(), chunk.begin() + 1)) found.chunkRows = chunk[0];
  found.shuffledDeflate = found.chunkRows > 0 && H5Tequal(type, fileType(number)) > 0 && hasOurFilters(plan);
  if (found.shuffledDeflate) found.chunks = placesOfChunks(id, found, wanted);
  return found;
}

std::vector<Hdf5Place> Hdf5File::placesOfChunks(std::int64_t id, const Hdf5Layout& layout, std::uint64_t count) const {
  const double fileBytes = static_cast<double>(std::filesystem::file_size(path_));
  if (static_cast<double>(count) > std::max(kFewChunks, std::sqrt(fileBytes / kBytesASquare))) return {};
  const Handle space(H5Dget_space(id), H5Sclose);
  std::vector<Hdf5Place> places(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    std::array<hsize_t, H5S_MAX_RANK> first{};
    unsigned filters = 0;
    haddr_t address = 0;
    hsize_t size = 0;
    if (H5Dget_chunk_info(id, space, i, first.data(), &filters, &address, &size) < 0 || filters != 0) return {};
    const std::uint64_t chunk = first[0] / layout.chunkRows;
    if (chunk < count) places[chunk] = {address, size};
  }
  return places;
}

void Hdf5File::readRows(const std::string& name, std::uint64_t row, std::uint64_t count, double* values) const {
  read(name, row, count, H5T_NATIVE_DOUBLE, values);
}

void Hdf5File::readRows(const std::string& name, std::uint64_t row, std::uint64_t count, std::int32_t* values) const {
  read(name, row, count, H5T_NATIVE_INT32, values);
}

void Hdf5File::read(const std::string& name, std::uint64_t row, std::uint64_t count, std::int64_t memoryType,
                    void* values) const {
  const auto lock = inLibrary();
  const hid_t id = dataset(name);
  std::vector<hsize_t> sizes = shapeOf(id), start(sizes.size(), 0);
  start[0] = row;
  sizes[0] = count;
  const Handle file(H5Dget_space(id), H5Sclose);
  const Handle memory(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose);
  if (H5Sselect_hyperslab(file, H5S_SELECT_SET, start.data(), nullptr, sizes.data(), nullptr) < 0 ||
      H5Dread(id, memoryType, memory, file, H5P_DEFAULT, values) < 0)
    refuse("dataset " + name + ", samples from " + std::to_string(row) + " on: cannot be read; the file is damaged");
}

std::vector<std::string> Hdf5File::texts(const std::string& name) const {
  const auto lock = inLibrary();
  const hid_t id = dataset(name);
  const std::vector<hsize_t> shape = shapeOf(id);
  std::vector<std::string> texts;
  if (shape.size() == 1 && shape[0] <= kMostTexts) texts = readTexts(id, shape[0]);
  if (texts.empty()) refuse("dataset " + name + " is not a list of texts");
  return texts;
}

} // namespace palp
