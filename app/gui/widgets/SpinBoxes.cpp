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

PercentBox::PercentBox(QWidget* parent) : QDoubleSpinBox(parent) {
  setSuffix(tr(" %"));
}

std::optional<double> PercentBox::read(const QString& text, bool& whole) const {
  static const QRegularExpression number("^([0-9]*[.,]?[0-9]*(?:([eE])[-+]?[0-9]*)?)(%?)$");
  QString typed = text.startsWith(prefix()) ? text.mid(prefix().size()) : text;
  if (!suffix().isEmpty() && typed.endsWith(suffix())) typed.chop(suffix().size()); // the box's own
  const QRegularExpressionMatch parts = number.match(typed.trimmed());
  const bool exponent = !parts.captured(2).isEmpty(), percent = !parts.captured(3).isEmpty();
  if (!parts.hasMatch() || (!exponent && !percent)) return std::nullopt;
  const double value = locale().toDouble(parts.captured(1), &whole);
  return percent ? value : 100 * value;
}

QValidator::State PercentBox::validate(QString& text, int& place) const {
  bool whole = false;
  const auto value = read(text, whole);
  if (!value) return QDoubleSpinBox::validate(text, place);
  return whole && *value >= minimum() && *value <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
}

double PercentBox::valueFromText(const QString& text) const {
  bool whole = false;
  const auto value = read(text, whole);
  return value && whole ? *value : QDoubleSpinBox::valueFromText(text);
}

QString PercentBox::textFromValue(double value) const {
  return locale().toString(value, 'g', 12);
}

QString percentWords(double share) {
  if (!(share > 0)) return QObject::tr("none");
  return QObject::tr("%1 % (a share of %2)").arg(100 * share, 0, 'g', 6).arg(share, 0, 'g', 6);
}

void showExactly(QDoubleSpinBox& box, double value) {
  if (box.value() == value) return; // what is being typed stays as it is
  const QSignalBlocker quiet(box);
  if (!box.property(kOwnDecimals).isValid()) box.setProperty(kOwnDecimals, box.decimals());
  box.setDecimals(decimalsOf(value, box.property(kOwnDecimals).toInt()));
  box.setRange(std::min(box.minimum(), value), std::max(box.maximum(), value));
  box.setValue(value);
}

void showSixDigits(QDoubleSpinBox& box, double value) {
  showExactly(box, QString::number(value, 'g', 6).toDouble());
}

double readExactly(const QDoubleSpinBox& box, double value, bool percent) {
  const double unit = percent ? 100 : 1, shown = box.value();
  return std::abs(shown - unit * value) <= 0.5001 * std::pow(10, -box.decimals()) ? value : shown / unit;
}

} // namespace palp
