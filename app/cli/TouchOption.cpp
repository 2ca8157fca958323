#include "app/cli/TouchOption.h"

#include "app/cli/Cli.h"
#include "app/cli/Options.h"

#include <utility>

namespace palp {

namespace {

/// FROM..TO or one number. Throws UsageError.
std::pair<double, double> rangeOption(const std::string& option, const std::string& value) {
  const std::size_t dots = value.find("..");
  const double from = number(option, value.substr(0, dots));
  return {from, dots == std::string::npos ? from : number(option, value.substr(dots + 2))};
}

void readRegion(const std::string& option, const std::string& value, TouchRange& range) {
  const std::vector<double> corners = numbers(option, value, 4);
  range.low_mm = {corners[0], corners[1]};
  range.high_mm = {corners[2], corners[3]};
}

/// The shape with its sizes; what it has none of becomes 0.
void readShape(const std::string& words, TouchRange& range) {
  const std::size_t colon = words.find(':');
  const std::string name = words.substr(0, colon);
  const auto shape = indenterShape(name);
  if (!shape) throw badValue("--touch (shape)", name, indenterShapes());
  range.shape = *shape;
  std::string sizes = colon == std::string::npos ? "" : words.substr(colon + 1);
  if (*shape == IndenterShape::Plane) {
    if (!sizes.empty()) throw badValue("--touch", words, "plane, which has no sizes");
    range.smallest_mm = range.largest_mm = 0;
    return;
  }
  const std::size_t comma = sizes.find(',');
  if (sizes.empty()) throw badValue("--touch", words, "sizes after the shape, for example " + name + ":3..6@*");
  if ((*shape == IndenterShape::Flat) != (comma != std::string::npos))
    throw badValue("--touch", words, "SHAPE:FROM..TO [mm], or flat:FROM..TO,RIM for a punch");
  if (comma != std::string::npos) range.rim_mm = number("--touch (rim)", sizes.substr(comma + 1));
  std::tie(range.smallest_mm, range.largest_mm) = rangeOption("--touch (size)", sizes.substr(0, comma));
}

} // namespace

void TouchArguments::declareRegion(Command command, Option on) {
  command
      .option("--region", region, "X0,Y0,X1,Y1",
              "region of the positions [mm] (default: the face without a margin of a tenth of its width)")
      .needs(on);
}

void TouchArguments::declare(Command command, Option perArea) {
  command.group("Touches by an indenter");
  Option on = command.option("--touch", touch, "SHAPE:FROM..TO[@REGION]",
                             "random touches instead of forces on areas, radius from FROM to TO [mm]; shapes as "
                             "--indenter of palp solve; @* or @X0,Y0,X1,Y1 is the region; for example sphere:3..6@*");
  Option many = command.option("--count", count, "N", "number of touches").needs(on).excludes(perArea);
  on.needs(many);
  command.option("--friction", friction, "FROM..TO", "coefficient of friction, or one number (default 0)").needs(on);
  command
      .option("--force-range", forceRange, "FZ..FZ[,CONE]",
              "normal force [N], and tangential force up to CONE of the limit of friction (default: a twelfth of the "
              "design's largest force to all of it; 0.7)")
      .needs(on);
  declareRegion(command, on);
  command.option("--grid", grid, "NXxNY", "take the positions in turn from a grid of the region").needs(on);
  command
      .option("--at-once", atOnce, "N",
              "1 or 2 indenters in each sample (default 1); two are at least the sum of their radii apart")
      .needs(on);
}

void TouchArguments::declareForMap(Command command) {
  command.group("Touches by an indenter");
  Option on =
      command.option("--touch", touch, "SHAPE:FROM..TO[@REGION]",
                     "for map and layout: sphere, pin or flat with a radius from FROM to TO [mm] (default "
                     "sphere:3..6); @* or @X0,Y0,X1,Y1 is the region; the layout is chosen for the worst position");
  command
      .option("--force-range", forceRange, "FZ..FZ",
              "normal force [N]; the map is for its middle (default: a twelfth of the design's largest force to all "
              "of it)")
      .needs(on);
  declareRegion(command, on);
  command
      .option("--grid", grid, "NXxNY",
              "positions from side to side of the region (default: a thirtieth of the face apart)")
      .needs(on);
}

std::string TouchArguments::asCommand() const {
  std::string words;
  for (const auto& [option, value] :
       {std::pair{" --touch ", &touch}, std::pair{" --count ", &count}, std::pair{" --friction ", &friction},
        std::pair{" --force-range ", &forceRange}, std::pair{" --region ", &region}, std::pair{" --grid ", &grid},
        std::pair{" --at-once ", &atOnce}})
    if (!value->empty()) words += option + *value;
  return words;
}

TouchRange TouchArguments::range(const SensorDesign& design) const {
  TouchRange range = touchesOf(design);
  const std::size_t at = touch.find('@');
  readShape(touch.substr(0, at), range);
  const std::string where = at == std::string::npos ? "*" : touch.substr(at + 1);
  if (where != "*" && !region.empty())
    throw UsageError("--region: not together with the region in --touch " + touch + "; give one of them");
  if (where != "*") readRegion("--touch (region)", where, range);
  if (!region.empty()) readRegion("--region", region, range);
  if (!friction.empty()) std::tie(range.leastFriction, range.mostFriction) = rangeOption("--friction", friction);
  if (!forceRange.empty()) {
    const std::size_t comma = forceRange.find(',');
    std::tie(range.leastPress_N, range.mostPress_N) = rangeOption("--force-range", forceRange.substr(0, comma));
    if (comma != std::string::npos) range.cone = number("--force-range (cone)", forceRange.substr(comma + 1));
  }
  if (!grid.empty()) {
    const std::size_t x = grid.find('x');
    if (x == std::string::npos) throw badValue("--grid", grid, "NXxNY, for example 10x10");
    range.grid = {wholeNumber("--grid", grid.substr(0, x), 1, 10000),
                  wholeNumber("--grid", grid.substr(x + 1), 1, 10000)};
  }
  if (!atOnce.empty()) range.atOnce = wholeNumber("--at-once", atOnce, 1, 2);
  if (const auto wrong = whyInvalid(range, design)) throw UsageError("--touch: " + *wrong);
  return range;
}

} // namespace palp
