#include "app/gui/project/changes/NetworkChange.h"

#include "model/base/NumberText.h"

#include <QObject>

namespace palp {

namespace {

constexpr int kLongest = 28; ///< characters of a value

QString shortened(const QString& value) {
  return value.size() <= kLongest ? value : value.left(kLongest - 3) + "...";
}

QString networkNumber(double value) {
  return QString::number(value, 'g', 6);
}

/// Gathers the sentences of what differs.
class Steps {
public:
  template <class Value, class Words>
  void add(const QString& name, const Value& from, const Value& to, const Words& words, const QString& unit = {}) {
    if (from != to) all_ << stepWords(name, words(from), words(to), unit);
  }
  [[nodiscard]] QStringList all() const { return all_; }

private:
  QStringList all_;
};

QString percentOf(double share) {
  return networkNumber(100 * share) + " %";
}

QString onOff(bool value) {
  return value ? QObject::tr("yes") : QObject::tr("no");
}

QString whole(std::uint64_t value) {
  return QString::number(value);
}

QString asIs(const QString& words) {
  return words;
}

QString spreadWords(const NetworkSettings& network) {
  return network.automaticSpread ? QObject::tr("by leave-one-out") : networkNumber(network.chosenSpread);
}

QString sweepWords(const NetworkSettings& network) {
  return QObject::tr("%1 to %2, %3")
      .arg(networkNumber(network.sweepFrom), networkNumber(network.sweepTo))
      .arg(network.sweepCount);
}

} // namespace

QString optionWords(const TrainOption& option, const TrainOptions& options) {
  const std::string text = option.text(options);
  if (text.empty()) return QObject::tr("from mode");
  return option.form == TrainOption::Form::Share ? percentOf(numberIn(text).value()) : QString::fromStdString(text);
}

QString stepWords(const QString& name, const QString& from, const QString& to, const QString& unit) {
  const QString words = QString("%1 %2 -> %3").arg(name, shortened(from), shortened(to));
  return unit.isEmpty() ? words : words + " " + unit;
}

QStringList networkChanges(const NetworkSettings& before, const NetworkSettings& after) {
  Steps steps;
  for (const TrainOption& option : trainOptionTable())
    steps.add(QString::fromStdString(option.label), optionWords(option, before), optionWords(option, after), asIs);
  steps.add(QObject::tr("spread"), spreadWords(before), spreadWords(after), asIs);
  steps.add(QObject::tr("test noise"), before.testNoise, after.testNoise, percentOf);
  steps.add(QObject::tr("sweep"), sweepWords(before), sweepWords(after), asIs);
  return steps.all();
}

QStringList sampleChanges(const SampleSettings& before, const SampleSettings& after) {
  Steps steps;
  steps.add(QObject::tr("samples per area"), before.perArea, after.perArea,
            [](int its) { return QString::number(its); });
  steps.add(QObject::tr("seed of the samples"), before.seed, after.seed, whole);
  steps.add(QObject::tr("samples with a surrogate model:"), before.surrogate, after.surrogate, onOff);
  if (before.touches && after.touches) {
    TouchSampling rest = *before.touches;
    rest.count = after.touches->count;
    steps.add(QObject::tr("touches"), before.touches->count, after.touches->count,
              [](int its) { return QString::number(its); });
    return rest == *after.touches ? steps.all() : steps.all() << QString();
  }
  return before.touches || after.touches ? steps.all() << QString() : steps.all();
}

} // namespace palp
