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
  if (!shape) throw UsageError("--touch: shape '" + name + "'; allowed is " + indenterShapes());
  range.shape = *shape;
  std::string sizes = colon == std::string::npos ? "" : words.substr(colon + 1);
  if (*shape == IndenterShape::Plane) {
    if (!sizes.empty()) throw UsageError("--touch: '" + words + "'; a plane has no sizes");
    range.smallest_mm = range.largest_mm = 0;
    return;
  }
  const std::size_t comma = sizes.find(',');
  if ((*shape == IndenterShape::Flat) != (comma != std::string::npos))
    throw UsageError("--touch: '" + words + "'; allowed is SHAPE:FROM..TO [mm], of a punch flat:FROM..TO,RIM");
  if (comma != std::string::npos) range.rim_mm = number("--touch (rim)", sizes.substr(comma + 1));
  std::tie(range.smallest_mm, range.largest_mm) = rangeOption("--touch (size)", sizes.substr(0, comma));
}

} // namespace

void TouchArguments::declare(Command command, Option perArea) {
  Option on =
      command.option("--touch", touch,
                     "SHAPE:FROM..TO[@*] [mm]: random touches by an indenter (as --indenter of palp solve) in place "
                     "of forces on areas; @X0,Y0,X1,Y1 where; sphere:3..6@*");
  Option many = command.option("--count", count, "with --touch: how many").needs(on).excludes(perArea);
  on.needs(many);
  command.option("--friction", friction, "with --touch: coefficient, FROM..TO or one number (default 0)").needs(on);
  command
      .option("--force-range", forceRange,
              "with --touch: FZ..FZ[,CONE] [N]: press, and force sideways up to CONE of the limit of friction "
              "(default: a twelfth of the design's largest to all of it; 0.7)")
      .needs(on);
  command.option("--region", region, "with --touch: X0,Y0,X1,Y1 [mm] (default: the face less a tenth of its width)")
      .needs(on);
  command.option("--grid", grid, "with --touch: NXxNY: places in turn on a grid of the region, not anywhere").needs(on);
  command
      .option("--at-once", atOnce,
              "with --touch: 1 or 2 indenters in each sample (default 1); two lie the sum of their radii or more apart")
      .needs(on);
}

void TouchArguments::declareForMap(Command command) {
  Option on = command.option("--touch", touch,
                             "of a map: SHAPE:FROM..TO[@*] [mm], sphere, pin or flat (default sphere:3..6); "
                             "@X0,Y0,X1,Y1 where; of a layout: to resolve such touches best at its worst place");
  command
      .option("--force-range", forceRange,
              "with --touch: FZ..FZ [N]; the map is for its middle (default: a twelfth of the design's largest to all "
              "of it)")
      .needs(on);
  command.option("--region", region, "with --touch: X0,Y0,X1,Y1 [mm] (default: the face less a tenth of its width)")
      .needs(on);
  command
      .option("--grid", grid,
              "with --touch: NXxNY places from side to side of the region (default: a thirtieth of the face apart)")
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
  if (where != "*" && !region.empty()) throw UsageError("--touch " + touch + " and --region both say where; give one");
  if (where != "*") readRegion("--touch (place)", where, range);
  if (!region.empty()) readRegion("--region", region, range);
  if (!friction.empty()) std::tie(range.leastFriction, range.mostFriction) = rangeOption("--friction", friction);
  if (!forceRange.empty()) {
    const std::size_t comma = forceRange.find(',');
    std::tie(range.leastPress_N, range.mostPress_N) = rangeOption("--force-range", forceRange.substr(0, comma));
    if (comma != std::string::npos) range.cone = number("--force-range (cone)", forceRange.substr(comma + 1));
  }
  if (!grid.empty()) {
    const std::size_t x = grid.find('x');
    if (x == std::string::npos) throw UsageError("--grid: '" + grid + "'; allowed is NXxNY, for example 10x10");
    range.grid = {wholeNumber("--grid", grid.substr(0, x), 1, 10000),
                  wholeNumber("--grid", grid.substr(x + 1), 1, 10000)};
  }
  if (!atOnce.empty()) range.atOnce = wholeNumber("--at-once", atOnce, 1, 2);
  if (const auto wrong = whyInvalid(range, design)) throw UsageError("--touch: " + *wrong);
  return range;
}

} // namespace palp
