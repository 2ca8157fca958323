// A stand-in of liblsl, of which Debian has no package: the functions of its C interface (lsl_c.h) that Palp calls. Its
// one receiver is the file lsl-receiver.txt of the current folder, where there is one: a line for what the stream is, a
// line for each child of its description and a line for each sample.

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace {

constexpr const char* kReceiver = "lsl-receiver.txt";

struct Stream {
  std::int32_t channels = 0;
  std::string text;
};

Stream& streamOf(void* handle) {
  return *static_cast<Stream*>(handle);
}

void receive(const std::string& line) {
  if (std::FILE* const file = std::fopen(kReceiver, "r+")) {
    std::fseek(file, 0, SEEK_END);
    std::fputs(line.c_str(), file);
    std::fclose(file);
  }
}

std::string exactText(double value) {
  char text[40];
  std::snprintf(text, sizeof text, " %.17g", value);
  return text;
}

} // namespace

extern "C" {

void* lsl_create_streaminfo(const char* name, const char* type, std::int32_t channels, double rate, int format,
                            const char* source) {
  return new Stream{channels, "stream " + std::string(name) + " " + type + " " + std::to_string(channels) +
                                  exactText(rate) + " " + std::to_string(format) + " " + source + "\n"};
}

void lsl_destroy_streaminfo(void* info) {
  delete &streamOf(info);
}

void* lsl_get_desc(void* info) {
  return info;
}

void* lsl_append_child(void* element, const char* name) {
  streamOf(element).text += std::string(name) + "\n";
  return element;
}

void* lsl_append_child_value(void* element, const char* name, const char* value) {
  streamOf(element).text += std::string(name) + " " + value + "\n";
  return element;
}

void* lsl_create_outlet(void* info, std::int32_t /*chunk*/, std::int32_t /*buffered*/) {
  receive(streamOf(info).text);
  return new Stream(streamOf(info));
}

void lsl_destroy_outlet(void* outlet) {
  receive("end\n");
  delete &streamOf(outlet);
}

std::int32_t lsl_have_consumers(void* /*outlet*/) {
  std::FILE* const file = std::fopen(kReceiver, "r");
  if (file != nullptr) std::fclose(file);
  return file != nullptr ? 1 : 0;
}

std::int32_t lsl_push_sample_dt(void* outlet, const double* values, double time_s) {
  std::string line = "sample" + exactText(time_s);
  for (std::int32_t i = 0; i < streamOf(outlet).channels; ++i) line += exactText(values[i]);
  receive(line + "\n");
  return 0;
}

double lsl_local_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
}
