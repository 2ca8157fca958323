#include "io/samples/MatFile.h"

#include "model/base/Error.h"

#include <matio.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>

namespace palp {

namespace {

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

mat_t* matOf(void* file) {
  return static_cast<mat_t*>(file);
}

bool isNumeric(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64 && variable.isComplex == 0 &&
         variable.rank >= 2 && variable.dims != nullptr;
}

/// A row vector counts as a column.
std::vector<std::uint64_t> asRows(std::vector<std::uint64_t> shape) {
  if (shape.size() == 2 && shape[0] == 1) return {shape[1]};
  while (shape.size() > 1 && shape.back() == 1) shape.pop_back();
  return shape;
}

std::vector<std::uint64_t> shapeOf(const matvar_t& variable) {
  return asRows({variable.dims, variable.dims + variable.rank});
}

/// Version 7.3 begins with a block of 512 bytes and continues as HDF5.
bool isHdf5(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(512);
  char begin[4] = {};
  stream.read(begin, sizeof begin);
  return std::memcmp(begin, "\x89HDF", 4) == 0;
}

template <class Number> void copyNumbers(const matvar_t& variable, std::vector<double>& to) {
  const auto* from = static_cast<const Number*>(variable.data);
  std::transform(from, from + to.size(), to.begin(), [](Number value) { return static_cast<double>(value); });
}

/// By the type in memory, which may be narrower than the class.
bool copyAll(const matvar_t& variable, std::vector<double>& to) {
  if (variable.data == nullptr || variable.nbytes < to.size() * static_cast<std::size_t>(variable.data_size))
    return false;
  switch (variable.data_type) {
  case MAT_T_DOUBLE:
    copyNumbers<double>(variable, to);
    return true;
  case MAT_T_SINGLE:
    copyNumbers<float>(variable, to);
    return true;
  case MAT_T_INT8:
    copyNumbers<std::int8_t>(variable, to);
    return true;
  case MAT_T_UINT8:
    copyNumbers<std::uint8_t>(variable, to);
    return true;
  case MAT_T_INT16:
    copyNumbers<std::int16_t>(variable, to);
    return true;
  case MAT_T_UINT16:
    copyNumbers<std::uint16_t>(variable, to);
    return true;
  case MAT_T_INT32:
    copyNumbers<std::int32_t>(variable, to);
    return true;
  case MAT_T_UINT32:
    copyNumbers<std::uint32_t>(variable, to);
    return true;
  case MAT_T_INT64:
    copyNumbers<std::int64_t>(variable, to);
    return true;
  case MAT_T_UINT64:
    copyNumbers<std::uint64_t>(variable, to);
    return true;
  default:
    return false;
  }
}

/// Calls `each` with the name and variable of each array, those in fields of single structures too.
template <class Each> void visit(matvar_t& variable, const std::string& name, const Each& each) {
  if (isNumeric(variable)) each(name, variable);
  if (variable.class_type != MAT_C_STRUCT || variable.rank != 2 || variable.dims[0] * variable.dims[1] != 1) return;
  char* const* const fields = Mat_VarGetStructFieldnames(&variable);
  const unsigned count = Mat_VarGetNumberOfFields(&variable);
  for (unsigned i = 0; i < count; ++i)
    if (matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0); field != nullptr && fields != nullptr)
      visit(*field, name + "." + fields[i], each);
}

} // namespace

bool MatFile::isOne(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  char begin[8] = {};
  stream.read(begin, sizeof begin);
  return std::memcmp(begin, "MATLAB ", 7) == 0;
}

MatFile::MatFile(std::filesystem::path path) : path_(std::move(path)) {
  if (isHdf5(path_)) {
    hdf5_.emplace(path_, Hdf5File::Open::ForReading);
    for (auto [name, shape] : hdf5_->shapes()) { // MATLAB's first index is HDF5's last
      std::reverse(shape.begin(), shape.end());
      if (!name.starts_with("#") && !shape.empty()) shapes_[name] = asRows(std::move(shape));
    }
    return;
  }
  Mat_LogInitFunc("palp", [](int, auto*) {}); // what is wrong is reported here
  file_ = Mat_Open(path_.c_str(), MAT_ACC_RDONLY);
  if (file_ == nullptr) refuse("is damaged or cut off: not a complete MAT file");
  while (const Variable variable{Mat_VarReadNextInfo(matOf(file_))})
    if (variable->name != nullptr)
      visit(*variable, variable->name,
            [this](const std::string& name, const matvar_t& array) { shapes_[name] = shapeOf(array); });
}

MatFile::~MatFile() {
  if (file_ != nullptr) Mat_Close(matOf(file_));
}

void MatFile::refuse(const std::string& sentence) const {
  throw Error(path_.string() + ": " + sentence);
}

void MatFile::load(const std::string& name) {
  const auto shape = shapes_.find(name);
  if (shape == shapes_.end()) refuse("has no array " + name);
  std::uint64_t count = 1;
  for (const std::uint64_t size : shape->second) count *= size;
  loaded_.clear();
  values_.resize(count);
  if (hdf5_) {
    const std::vector<std::uint64_t> stored = hdf5_->shape(name);
    hdf5_->readRows(name, 0, stored[0], values_.data());
  } else if (!loadVersion5(name)) {
    refuse("array " + name + " cannot be read; the file is damaged");
  }
  loaded_ = name;
}

bool MatFile::loadVersion5(const std::string& name) {
  Mat_Rewind(matOf(file_));
  const Variable variable{Mat_VarRead(matOf(file_), name.substr(0, name.find('.')).c_str())};
  if (!variable) return false;
  bool copied = false;
  visit(*variable, variable->name, [&](const std::string& found, const matvar_t& array) {
    if (found != name || shapeOf(array) != shapes_.at(name)) return;
    copied = copyAll(array, values_);
  });
  return copied;
}

void MatFile::readRows(const std::string& name, std::uint64_t row, std::uint64_t count, std::span<double> values) {
  if (loaded_ != name) load(name);
  const std::vector<std::uint64_t>& shape = shapes_.at(name);
  const std::uint64_t rows = shape[0], width = rows == 0 ? 0 : values_.size() / rows;
  if (row > rows || count > rows - row || count * width != values.size()) refuse("array " + name + " has fewer rows");
  // MATLAB's first index is the fastest; of a row, the last index is to be.
  for (std::uint64_t item = 0; item < width; ++item) {
    std::uint64_t rest = item, column = 0, step = 1, sizes = width;
    for (std::size_t d = 1; d < shape.size(); ++d) { // the slowest first
      sizes /= shape[d];
      column += rest / sizes * step;
      rest %= sizes;
      step *= shape[d];
    }
    for (std::uint64_t i = 0; i < count; ++i) values[i * width + item] = values_[column * rows + row + i];
  }
}

} // namespace palp
