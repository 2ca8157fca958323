#pragma once

#include <QDoubleSpinBox>

#include <optional>

namespace palp {

/// A box of percent that understands a small share however it is written: a number with an exponent is the share itself
/// ("1e-4" is 0.01 %) unless a percent sign follows it at once ("1e-2%"); all else is percent. QDoubleSpinBox alone
/// drops the letter and makes 1 of 1e-4.
class PercentBox : public QDoubleSpinBox {
public:
  explicit PercentBox(QWidget* parent = nullptr);
  QValidator::State validate(QString& text, int& place) const override;
  [[nodiscard]] double valueFromText(const QString& text) const override;
  /// Without zeros at its end.
  [[nodiscard]] QString textFromValue(double value) const override;

private:
  /// The value in percent; none where the text is left to QDoubleSpinBox.
  [[nodiscard]] std::optional<double> read(const QString& text, bool& whole) const;
};

/// What a box of percent took, both ways: "0.01 % (a share of 1e-04)", "none".
QString percentWords(double share);

/// Shows the value as it is: a file may hold one with more digits, or beyond the range that the box offers, and the box
/// must not say another number than the one that is computed with. Emits nothing.
void showExactly(QDoubleSpinBox& box, double value);

/// The same to six digits: of a number that was computed, and that readExactly reads back to its last digit.
void showSixDigits(QDoubleSpinBox& box, double value);

/// What the box says, a hundredth of it where it is percent; `value` itself, to its last digit, where it shows that.
double readExactly(const QDoubleSpinBox& box, double value, bool percent = false);

} // namespace palp
