#include "io/board/recording/RecordingHead.h"

#include "io/StrictJson.h"

#include <cmath>

namespace palp {

namespace {

constexpr int kRecordingVersion = 2; // 1 had no tares

std::string hexadecimal(const Report& report) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : report) {
    text.push_back(digits[byte >> 4]);
    text.push_back(digits[byte & 0xF]);
  }
  return text;
}

Report reportOf(const JsonPlace& place) {
  const std::string text = place.string();
  const bool hex = text.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (text.size() != 2 * kReportBytes || !hex) place.refuse("64 bytes in lower-case hexadecimal");
  Report report{};
  for (std::size_t i = 0; i < kReportBytes; ++i)
    report[i] = static_cast<std::uint8_t>(std::stoi(text.substr(2 * i, 2), nullptr, 16));
  return report;
}

} // namespace

std::string recordingHeadText(const RecordingHead& head) {
  const Json json{{"palp_recording", kRecordingVersion},    {"source", head.source},
                  {"info", hexadecimal(encode(head.info))}, {"configuration", hexadecimal(encode(head.configuration))},
                  {"network", head.networkFingerprint},     {"started_unix_s", head.startedUnix_s}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

RecordingHead parseRecordingHead(std::string_view text, const std::string& file) {
  const Json json = parseJson(text, file);
  const JsonPlace root(json, file);
  root.onlyKeys({"palp_recording", "source", "info", "configuration", "network", "started_unix_s"});
  formatVersion(root, "palp_recording", kRecordingVersion);
  RecordingHead head;
  const auto info = decodeInfo(reportOf(root.at("info")));
  const auto configuration = decodeConfiguration(reportOf(root.at("configuration")));
  if (!std::holds_alternative<BoardInfo>(info)) root.at("info").refuse("the feature report 0x10 of a board");
  if (!std::holds_alternative<BoardConfiguration>(configuration))
    root.at("configuration").refuse("the feature report 0x11 of a board");
  head.info = std::get<BoardInfo>(info);
  head.configuration = std::get<BoardConfiguration>(configuration);
  head.source = root.at("source").string();
  head.networkFingerprint = root.at("network").string();
  const double started = root.at("started_unix_s").number();
  if (!(std::abs(started) < 1e15)) root.at("started_unix_s").refuse("a time in seconds since 1970");
  head.startedUnix_s = static_cast<std::int64_t>(started);
  return head;
}

} // namespace palp
