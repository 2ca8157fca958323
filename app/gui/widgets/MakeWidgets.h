#pragma once

#include <QString>
#include <QStringList>

#include <initializer_list>

class QBoxLayout;
class QCheckBox;
class QComboBox;
class QHBoxLayout;
class QLabel;
class QLayout;
class QLineEdit;
class QPushButton;
class QVBoxLayout;
class QWidget;

namespace palp {

class NumberBox;
class RatioBox;
class WholeBox;
class WrappedLabel;

// Widgets with their usual properties. `id` is the object name, by which tests and style sheets find a widget; `tip`
// its tooltip; `spoken` its name for screen readers, where no label next to it has one.

struct NumberForm {
  double low = 0, high = 99.99;
  int decimals = 2;
  double step = 1;
  QString unit{};
  QString special{};        ///< shown instead of the lowest value
  bool whileTyping = false; ///< changes with each key, not only when the focus leaves or Enter is pressed
};
NumberBox* numberBox(const QString& id, const NumberForm& form, const QString& tip, const QString& spoken = {});
/// A ratio in percent.
RatioBox* percentBox(const QString& id, double high, const QString& tip);

struct WholeForm {
  int low = 0, high = 99;
  QString unit{};
  QString special{};
  bool whileTyping = false;
};
WholeBox* wholeBox(const QString& id, const WholeForm& form, const QString& tip, const QString& spoken = {});

/// The texts of a NamedEnum.
template <class Names> QStringList textsOf(const Names& names) {
  QStringList texts;
  for (const auto& [value, text] : names.all()) texts << QString(text);
  return texts;
}
QComboBox* choiceBox(const QString& id, const QStringList& choices, const QString& tip, const QString& spoken = {});
QCheckBox* checkBox(const QString& text, const QString& id, const QString& tip = {});
QPushButton* pushButton(const QString& text, const QString& id, const QString& tip = {});
QLineEdit* lineEdit(const QString& id, const QString& tip, const QString& spoken = {});
/// A label of several lines; `role` selects its style: hint, problem or title.
QLabel* textLabel(const QString& id, const char* role = nullptr, const QString& text = {});
WrappedLabel* wrappedLabel(const QString& id, const char* role = nullptr, const QString& text = {});

/// What a row or a column of widgets contains: a widget or a layout with its stretch factor, or space that stretches.
struct Part {
  Part(QWidget* part, int factor = 0) : widget(part), stretchFactor(factor) {}
  Part(QLayout* part, int factor = 0) : layout(part), stretchFactor(factor) {}
  static Part stretch(int factor = 1) { return {static_cast<QWidget*>(nullptr), factor}; }

  QWidget* widget = nullptr;
  QLayout* layout = nullptr;
  int stretchFactor = 0;
};
void addTo(QBoxLayout& layout, std::initializer_list<Part> parts);
QHBoxLayout* inRow(std::initializer_list<Part> parts);
QVBoxLayout* inColumn(std::initializer_list<Part> parts);

} // namespace palp
