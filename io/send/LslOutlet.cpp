#include "io/send/Outlets.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>
#include <vector>

namespace palp {

namespace {

constexpr std::size_t kLongestName = 100;
constexpr int kDoubles = 2;               ///< cft_double64
constexpr double kIrregular = 0;          ///< LSL_IRREGULAR_RATE: frames may be missing
constexpr int kChunkAsPushed = 0;         ///< each sample goes immediately
constexpr int kKeptHundredsOfFrames = 10; ///< of a receiver that is slow; what is more is lost

/// The functions of liblsl that are used here, by its C interface (lsl_c.h, version 1.13 and newer), loaded at run
/// time: Debian has no package of it.
struct LslLibrary {
  void* (*createStreamInfo)(const char* name, const char* type, std::int32_t channels, double rate_Hz, int format,
                            const char* source);
  void (*destroyStreamInfo)(void* info);
  void* (*description)(void* info);
  void* (*appendChild)(void* element, const char* name);
  void* (*appendChildValue)(void* element, const char* name, const char* value);
  void* (*createOutlet)(void* info, std::int32_t chunk, std::int32_t buffered);
  void (*destroyOutlet)(void* outlet);
  std::int32_t (*haveConsumers)(void* outlet);
  std::int32_t (*pushSample)(void* outlet, const double* values, double time_s);
  double (*localClock)();
};

/// Stays loaded until the program ends: the library has threads of its own. Throws Error where it is not installed.
LslLibrary loadLsl(const std::string& where) {
  void* handle = nullptr;
  std::string reason;
  for (const char* name : {"liblsl.so.2", "liblsl.so"}) {
    if (handle == nullptr) handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr && reason.empty()) reason = dlerror(); // NOLINT(concurrency-mt-unsafe)
  }
  if (handle == nullptr)
    throw Error(where + ": needs the library of the Lab Streaming Layer, which cannot be loaded: " + reason +
                "; liblsl.so.2 comes from github.com/sccn/liblsl/releases");
  LslLibrary library{};
  const auto find = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(handle, name));
    if (function == nullptr)
      throw Error(where + ": the library of the Lab Streaming Layer has no function " + name +
                  "; expected version 1.13 or newer");
  };
  find(library.createStreamInfo, "lsl_create_streaminfo");
  find(library.destroyStreamInfo, "lsl_destroy_streaminfo");
  find(library.description, "lsl_get_desc");
  find(library.appendChild, "lsl_append_child");
  find(library.appendChildValue, "lsl_append_child_value");
  find(library.createOutlet, "lsl_create_outlet");
  find(library.destroyOutlet, "lsl_destroy_outlet");
  find(library.haveConsumers, "lsl_have_consumers");
  find(library.pushSample, "lsl_push_sample_dt");
  find(library.localClock, "lsl_local_clock");
  return library;
}

/// What receivers know a stream by again after palp was started anew.
std::string sourceOf(const std::string& stream) {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  return "palp:" + std::string(host.data()) + ":" + stream;
}

/// A stream of type Force, whose channels are the columns of the CSV lines; where these are empty, they are NaN. It
/// begins with the first frame that has forces, as their number is not known before.
class LslOutlet : public ForceOutlet {
public:
  LslOutlet(const std::string& where, std::string stream) : library_(loadLsl(where)), stream_(std::move(stream)) {}
  ~LslOutlet() override {
    if (outlet_ != nullptr) library_.destroyOutlet(outlet_);
  }
  LslOutlet(const LslOutlet&) = delete;
  LslOutlet& operator=(const LslOutlet&) = delete;

  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    if (outlet_ == nullptr && frame.forces_N.cols() > 0) open(frame.forces_N.cols());
    if (outlet_ == nullptr || library_.haveConsumers(outlet_) == 0) return false;
    fill(frame);
    // The library's clock when the force was known: it has another zero than the host's.
    const double now_s = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    const double time_s = library_.localClock() - (now_s - frame.host_unix_s);
    return library_.pushSample(outlet_, values_.data(), time_s) == 0;
  }

private:
  void open(Eigen::Index forces) {
    forces_ = forces;
    std::vector<std::string> labels;
    std::istringstream head(frameCsvHead(forces));
    for (std::string label; std::getline(head, label, ',');) labels.push_back(label.substr(0, label.find('\n')));
    values_.resize(labels.size());
    const std::unique_ptr<void, void (*)(void*)> info(
        library_.createStreamInfo(stream_.c_str(), "Force", static_cast<std::int32_t>(labels.size()), kIrregular,
                                  kDoubles, sourceOf(stream_).c_str()),
        library_.destroyStreamInfo);
    if (!info) return;
    void* const channels = library_.appendChild(library_.description(info.get()), "channels");
    for (const std::string& label : labels) {
      void* const channel = library_.appendChild(channels, "channel");
      library_.appendChildValue(channel, "label", label.c_str());
      const std::size_t unit = label.rfind('_');
      if (unit != std::string::npos) library_.appendChildValue(channel, "unit", label.c_str() + unit + 1);
    }
    outlet_ = library_.createOutlet(info.get(), kChunkAsPushed, kKeptHundredsOfFrames);
  }

  void fill(const OutgoingFrame& frame) {
    std::fill(values_.begin(), values_.end(), std::numeric_limits<double>::quiet_NaN());
    values_[0] = frame.device_s;
    values_[1] = frame.host_unix_s;
    values_[2] = static_cast<double>(frame.frame);
    values_[3] = frame.valid ? 1 : 0;
    if (!frame.valid) return;
    if (frame.area) values_[4] = *frame.area;
    double* next = values_.data() + 5;
    for (const Eigen::Matrix3Xd* given : {&frame.forces_N, &frame.standardDeviation_N}) {
      std::copy_n(given->data(), 3 * std::min(forces_, given->cols()), next);
      next += 3 * forces_;
    }
  }

  LslLibrary library_;
  std::string stream_;
  Eigen::Index forces_ = 0;
  std::vector<double> values_; ///< one a channel
  void* outlet_ = nullptr;
};

} // namespace

std::unique_ptr<ForceOutlet> openLsl(const std::string& where, const std::string& stream) {
  if (stream.size() > kLongestName ||
      std::any_of(stream.begin(), stream.end(), [](char c) { return c <= ' ' || c > '~'; }))
    throw Error(where + ": name of the stream: " +
                gotExpected(quotedText(stream),
                            "1 to " + std::to_string(kLongestName) + " letters, digits and signs without spaces"));
  return std::make_unique<LslOutlet>(where, stream);
}

} // namespace palp
