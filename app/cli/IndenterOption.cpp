#include "app/cli/IndenterOption.h"

#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

namespace palp {

namespace {

constexpr const char* kIndenterForm =
    "SHAPE:SIZES@X,Y:press=FX,FY,FZ[:mu=MU] or SHAPE:SIZES@X,Y:depth=D[,SX,SY][:mu=MU], for example "
    "sphere:5@15,7.5:press=1,0,-6:mu=0.5";

[[noreturn]] void refuseIndenter(const std::string& value, const std::string& expected) {
  throw badValue("--indenter", value, expected);
}

/// The part before the first separator, which is taken off with it; all of it where there is none.
std::string takeUpTo(char separator, std::string& rest) {
  const std::size_t end = rest.find(separator);
  std::string part = rest.substr(0, end);
  rest = end == std::string::npos ? "" : rest.substr(end + 1);
  return part;
}

/// "name=value" in two.
std::pair<std::string, std::string> setting(const std::string& value, std::string part) {
  if (part.find('=') == std::string::npos) refuseIndenter(value, kIndenterForm);
  std::string name = takeUpTo('=', part);
  return {name, part};
}

/// Sphere, pin and cylinders have a radius, a punch radius and rim, a plane nothing.
void readSizes(const std::string& value, const std::string& sizes, Indenter& indenter) {
  if (indenter.shape == IndenterShape::Plane) {
    if (!sizes.empty()) refuseIndenter(value, "plane@X,Y, because a plane has no sizes");
    return;
  }
  const bool flat = indenter.shape == IndenterShape::Flat;
  if (sizes.empty()) refuseIndenter(value, shapeName(indenter.shape) + (flat ? ":RADIUS,RIM [mm]" : ":RADIUS [mm]"));
  const std::vector<double> read = numbers("--indenter (sizes)", sizes, flat ? 2 : 1);
  indenter.radius_mm = read[0];
  if (flat) indenter.rim_mm = read[1];
}

} // namespace

Indenter indenterOption(const std::string& value) {
  std::string rest = value, body = rest.substr(0, rest.find('@'));
  if (body.size() == rest.size()) refuseIndenter(value, kIndenterForm);
  rest.erase(0, body.size() + 1);
  Indenter indenter;
  const std::string name = takeUpTo(':', body);
  const auto shape = indenterShape(name);
  if (!shape) throw badValue("--indenter (shape)", name, indenterShapes());
  indenter.shape = *shape;
  readSizes(value, body, indenter);
  const std::vector<double> place = numbers("--indenter (position)", takeUpTo(':', rest), 2);
  indenter.place_mm = {place[0], place[1]};
  bool controlled = false, rubbed = false;
  while (!rest.empty()) {
    const auto [what, how] = setting(value, takeUpTo(':', rest));
    if ((what == "mu" && rubbed) || ((what == "press" || what == "depth") && controlled))
      refuseIndenter(value, "either press or depth, and mu at most once");
    if (what == "press") {
      const std::vector<double> force = numbers("--indenter (press)", how, 3);
      indenter.control = Press{{force[0], force[1], force[2]}};
      controlled = true;
    } else if (what == "depth") {
      const bool sideways = how.find(',') != std::string::npos;
      const std::vector<double> way = numbers("--indenter (depth)", how, sideways ? 3 : 1);
      indenter.control = Motion{way[0], sideways ? Eigen::Vector2d(way[1], way[2]) : Eigen::Vector2d(0, 0)};
      controlled = true;
    } else if (what == "mu") {
      indenter.friction = number("--indenter (mu)", how);
      rubbed = true;
    } else {
      refuseIndenter(value, "press, depth or mu instead of " + quotedText(what));
    }
  }
  if (!controlled) refuseIndenter(value, std::string("press or depth: ") + kIndenterForm);
  return indenter;
}

} // namespace palp
