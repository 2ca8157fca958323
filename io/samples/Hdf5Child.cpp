#include "io/samples/Hdf5Child.h"

#include "io/files/SystemError.h"
#include "io/samples/Hdf5Messages.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr int kLookEvery_ms = 20;                    ///< for a request to stop
constexpr std::uint64_t kMostWords_bytes = 64 << 20; ///< attributes, names of columns, places of chunks

/// Next to the program, or where an installation has it.
fs::path readingProgram() {
  std::error_code none;
  const fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path();
  const std::array places{folder, folder.parent_path() / "libexec" / "palp", fs::path(PALP_PROGRAMS_DIR),
                          fs::path("/usr/libexec/palp")};
  std::string looked;
  for (const fs::path& place : places) {
    const fs::path program = place / "palp-hdf5";
    if (::access(program.c_str(), X_OK) == 0) return program;
    looked += (looked.empty() ? "" : ", ") + place.string();
  }
  throw Error("palp-hdf5, the program that reads HDF5 files for palp, is missing; looked in " + looked);
}

/// Starts it with one end of a socket as its standard input. A group of its own: Ctrl+C is for us, who then end it.
pid_t startReading(const fs::path& file, int socket) {
  const fs::path program = readingProgram();
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
  for (const int silent : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, silent, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes{};
  posix_spawnattr_init(&attributes);
  sigset_t none{}, all{};
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::string first = program.string(), second = file.string();
  std::array<char*, 3> words{first.data(), second.data(), nullptr};
  pid_t process = -1;
  const int failed = posix_spawn(&process, program.c_str(), &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw Error(program.string() + ": cannot be started: " + systemMessage(failed));
  return process;
}

Hdf5Request requestOf(Hdf5Question question, const std::string& dataset = {}) {
  Hdf5Request request;
  request.question = question;
  if (dataset.size() >= sizeof request.name) throw Error(dataset + ": the name of a dataset is too long");
  dataset.copy(request.name, sizeof request.name - 1);
  return request;
}

std::vector<std::string> splitAtZeros(const std::string& all) {
  std::vector<std::string> texts;
  for (std::size_t first = 0; first < all.size();) {
    const std::size_t end = std::min(all.find('\0', first), all.size());
    texts.push_back(all.substr(first, end - first));
    first = end + 1;
  }
  return texts;
}

/// What comes from a stranger's file, for one line of a terminal.
std::string printable(std::string text) {
  constexpr std::size_t kLongest = 500;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

} // namespace

Hdf5Child::Hdf5Child(fs::path path, std::stop_token stop) : path_(std::move(path)), stop_(std::move(stop)) {
  std::error_code failed;
  fileBytes_ = fs::file_size(path_, failed);
  if (failed) refuse("cannot be read: " + failed.message());
  file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  std::array<int, 2> ends{};
  if (file_ < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    const std::string reason = systemMessage();
    if (file_ >= 0) ::close(file_);
    refuse("cannot be read: " + reason);
  }
  socket_ = ends[0];
  try {
    process_ = startReading(path_, ends[1]);
  } catch (const Error&) { // the destructor does not run for what was never constructed
    for (const int open : {file_, ends[0], ends[1]}) ::close(open);
    throw;
  }
  ::close(ends[1]);
}

Hdf5Child::~Hdf5Child() {
  ::close(socket_);
  ::close(file_);
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Hdf5Child::refuse(const std::string& sentence) const {
  throw Error(path_.string() + ": " + sentence);
}

void Hdf5Child::refuseAsEnded() const {
  int status = 0;
  pid_t ended = process_;
  while (process_ >= 0 && (ended = ::waitpid(process_, &status, 0)) < 0 && errno == EINTR) {
  }
  const bool known = process_ >= 0 && ended == process_;
  process_ = -1;
  if (known && WIFEXITED(status) && WEXITSTATUS(status) != 0)
    refuse("cannot be read: palp-hdf5, which reads it, ended with status " + std::to_string(WEXITSTATUS(status)));
  const int signal = known && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGPROF || signal == SIGALRM) refuse("is damaged: reading it does not end");
  if (signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP)
    refuse("cannot be read: palp-hdf5, which reads it, was ended from outside (signal " + std::to_string(signal) + ")");
  refuse("is damaged: the HDF5 library fails on it" + (signal > 0 ? " (signal " + std::to_string(signal) + ")" : ""));
}

void Hdf5Child::receive(void* to, std::size_t count) const {
  auto* bytes = static_cast<char*>(to);
  while (count > 0) {
    throwIfStopped(stop_);
    pollfd ready{socket_, POLLIN, 0};
    if (::poll(&ready, 1, kLookEvery_ms) <= 0) continue;
    const ssize_t got = ::recv(socket_, bytes, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) refuseAsEnded();
    bytes += got;
    count -= static_cast<std::size_t>(got);
  }
}

void Hdf5Child::ask(const Hdf5Request& request, const std::function<void*(std::uint64_t bytes)>& room) const {
  const std::lock_guard lock(one_);
  if (::send(socket_, &request, sizeof request, MSG_NOSIGNAL) != ssize_t(sizeof request)) refuseAsEnded();
  Hdf5Reply reply;
  receive(&reply, sizeof reply);
  if (reply.refused != 0) {
    std::string sentence(std::min<std::uint64_t>(reply.bytes, kMostWords_bytes), '\0');
    receive(sentence.data(), sentence.size());
    throw Error(printable(sentence));
  }
  void* const to = room(reply.bytes);
  if (to == nullptr) refuse("is damaged: the size of an array differs from the size given in the file");
  receive(to, reply.bytes);
}

std::string Hdf5Child::answer(const Hdf5Request& request, std::uint64_t most) const {
  std::string bytes;
  ask(request, [&](std::uint64_t count) {
    if (count <= most) bytes.resize(count);
    return count <= most ? bytes.data() : nullptr;
  });
  return bytes;
}

std::map<std::string, std::string> Hdf5Child::attributes() const {
  const auto words = splitAtZeros(answer(requestOf(Hdf5Question::Attributes), kMostWords_bytes));
  std::map<std::string, std::string> values;
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) values.emplace(words[i], words[i + 1]);
  return values;
}

const std::map<std::string, std::vector<std::uint64_t>>& Hdf5Child::datasets() const {
  if (!datasets_.empty()) return datasets_;
  const auto words = splitAtZeros(answer(requestOf(Hdf5Question::Datasets), kMostWords_bytes));
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    std::istringstream sizes(words[i + 1]);
    std::vector<std::uint64_t>& shape = datasets_[words[i]];
    for (std::uint64_t size = 0; sizes >> size;) shape.push_back(size);
  }
  return datasets_;
}

