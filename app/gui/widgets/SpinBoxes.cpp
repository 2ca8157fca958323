#include "app/gui/widgets/SpinBoxes.h"

#include <QRegularExpression>
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

QString ExponentBox::bare(const QString& text) const {
  QString number = text;
  if (!suffix().isEmpty() && number.endsWith(suffix())) number.chop(suffix().size());
  return number.trimmed();
}

QValidator::State ExponentBox::validate(QString& text, int& place) const {
  static const QRegularExpression withExponent("^[0-9]*[.,]?[0-9]*[eE][-+]?[0-9]*$");
  const QString number = bare(text);
  if (!withExponent.match(number).hasMatch()) return QDoubleSpinBox::validate(text, place);
  bool whole = false;
  const double value = locale().toDouble(number, &whole);
  return whole && value >= minimum() && value <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
}

double ExponentBox::valueFromText(const QString& text) const {
  bool whole = false;
  const double value = locale().toDouble(bare(text), &whole);
  return whole ? value : QDoubleSpinBox::valueFromText(text);
}

QString ExponentBox::textFromValue(double value) const {
  return locale().toString(value, 'g', 12);
}

void showExactly(QDoubleSpinBox& box, double value) {
  if (box.value() == value) return; // what is being typed stays as it is
  const QSignalBlocker quiet(box);
  if (!box.property(kOwnDecimals).isValid()) box.setProperty(kOwnDecimals, box.decimals());
  box.setDecimals(decimalsOf(value, box.property(kOwnDecimals).toInt()));
  box.setRange(std::min(box.minimum(), value), std::max(box.maximum(), value));
  box.setValue(value);
}

} // namespace palp
