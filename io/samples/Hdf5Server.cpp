// palp-hdf5 FILE: reads an HDF5 file for palp (io/samples/Hdf5Child.h) and answers its questions through standard
// input, which is a socket. The HDF5 library crashes on some damaged files, and finds no end of others: here that ends
// a process that holds nothing but the file.

#include "io/samples/Hdf5Messages.h"
#include "io/samples/MatFile.h"
#include "model/base/Error.h"

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <vector>

namespace palp {

namespace {

constexpr int kSocket = STDIN_FILENO;
[[maybe_unused]] constexpr rlim_t kMemory_bytes = 256 << 20,
                                  kMemoryPerFileByte = 16; ///< packed numbers are larger in memory
constexpr double kTime_s = 0.5;                            ///< of the processor, for what takes a millisecond
constexpr double kFileRate = 500e6, kNumbersRate = 20e6;   ///< bytes per second, of a slow machine
constexpr double kWaiting = 120;                           ///< for a slow disk: that many times longer in all

void limit(int resource, rlim_t most) {
  const rlimit wanted{most, most};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &wanted);
}

void limitMemory(std::uintmax_t file_bytes) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
#ifndef PALP_SANITIZED // a sanitizer's shadow is memory too
  limit(RLIMIT_DATA, kMemory_bytes + kMemoryPerFileByte * file_bytes);
#else
  static_cast<void>(file_bytes);
#endif
}

/// The process ends by SIGPROF or SIGALRM where the next answer takes longer.
void limitTime(double processor_s) {
  const auto after = [](double seconds) {
    const auto whole = static_cast<time_t>(seconds);
    return itimerval{{0, 0}, {whole, static_cast<suseconds_t>(1e6 * (seconds - static_cast<double>(whole)))}};
  };
  const itimerval processor = after(processor_s), wall = after(kWaiting * processor_s);
  ::setitimer(ITIMER_PROF, &processor, nullptr);
  ::setitimer(ITIMER_REAL, &wall, nullptr);
}

/// False: the other side has closed the socket.
bool receive(void* to, std::size_t count) {
  auto* bytes = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t got = ::recv(kSocket, bytes, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

void send(const void* from, std::size_t count) {
  const auto* bytes = static_cast<const char*>(from);
  while (count > 0) {
    const ssize_t sent = ::send(kSocket, bytes, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) std::_Exit(0); // nobody waits for it any more
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all.append(text.c_str(), std::strlen(text.c_str()) + 1);
  return all;
}

template <class Value> std::string bytesOf(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

template <class Number> std::string rows(const Hdf5File& file, const Hdf5Request& request) {
  const std::vector<std::uint64_t> shape = file.shape(request.name);
  std::uint64_t numbers = request.count;
  for (std::size_t i = 1; i < shape.size(); ++i) numbers *= shape[i];
  if (numbers * sizeof(Number) != request.bytes) file.refuse("has changed while it was read");
  std::vector<Number> values(numbers);
  file.readRows(request.name, request.row, request.count, values.data());
  return bytesOf(values);
}

std::string shapeWords(const std::map<std::string, std::vector<std::uint64_t>>& shapes) {
  std::vector<std::string> words;
  for (const auto& [name, shape] : shapes) {
    std::string sizes;
    for (const std::uint64_t size : shape) sizes += (sizes.empty() ? "" : " ") + std::to_string(size);
    words.insert(words.end(), {name, sizes});
  }
  return joined(words);
}

/// A MAT file has arrays alone.
std::string answer(MatFile& file, const Hdf5Request& request) {
  if (request.question == Hdf5Question::Datasets) return shapeWords(file.shapes());
  if (request.question != Hdf5Question::Rows)
    throw Error("a MAT file contains no samples of Palp; palp import reads it");
  std::vector<double> values(request.bytes / sizeof(double));
  file.readRows(request.name, request.row, request.count, values);
  return bytesOf(values);
}

std::string answer(const Hdf5File& file, const Hdf5Request& request) {
  switch (request.question) {
  case Hdf5Question::Attributes: {
    std::vector<std::string> words;
    for (const auto& [key, value] : file.attributes()) words.insert(words.end(), {key, value});
    return joined(words);
  }
  case Hdf5Question::Texts:
    return joined(file.texts(request.name));
  case Hdf5Question::Layout: {
    const Hdf5Layout found = file.layout(request.name, request.number);
    std::vector<std::uint64_t> numbers{found.chunkRows, found.shuffledDeflate ? 1U : 0U, found.shape.size()};
    numbers.insert(numbers.end(), found.shape.begin(), found.shape.end());
    for (const Hdf5Place& chunk : found.chunks) numbers.insert(numbers.end(), {chunk.offset, chunk.bytes});
    return bytesOf(numbers);
  }
  case Hdf5Question::Datasets:
    return shapeWords(file.shapes());
  case Hdf5Question::Rows:
    return request.number == Hdf5Number::Double ? rows<double>(file, request) : rows<std::int32_t>(file, request);
  }
  return {};
}

void serve(const std::filesystem::path& path) {
  std::error_code none;
  const std::uintmax_t fileBytes = std::filesystem::file_size(path, none);
  limitMemory(none ? 0 : fileBytes);
  std::optional<Hdf5File> file;
  std::optional<MatFile> mat;
  const bool isMat = MatFile::isOne(path);
  for (Hdf5Request request; receive(&request, sizeof request);) {
    request.name[sizeof request.name - 1] = '\0';
    limitTime(kTime_s + static_cast<double>(fileBytes) / kFileRate + static_cast<double>(request.bytes) / kNumbersRate);
    Hdf5Reply reply;
    std::string bytes;
    try {
      if (isMat && !mat) mat.emplace(path);
      if (!isMat && !file) file.emplace(path, Hdf5File::Open::ForReading);
      bytes = isMat ? answer(*mat, request) : answer(*file, request);
    } catch (const Error& refused) {
      reply.refused = 1;
      bytes = refused.what();
    } catch (const std::bad_alloc&) {
      reply.refused = 1;
      bytes = path.string() + ": is damaged: it asks for more memory than a file of its size needs";
    }
    reply.bytes = bytes.size();
    limitTime(0);
    send(&reply, sizeof reply);
    send(bytes.data(), bytes.size());
  }
}

} // namespace

} // namespace palp

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "palp-hdf5 reads HDF5 files for palp, which starts it\n";
    return 2;
  }
  ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0); // some file systems have none, and a notebook may hold the file
  palp::serve(argv[1]);
  std::_Exit(0); // of a damaged file closing may be as bad as reading
}
