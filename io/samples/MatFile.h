#pragma once

// Private to palp-hdf5: MAT files of MATLAB: version 5 by libmatio, version 7.3 as the HDF5 files that they are.

#include "io/samples/Hdf5.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp {

/// A MAT file that is read. Every member throws Error with the file's name.
class MatFile {
public:
  /// Whether the file's first bytes are those of a MAT file of version 5 or 7.3.
  static bool isOne(const std::filesystem::path& path);

  explicit MatFile(std::filesystem::path path);
  ~MatFile();
  MatFile(const MatFile&) = delete;
  MatFile& operator=(const MatFile&) = delete;

  /// Real arrays of numbers and their shapes, those in structures as "structure.field"; a row vector (1 x n) counts as
  /// a column of n rows.
  [[nodiscard]] const std::map<std::string, std::vector<std::uint64_t>>& shapes() const { return shapes_; }
  /// Rows of an array along its first dimension, the last index fastest.
  void readRows(const std::string& name, std::uint64_t row, std::uint64_t count, std::span<double> values);

private:
  void load(const std::string& name);
  [[nodiscard]] bool loadVersion5(const std::string& name);
  [[noreturn]] void refuse(const std::string& sentence) const;

  std::filesystem::path path_;
  void* file_ = nullptr;         ///< version 5
  std::optional<Hdf5File> hdf5_; ///< version 7.3
  std::map<std::string, std::vector<std::uint64_t>> shapes_;
  std::string loaded_;         ///< the array that is in memory
  std::vector<double> values_; ///< of it, the first index fastest
};

} // namespace palp
