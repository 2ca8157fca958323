#include "io/ForceOutlet.h"

#include "io/send/Outlets.h"
#include "io/send/SingleHost.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <arpa/inet.h>

#include <charconv>
#include <cstring>

namespace palp {

namespace {

[[noreturn]] void refuseReceiver(const std::string& where) {
  throw Error("receiver: " +
              gotExpected(quotedText(where),
                          "udp:HOST:PORT, osc:HOST:PORT, zmq:HOST:PORT (port 1 to 65535), lsl:NAME or csv:FILE"));
}

/// As in sample files: fx_N, or a0_fx_N where each area has a force.
std::string forceName(Eigen::Index force, Eigen::Index forces, int axis) {
  return (forces > 1 ? "a" + std::to_string(force) + "_" : "") + "f" + "xyz"[axis] + "_N";
}

Receiver receiverOf(const std::string& where, const std::string& rest) {
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string::npos) refuseReceiver(where);
  Receiver receiver{where, rest.substr(0, colon), rest.substr(colon + 1)};
  if (receiver.host.size() > 2 && receiver.host.front() == '[' && receiver.host.back() == ']')
    receiver.host = receiver.host.substr(1, receiver.host.size() - 2);
  int port = 0;
  const char* const end = receiver.port.data() + receiver.port.size();
  const auto [stop, error] = std::from_chars(receiver.port.data(), end, port);
  if (receiver.host.empty() || error != std::errc() || stop != end || port < 1 || port > 65535) refuseReceiver(where);
  return receiver;
}

} // namespace

std::string frameAsJson(const OutgoingFrame& frame) {
  std::string json = R"({"device_s":)" + text(frame.device_s) + R"(,"host_unix_s":)" + text(frame.host_unix_s) +
                     R"(,"frame":)" + std::to_string(frame.frame) + R"(,"valid":)" + (frame.valid ? "1" : "0");
  const Eigen::Index forces = frame.forces_N.cols();
  const auto add = [&](const std::string& before, const Eigen::Matrix3Xd& values) {
    for (Eigen::Index f = 0; f < values.cols(); ++f)
      for (int axis = 0; axis < 3; ++axis)
        if (std::isfinite(values(axis, f)))
          json += ",\"" + before + forceName(f, forces, axis) + "\":" + text(values(axis, f));
  };
  if (frame.valid) {
    add("", frame.forces_N);
    add("sd_", frame.standardDeviation_N);
    if (frame.area) json += R"(,"area":)" + std::to_string(*frame.area);
    const auto addPlace = [&](const std::string& before, const std::optional<Eigen::Vector2d>& place_mm) {
      for (int axis = 0; place_mm && axis < 2; ++axis)
        if (std::isfinite((*place_mm)(axis)))
          json += ",\"" + before + (axis == 0 ? "x_mm\":" : "y_mm\":") + text((*place_mm)(axis));
    };
    addPlace("", frame.place_mm);
    addPlace("sd_", frame.placeDeviation_mm);
    if (frame.doubted) json += R"(,"doubted":1)";
  }
  return json + "}";
}

std::string frameCsvHead(Eigen::Index forces) {
  std::string line = "device_s,host_unix_s,frame,valid,area";
  for (const char* before : {"", "sd_"})
    for (Eigen::Index f = 0; f < forces; ++f)
      for (int axis = 0; axis < 3; ++axis) line += "," + (before + forceName(f, forces, axis));
  return line + "\n";
}

std::string frameAsCsv(const OutgoingFrame& frame, Eigen::Index forces) {
  std::string line = text(frame.device_s) + "," + text(frame.host_unix_s) + "," + std::to_string(frame.frame) +
                     (frame.valid ? ",1," : ",0,");
  if (frame.valid && frame.area) line += std::to_string(*frame.area);
  for (const Eigen::Matrix3Xd* values : {&frame.forces_N, &frame.standardDeviation_N})
    for (Eigen::Index f = 0; f < forces; ++f)
      for (int axis = 0; axis < 3; ++axis) {
        line += ',';
        if (frame.valid && f < values->cols() && std::isfinite((*values)(axis, f))) line += text((*values)(axis, f));
      }
  return line + "\n";
}

bool staysOnThisComputer(const std::string& where) {
  for (const char* kind : {"udp:", "osc:", "zmq:"}) {
    if (!where.starts_with(kind)) continue;
    const std::string rest = where.substr(std::strlen(kind)), host = rest.substr(0, rest.rfind(':'));
    in_addr number{};
    return host == "localhost" || host == "[::1]" || host == "::1" ||
           (inet_pton(AF_INET, host.c_str(), &number) == 1 && ntohl(number.s_addr) >> 24 == IN_LOOPBACKNET);
  }
  return false;
}

std::unique_ptr<ForceOutlet> openOutlet(const std::string& where, bool toMany, bool force) {
  const std::size_t colon = where.find(':');
  const std::string kind = where.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : where.substr(colon + 1);
  if (kind == "csv" && !rest.empty()) return openLines(where, rest, force);
  if (kind == "lsl" && !rest.empty()) return openLsl(where, rest);
  if (kind != "udp" && kind != "osc" && kind != "zmq") refuseReceiver(where);
  const Receiver receiver = receiverOf(where, rest);
  if (!toMany) requireSingleHost(receiver);
  if (kind == "udp") return openUdp(receiver, toMany);
  return kind == "osc" ? openOsc(receiver, toMany) : openZmq(receiver);
}

} // namespace palp
