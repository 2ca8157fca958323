#pragma once

// Private to io: the part of HDF5's C library that sample files need (The HDF Group, HDF5 1.10 reference manual).

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace palp {

/// Type of the numbers of a dataset, in the file and in memory.
enum class Hdf5Number { Double, Int32 };

/// Size of a number [bytes].
inline std::size_t width(Hdf5Number number) {
  return number == Hdf5Number::Double ? sizeof(double) : sizeof(std::int32_t);
}

using Hdf5Value = std::variant<std::string, std::uint64_t, double>;

/// Where a chunk lies in the file.
struct Hdf5Place {
  std::uint64_t offset = 0, bytes = 0;
};

/// What a dataset is made of. Rows are along its first dimension.
struct Hdf5Layout {
  std::vector<std::uint64_t> shape;
  std::uint64_t chunkRows = 0; ///< 0: not in chunks of complete rows
  /// Whether its chunks are of this number and pass through the filters shuffle and deflate, in this order, alone.
  bool shuffledDeflate = false;
  /// Of those, one after the other. Empty: to find them all would take the library long.
  std::vector<Hdf5Place> chunks;
};

/// One HDF5 file that is written, or read. Debian's library is of one thread: every call waits for those of other
/// threads. Every member throws Error with the file's name. A damaged file may end the process that reads it, or hold
/// it up for ever: only palp-hdf5 reads by it (io/samples/Hdf5Child.h).
class Hdf5File {
public:
  enum class Open { ForReading, ForWriting };

  /// For writing: makes the file, or empties it.
  Hdf5File(std::filesystem::path path, Open how);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Writes what is still in memory. Without it nothing shows whether the file is complete.
  void close();

  /// Of the file where `dataset` is empty.
  void setAttribute(const std::string& dataset, const std::string& key, const Hdf5Value& value);
  /// The file's own ones as text, numbers as shortest text. Those that are neither texts nor numbers are refused.
  [[nodiscard]] std::map<std::string, std::string> attributes() const;

  /// In chunks of `chunkRows` complete rows, shuffled and deflated.
  void addDataset(const std::string& name, Hdf5Number number, const std::vector<std::uint64_t>& shape,
                  std::uint64_t chunkRows);
  void addTexts(const std::string& name, const std::vector<std::string>& texts);
  /// A chunk as it is stored (io/samples/ShuffledDeflate.h); `row` is its first one.
  void writeChunk(const std::string& name, std::uint64_t row, std::span<const unsigned char> packed);

  /// Data sets of numbers in all groups, by their paths, and their shapes.
  [[nodiscard]] std::map<std::string, std::vector<std::uint64_t>> shapes() const;
  [[nodiscard]] std::vector<std::uint64_t> shape(const std::string& name) const;
  /// Refuses a dataset of no numbers, and one of which not every chunk is there.
  [[nodiscard]] Hdf5Layout layout(const std::string& name, Hdf5Number number) const;
  /// By the library's own way: any layout, filter and type of number.
  void readRows(const std::string& name, std::uint64_t row, std::uint64_t count, double* values) const;
  void readRows(const std::string& name, std::uint64_t row, std::uint64_t count, std::int32_t* values) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;

  [[noreturn]] void refuse(const std::string& sentence) const;

private:
  [[nodiscard]] std::int64_t dataset(const std::string& name) const;
  [[nodiscard]] std::vector<Hdf5Place> placesOfChunks(std::int64_t dataset, const Hdf5Layout& layout,
                                                      std::uint64_t count) const;
  void read(const std::string& name, std::uint64_t row, std::uint64_t count, std::int64_t memoryType,
            void* values) const;

  std::filesystem::path path_;
  std::int64_t file_ = -1;
  mutable std::map<std::string, std::int64_t> datasets_; ///< open ones
};

} // namespace palp
