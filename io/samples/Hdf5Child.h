#pragma once

// Private to io: HDF5 files that are read.

#include "io/samples/Hdf5.h"

#include <sys/types.h>

#include <functional>
#include <mutex>
#include <stop_token>

namespace palp {

struct Hdf5Request;

/// One HDF5 file, read by a process of its own: `palp-hdf5`, limited in memory and time. The library crashes on some
/// damaged or crafted files and finds no end of others; all that comes of it here is a refusal. Every answer's size is
/// checked. Members may be called by several threads, and throw Error with the file's name, or Cancelled within 0.05 s
/// of a request to stop.
class Hdf5Child {
public:
  explicit Hdf5Child(std::filesystem::path path, std::stop_token stop = {});
  ~Hdf5Child();
  Hdf5Child(const Hdf5Child&) = delete;
  Hdf5Child& operator=(const Hdf5Child&) = delete;

  // As those of Hdf5File.
  [[nodiscard]] std::map<std::string, std::string> attributes() const;
  /// Arrays of numbers by their paths, and their shapes; of a MAT file its variables.
  [[nodiscard]] const std::map<std::string, std::vector<std::uint64_t>>& datasets() const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;
  [[nodiscard]] Hdf5Layout layout(const std::string& name, Hdf5Number number) const;
  /// A chunk as it is stored, in `room`, which grows where it is too small; nothing where it is not within the file.
  /// Read here, by many threads at a time: what unpacks it is not the library.
  std::span<const unsigned char> readChunk(const Hdf5Place& place, std::vector<unsigned char>& room) const;
  /// How many numbers in all.
  void readRows(const std::string& name, std::uint64_t row, std::uint64_t count, std::span<double> values) const;
  void readRows(const std::string& name, std::uint64_t row, std::uint64_t count, std::span<std::int32_t> values) const;

  [[noreturn]] void refuse(const std::string& sentence) const;
  [[nodiscard]] std::uint64_t fileBytes() const { return fileBytes_; }

private:
  /// `room` returns the memory for an answer of a number of bytes; null: they are too many.
  void ask(const Hdf5Request& request, const std::function<void*(std::uint64_t bytes)>& room) const;
  /// An answer of at most `most` bytes.
  [[nodiscard]] std::string answer(const Hdf5Request& request, std::uint64_t most) const;
  void readNumbers(const std::string& name, std::uint64_t row, std::uint64_t count, Hdf5Number number,
                   std::span<std::byte> to) const;
  void receive(void* to, std::size_t count) const;
  [[noreturn]] void refuseAsEnded() const;

  std::filesystem::path path_;
  std::stop_token stop_;
  std::uint64_t fileBytes_ = 0;
  int file_ = -1, socket_ = -1;
  mutable std::map<std::string, std::vector<std::uint64_t>> datasets_; ///< once requested
  mutable pid_t process_ = -1;                                         ///< -1: has ended
  mutable std::mutex one_;                                             ///< question and answer
};

} // namespace palp
