#include "app/gui/widgets/UnclearComma.h"

#include <QObject>
#include <QRegularExpression>

namespace palp {

QString unclearComma(const QString& list) {
  static const QRegularExpression commas(R"((\d+),(?=(\d+)))");
  for (auto found = commas.globalMatch(list); found.hasNext();) {
    const QRegularExpressionMatch comma = found.next();
    const auto isPoint = [&](qsizetype at) { // and not the ".." of a range
      return list.mid(at, 1) == "." && list.mid(at - 1, 1) != "." && list.mid(at + 1, 1) != ".";
    };
    if (isPoint(comma.capturedStart() - 1) || isPoint(comma.capturedEnd(2))) continue;
    return QObject::tr("\"%1,%2\" is unclear: write %1.%2 for one number, or \"%1, %2\" for two")
        .arg(comma.captured(1), comma.captured(2));
  }
  return {};
}

} // namespace palp
