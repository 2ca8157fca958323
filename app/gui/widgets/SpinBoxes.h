#pragma once

#include <QDoubleSpinBox>

namespace palp {

/// A box that also takes a number with an exponent, as it is written: QDoubleSpinBox drops the letter and makes 1 of
/// 1e-4.
class ExponentBox : public QDoubleSpinBox {
public:
  using QDoubleSpinBox::QDoubleSpinBox;
  QValidator::State validate(QString& text, int& place) const override;
  [[nodiscard]] double valueFromText(const QString& text) const override;
  /// Without zeros at its end.
  [[nodiscard]] QString textFromValue(double value) const override;

private:
  [[nodiscard]] QString bare(const QString& text) const;
};

/// Shows the value as it is: a file may hold one with more digits, or beyond the range that the box offers, and the box
/// must not say another number than the one that is computed with. Emits nothing.
void showExactly(QDoubleSpinBox& box, double value);

} // namespace palp
