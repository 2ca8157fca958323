#include "io/LoadFile.h"

#include "io/AtomicFile.h"
#include "io/StrictJson.h"

namespace palp {

namespace {

constexpr std::size_t kMostSteps = 10000;

} // namespace

Indenter readIndenter(const JsonPlace& place) {
  place.onlyKeys({"shape", "place_mm"}, {"radius_mm", "rim_mm", "friction", "force_N", "depth_mm", "shift_mm"});
  Indenter indenter;
  indenter.shape = place.at("shape").named(kIndenterShapes);
  const bool plane = indenter.shape == IndenterShape::Plane;
  if (!plane && !place.has("radius_mm")) place.refuse("an indenter with its radius_mm");
  indenter.radius_mm = place.has("radius_mm") ? place.at("radius_mm").number(0, 1e6) : 0;
  if (place.has("rim_mm")) indenter.rim_mm = place.at("rim_mm").number(0, 1e6);
  const std::vector<double> at = place.at("place_mm").numbers(2);
  indenter.place_mm = {at[0], at[1]};
  if (place.has("friction")) indenter.friction = place.at("friction").number(0, 1e3);
  if (place.has("force_N") == place.has("depth_mm")) place.refuse("either force_N or depth_mm");
  if (place.has("force_N")) {
    if (place.has("shift_mm")) place.refuse("shift_mm only together with depth_mm");
    const std::vector<double> force = place.at("force_N").numbers(3);
    indenter.control = Press{{force[0], force[1], force[2]}};
  } else {
    Motion motion{place.at("depth_mm").number(0, 1e4)};
    if (place.has("shift_mm")) {
      const std::vector<double> shift = place.at("shift_mm").numbers(2);
      motion.shift_mm = {shift[0], shift[1]};
    }
    indenter.control = motion;
  }
  return indenter;
}

std::vector<LoadCase> parseLoadPath(const std::string& content, const std::string& file) {
  const Json json = parseJson(content, file);
  const JsonPlace root(json, file);
  std::vector<LoadCase> path;
  for (const JsonPlace& step : root.list()) {
    if (path.size() == kMostSteps) root.refuse("a list of at most " + std::to_string(kMostSteps) + " steps");
    step.onlyKeys({"indenters"});
    LoadCase load;
    for (const JsonPlace& indenter : step.at("indenters").list()) load.indenters.push_back(readIndenter(indenter));
    path.push_back(std::move(load));
  }
  return path;
}

std::vector<LoadCase> loadPath(const std::filesystem::path& file) {
  return parseLoadPath(readFile(file), file.string());
}

} // namespace palp
