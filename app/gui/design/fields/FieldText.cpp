#include "app/gui/design/fields/FieldText.h"

#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/widgets/UnclearComma.h"
#include "model/base/Text.h"

#include <QObject>
#include <QStringList>

#include <cmath>

namespace palp {

namespace {

/// Continues from the last two values in equal steps until `last`, or returns what is wrong.
QString continueEvenly(std::vector<double>& values, double last) {
  constexpr double kMost = 1000;
  if (values.size() < 2)
    return QObject::tr("\"...\" must follow at least two numbers, for example 0.5, 1.5, ..., 29.5");
  const double start = values.back(), step = start - values[values.size() - 2];
  const double steps = (last - start) / step;
  if (!(steps >= 1 - 1e-6 && steps <= kMost) || std::abs(steps - std::round(steps)) > 1e-6)
    return QObject::tr("%1 cannot be reached from %2 in 1 to 1000 equal steps of %3")
        .arg(fieldText(last), fieldText(start), fieldText(step));
  for (int k = 1; k < std::lround(steps); ++k) // 1e-9 mm: 7.333333332 and not ...20000005
    values.push_back(std::round((start + k * step) * 1e9) / 1e9);
  values.push_back(last);
  return {};
}

} // namespace

QString fieldText(double value) {
  return QString::fromStdString(text(value));
}

QString setNumber(double& target, const QString& words) {
  const auto value = typedNumber(words);
  if (!value) return QObject::tr("\"%1\" is not a number; use a decimal point, for example 0.5").arg(words);
  target = *value;
  return {};
}

QString setCount(int& target, const QString& words) {
  bool good = false;
  const int value = words.trimmed().toInt(&good);
  if (!good) return QObject::tr("\"%1\" is not a whole number").arg(words);
  target = value;
  return {};
}

QString setList(std::vector<double>& target, const QString& words) {
  if (const QString unclear = unclearComma(words); !unclear.isEmpty()) return unclear;
  std::vector<double> values;
  bool evenly = false; // after "..."
  for (const QString& word : words.split(',', Qt::SkipEmptyParts)) {
    if (word.trimmed() == "..." && !evenly) {
      evenly = true;
      continue;
    }
    double value = 0;
    if (const QString wrong = setNumber(value, word); !wrong.isEmpty()) return wrong;
    if (!evenly)
      values.push_back(value);
    else if (const QString wrong = continueEvenly(values, value); !wrong.isEmpty())
      return wrong;
    evenly = false;
  }
  if (evenly) return QObject::tr("\"...\" must be followed by the last number, for example 0.5, 1.5, ..., 29.5");
  if (values.empty()) return QObject::tr("the list is empty; enter numbers separated by commas");
  target = values;
  return {};
}

QString listText(const std::vector<double>& values) {
  QStringList texts;
  for (const double value : values) texts << fieldText(value);
  if (values.size() > 4) {
    const QString evenly = texts[0] + ", " + texts[1] + ", ..., " + texts.back();
    std::vector<double> again;
    if (setList(again, evenly).isEmpty() && again == values) return evenly;
  }
  return texts.join(", ");
}

QString listsText(const std::vector<std::vector<double>>& lists) {
  QStringList texts;
  for (const std::vector<double>& list : lists) texts << listText(list);
  return texts.join("; ");
}

QString setLists(std::vector<std::vector<double>>& target, const QString& words) {
  std::vector<std::vector<double>> lists;
  for (const QString& word : words.split(';')) {
    lists.emplace_back();
    if (const QString wrong = setList(lists.back(), word); !wrong.isEmpty()) return wrong;
  }
  target = lists;
  return {};
}

QString setChoice(std::size_t& target, const std::vector<DesignChoice>& choices, const QString& words) {
  for (std::size_t k = 0; k < choices.size(); ++k)
    if (choices[k].words == words) {
      target = k;
      return {};
    }
  return QObject::tr("\"%1\" is not one of the choices").arg(words);
}

} // namespace palp
