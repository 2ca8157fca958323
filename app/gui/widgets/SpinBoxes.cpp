#include "app/gui/widgets/SpinBoxes.h"

#include "app/gui/widgets/ToolTipWrap.h"
#include "model/base/NumberText.h"

#include <QSignalBlocker>
#include <QTimer>
#include <QToolTip>
#include <QVariant>

#include <algorithm>
#include <cmath>
#include <utility>

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

/// The position of the only comma of a text without a point; -1 where there is none.
qsizetype decimalComma(const QString& words) {
  return words.count(',') == 1 && !words.contains('.') ? words.indexOf(',') : -1;
}

} // namespace

std::optional<double> typedNumber(const QString& words) {
  QString number = words;
  if (const qsizetype comma = decimalComma(words); comma >= 0) number[comma] = '.';
  const auto value = numberIn(number.toStdString());
  return value && std::isfinite(*value) ? value : std::nullopt;
}

void showNotApplied(QWidget& at, const QString& sentence) {
  if (auto* messages = at.window()->findChild<QObject*>("messages")) // a dialog has none
    QMetaObject::invokeMethod(messages, "say", Q_ARG(QString, sentence));
  // The focus that is on its way to another widget would hide a box that is shown now.
  QTimer::singleShot(0, &at, [&at, sentence] {
    if (at.isVisible()) QToolTip::showText(at.mapToGlobal(QPoint(0, at.height())), ToolTipWrap::wrapped(sentence), &at);
  });
}

template <class Box> TypedBox<Box>::TypedBox(QWidget* parent) : Box(parent) {
  QObject::connect(this->lineEdit(), &QLineEdit::textEdited, this, [this] {
    if (!std::exchange(typing_, true)) before_ = this->value();
  });
  QObject::connect(this, &Box::editingFinished, this, [this] { typing_ = false; });
}

template <class Box> QString TypedBox<Box>::typedIn(const QString& text) const {
  QString typed = text.startsWith(this->prefix()) ? text.mid(this->prefix().size()) : text;
  if (typed.endsWith(this->suffix())) typed.chop(this->suffix().size());
  return typed.trimmed();
}

template <class Box> QString TypedBox<Box>::whyNot(const QString& typed) const {
  const auto value = read(typed);
  if (!value) return QObject::tr("\"%1\" is not a valid number for this box").arg(typed);
  if (*value >= this->minimum() && *value <= this->maximum()) return {};
  return QObject::tr("%1 is outside %2 to %3%4")
      .arg(typed, this->textFromValue(this->minimum()), this->textFromValue(this->maximum()), this->suffix());
}

template <class Box> QValidator::State TypedBox<Box>::validate(QString& text, int&) const {
  if (!this->specialValueText().isEmpty() && text == this->specialValueText()) return QValidator::Acceptable;
  return whyNot(typedIn(text)).isEmpty() ? QValidator::Acceptable : QValidator::Intermediate;
}

template <class Box> void TypedBox<Box>::fixup(QString& text) const {
  const QString typed = typedIn(text);
  const Value value = typing_ ? before_ : this->value();
  const bool special = value == this->minimum() && !this->specialValueText().isEmpty();
  const QString kept =
      special ? this->specialValueText() : this->prefix() + this->textFromValue(value) + this->suffix();
  if (!typed.isEmpty()) // an empty box is not a mistake
    showNotApplied(const_cast<TypedBox&>(*this),
                   QObject::tr("Not applied: %1. The value is still %2").arg(whyNot(typed), kept.trimmed()));
  text = kept;
}

template <class Box> typename TypedBox<Box>::Value TypedBox<Box>::valueFromText(const QString& text) const {
  if (!this->specialValueText().isEmpty() && text == this->specialValueText()) return this->minimum();
  return read(typedIn(text)).value_or(this->value());
}

template class TypedBox<QDoubleSpinBox>;
template class TypedBox<QSpinBox>;

QValidator::State NumberBox::validate(QString& text, int& place) const {
  if (const qsizetype comma = decimalComma(text); comma >= 0) text[comma] = '.';
  return TypedBox::validate(text, place);
}

std::optional<double> NumberBox::read(const QString& typed) const {
  return typedNumber(typed);
}

QString NumberBox::whyNot(const QString& typed) const {
  if (QString why = TypedBox::whyNot(typed); !why.isEmpty()) return why;
  const double value = *read(typed), rounded = QString::number(value, 'f', decimals()).toDouble();
  if (std::abs(rounded - value) <= 1e-12 * std::abs(value)) return {};
  return QObject::tr("%1 has more decimals than the %2 of this box").arg(typed).arg(decimals());
}

std::optional<int> WholeBox::read(const QString& typed) const {
  bool whole = false;
  const int value = typed.toInt(&whole);
  return whole ? std::optional(value) : std::nullopt;
}

RatioBox::RatioBox(double factor, QString unit, QWidget* parent)
    : NumberBox(parent), factor_(factor), unit_(std::move(unit)) {
  setSuffix(" " + unit_);
}

std::optional<double> RatioBox::read(const QString& typed) const {
  const bool hasUnit = typed.endsWith(unit_);
  const auto value = typedNumber(hasUnit ? typed.chopped(unit_.size()).trimmed() : typed);
  return value && !hasUnit && typed.contains('e', Qt::CaseInsensitive) ? factor_ * *value : value;
}

QString RatioBox::textFromValue(double value) const {
  return QString::number(value, 'g', 12);
}

QString percentWords(double share) {
  if (!(share > 0)) return QObject::tr("none");
  return QObject::tr("%1 % (%2 ppm)").arg(100 * share, 0, 'g', 6).arg(1e6 * share, 0, 'g', 6);
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

double readExactly(const QDoubleSpinBox& box, double value, double factor) {
  const double shown = box.value();
  return std::abs(shown - factor * value) <= 0.5001 * std::pow(10, -box.decimals()) ? value : shown / factor;
}

} // namespace palp
