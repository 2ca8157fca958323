#pragma once

#include "app/scenes/Palette.h"
#include "model/base/NamedEnum.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkLookupTable;

namespace palp {

/// Perceptually uniform maps; Diverging (blue, white, red) is for signed values: white is 0 whatever the range is, and
/// the end next to 0 where the range has one sign.
enum class ColorMap { Viridis, Cividis, Diverging, Inferno };
inline constexpr NamedEnum kColorMaps("color map", std::array{std::pair{ColorMap::Viridis, "viridis"},
                                                              std::pair{ColorMap::Cividis, "cividis"},
                                                              std::pair{ColorMap::Inferno, "inferno"},
                                                              std::pair{ColorMap::Diverging, "blue-white-red"}});

/// A quantity's colours: map, range, name and unit. Everything coloured shows it as a legend.
struct ColorScale {
  ColorMap map = ColorMap::Viridis;
  double low = 0;
  double high = 1;
  std::string quantity; ///< "|u|"
  std::string unit;     ///< "mm"; empty for a pure number
  double opacity = 1;   ///< of what is coloured, over `ground`
  Color ground{1, 1, 1};
  bool logarithmic = false; ///< equal factors look equally large; of values above 0

  /// Position of a value between low and high, 0 to 1, and its inverse.
  [[nodiscard]] double share(double value) const;
  [[nodiscard]] double at(double share) const;
  [[nodiscard]] Color color(double value) const;
  /// As it looks where it is drawn: the legend's colour.
  [[nodiscard]] Color shown(double value) const;
  /// "quantity [unit]".
  [[nodiscard]] std::string title() const;
};

/// The scale that shows all the values: Diverging is symmetric about 0, the others span the finite values. Never empty.
ColorScale fittingScale(ColorMap map, const std::vector<double>& values, std::string quantity, std::string unit);

/// The same as a table for VTK's mappers.
vtkSmartPointer<vtkLookupTable> lookupTable(const ColorScale& scale);

/// Round numbers (1, 2 or 5 times a power of ten apart) inside low..high, at most `most` of them.
std::vector<double> roundTicks(double low, double high, int most);

/// Numbers 1, 2 and 5, 1 and 3 or 1 times powers of ten inside low..high, at most `most` of them where there are fewer
/// decades.
std::vector<double> decadeTicks(double low, double high, int most);

/// The numbers as text with equally many decimals, in the shortest form that keeps them apart.
std::vector<std::string> tickTexts(const std::vector<double>& ticks);

} // namespace palp
