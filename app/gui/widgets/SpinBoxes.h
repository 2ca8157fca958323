#pragma once

class QDoubleSpinBox;

namespace palp {

/// Shows the value as it is: a file may hold one with more digits, or beyond the range that the box offers, and the box
/// must not say another number than the one that is computed with. Emits nothing.
void showExactly(QDoubleSpinBox& box, double value);

} // namespace palp