std::vector<std::string> Hdf5Child::texts(const std::string& name) const {
  return splitAtZeros(answer(requestOf(Hdf5Question::Texts, name), kMostWords_bytes));
}

Hdf5Layout Hdf5Child::layout(const std::string& name, Hdf5Number number) const {
  Hdf5Request request = requestOf(Hdf5Question::Layout, name);
  request.number = number;
  const std::string bytes = answer(request, kMostWords_bytes);
  std::vector<std::uint64_t> numbers(bytes.size() / sizeof(std::uint64_t));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(std::uint64_t));
  constexpr std::size_t kBefore = 3;
  if (numbers.size() <= kBefore || numbers[2] < 1 || numbers[2] > numbers.size() - kBefore)
    refuse("is damaged: dataset " + name + " has no shape");
  const auto shape = numbers.begin() + kBefore, end = shape + static_cast<std::ptrdiff_t>(numbers[2]);
  Hdf5Layout found{{shape, end}, numbers[0], numbers[1] != 0, {}};
  for (auto chunk = end; numbers.end() - chunk > 1; chunk += 2) found.chunks.push_back({chunk[0], chunk[1]});
  return found;
}

std::span<const unsigned char> Hdf5Child::readChunk(const Hdf5Place& place, std::vector<unsigned char>& room) const {
  if (place.bytes > fileBytes_ || place.offset > fileBytes_ - place.bytes) return {};
  if (room.size() < place.bytes) room.resize(place.bytes);
  for (std::uint64_t done = 0; done < place.bytes;) {
    const ssize_t got = ::pread(file_, room.data() + done, place.bytes - done, static_cast<off_t>(place.offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return {};
    done += static_cast<std::uint64_t>(got);
  }
  return {room.data(), place.bytes};
}

void Hdf5Child::readRows(const std::string& name, std::uint64_t row, std::uint64_t count,
                         std::span<double> values) const {
  readNumbers(name, row, count, Hdf5Number::Double, std::as_writable_bytes(values));
}

void Hdf5Child::readRows(const std::string& name, std::uint64_t row, std::uint64_t count,
                         std::span<std::int32_t> values) const {
  readNumbers(name, row, count, Hdf5Number::Int32, std::as_writable_bytes(values));
}

void Hdf5Child::readNumbers(const std::string& name, std::uint64_t row, std::uint64_t count, Hdf5Number number,
                            std::span<std::byte> to) const {
  Hdf5Request request = requestOf(Hdf5Question::Rows, name);
  request.number = number;
  request.row = row;
  request.count = count;
  request.bytes = to.size();
  ask(request, [&](std::uint64_t bytes) { return bytes == to.size() ? to.data() : nullptr; });
}

} // namespace palp
