#include "app/gui/widgets/SpinBoxes.h"

#include <QDoubleSpinBox>
#include <QSignalBlocker>
#include <QVariant>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kMostDecimals = 15;
constexpr const char* kOwnDecimals = "ownDecimals"; ///< those that the box was made with

/// Decimals that a value takes to come back within rounding of a double.
int decimalsOf(double value, int least) {
  for (int decimals = least; decimals < kMostDecimals; ++decimals) {
    const double read = QString::number(value, 'f', decimals).toDouble();
    if (std::abs(read - value) <= 1e-14 * std::abs(value)) return decimals;
  }
  return kMostDecimals;
}

} // namespace

void showExactly(QDoubleSpinBox& box, double value) {
  if (box.value() == value) return; // what is being typed stays as it is
  const QSignalBlocker quiet(box);
  if (!box.property(kOwnDecimals).isValid()) box.setProperty(kOwnDecimals, box.decimals());
  box.setDecimals(decimalsOf(value, box.property(kOwnDecimals).toInt()));
  box.setRange(std::min(box.minimum(), value), std::max(box.maximum(), value));
  box.setValue(value);
}

} // namespace palp
