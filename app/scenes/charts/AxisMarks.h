#pragma once

#include <string>
#include <utility>
#include <vector>

namespace palp {

/// Where an axis is marked and with what; no VTK, so that it can be tested without a picture.
using AxisMarks = std::vector<std::pair<double, std::string>>;

/// The room that an axis has for the labels of its marks.
struct AxisRoom {
  double length_px = 800;
  double letter_px = 7.5; ///< of a label along the axis: width of a letter on a horizontal axis, 0 on an upright one
  double gap_px = 10;     ///< between two labels; on an upright axis with the height of a line
};

/// As many round marks inside low..high as have room for their labels, and no more than eye and grid can take.
/// Logarithmic: 1, 2, 5 times powers of ten, else powers alone, every other power ...
AxisMarks axisMarks(double low, double high, bool logarithmic, const AxisRoom& room);

/// True where no two labels come closer than the gap.
bool labelsFit(const AxisMarks& marks, double low, double high, bool logarithmic, const AxisRoom& room);

} // namespace palp
