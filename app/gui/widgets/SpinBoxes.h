#pragma once

#include <QDoubleSpinBox>
#include <QLineEdit>

#include <optional>
#include <utility>

namespace palp {

/// The number that was typed, in every field of the window: a single comma means the decimal point, whatever the
/// locale. Returns nullopt where the text is not a number, as "1,234.5" with its group separator.
std::optional<double> typedNumber(const QString& words);

/// Reports why what was typed at a widget is not applied: in a tooltip at the widget and in the messages of its window.
void showNotApplied(QWidget& at, const QString& sentence);

/// A box of numbers that never drops a key: what is typed or pasted is applied as it is, or refused with a sentence
/// and the value from before the typing comes back. QDoubleSpinBox and QSpinBox alone leave out the keys that they do
/// not take: "-1,5" becomes -15, and "40" in a box up to 30 becomes 4.
template <class Box> class TypedBox : public Box {
public:
  explicit TypedBox(QWidget* parent = nullptr);
  QValidator::State validate(QString& text, int& place) const override;
  void fixup(QString& text) const override;

protected:
  using Value = decltype(std::declval<Box>().value());
  /// The value of the text between prefix and suffix; nullopt where it has none.
  [[nodiscard]] virtual std::optional<Value> read(const QString& typed) const = 0;
  /// Why a value cannot be applied; empty where it can.
  [[nodiscard]] virtual QString whyNot(const QString& typed) const;
  [[nodiscard]] Value valueFromText(const QString& text) const override;
  /// The text between prefix and suffix.
  [[nodiscard]] QString typedIn(const QString& text) const;

private:
  bool typing_ = false;
  Value before_{}; ///< the value as it was when the typing began
};

/// A box of numbers with a decimal point; a comma that is typed becomes one.
class NumberBox : public TypedBox<QDoubleSpinBox> {
public:
  using TypedBox::TypedBox;
  QValidator::State validate(QString& text, int& place) const override;

protected:
  [[nodiscard]] std::optional<double> read(const QString& typed) const override;
  [[nodiscard]] QString whyNot(const QString& typed) const override;
};

/// A box of whole numbers.
class WholeBox : public TypedBox<QSpinBox> {
public:
  using TypedBox::TypedBox;

protected:
  [[nodiscard]] std::optional<int> read(const QString& typed) const override;
};

/// A box of a ratio in percent or ppm that accepts every notation: a number with an exponent is the ratio itself
/// ("1e-4" is 0.01 %) unless the unit follows it ("1e-2%"); any other number has the unit of the box.
class RatioBox : public NumberBox {
public:
  /// `factor`: 100 with the unit "%", 1e6 with "ppm".
  explicit RatioBox(double factor, QString unit, QWidget* parent = nullptr);
  /// Without zeros at its end.
  [[nodiscard]] QString textFromValue(double value) const override;

protected:
  /// In the unit of the box.
  [[nodiscard]] std::optional<double> read(const QString& typed) const override;

private:
  double factor_;
  QString unit_;
};

/// A ratio in percent and in ppm: "0.01 % (100 ppm)", or "none".
QString percentWords(double share);

/// Shows the value as it is: a file may hold one with more digits, or beyond the range that the box offers, and the box
/// must not say another number than the one that is computed with. Emits nothing.
void showExactly(QDoubleSpinBox& box, double value);

/// The same to six digits: of a number that was computed, and that readExactly reads back to its last digit.
void showSixDigits(QDoubleSpinBox& box, double value);

/// The number in the box, which shows `factor` times a value; `value` itself, to its last digit, if the box shows it.
double readExactly(const QDoubleSpinBox& box, double value, double factor = 1);

} // namespace palp
