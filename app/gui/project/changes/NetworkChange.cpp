#include "app/gui/project/changes/NetworkChange.h"

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

QString text(const std::string& value) {
  return QString::fromStdString(value);
}

/// Gathers the sentences of what differs.
class Steps {
public:
  template <class Value, class Words>
  void add(const QString& name, const Value& from, const Value& to, const Words& words, const QString& unit = {}) {
    if (from != to) all_ << stepWords(name, words(from), words(to), unit);
  }
  /// `names`: a NamedEnum; none where the mode decides.
  template <class Value, class Names>
  void addChoice(const QString& name, const std::optional<Value>& from, const std::optional<Value>& to,
                 const Names& names) {
    add(name, from, to,
        [&](const auto& its) { return its ? text(names.name(*its)) : QObject::tr("as the mode says"); });
  }
  [[nodiscard]] QStringList all() const { return all_; }

private:
  QStringList all_;
};

QString onOff(bool value) {
  return value ? QObject::tr("yes") : QObject::tr("no");
}

QString whole(std::uint64_t value) {
  return QString::number(value);
}

QString spreadWords(const NetworkSettings& network) {
  return network.automaticSpread ? QObject::tr("by leave-one-out") : networkNumber(network.spread);
}

QString sweepWords(const NetworkSettings& network) {
  return QObject::tr("%1 to %2, %3")
      .arg(networkNumber(network.sweepFrom), networkNumber(network.sweepTo))
      .arg(network.sweepCount);
}

} // namespace

QString stepWords(const QString& name, const QString& from, const QString& to, const QString& unit) {
  const QString words = QString("%1 %2 -> %3").arg(name, shortened(from), shortened(to));
  return unit.isEmpty() ? words : words + " " + unit;
}

QStringList networkChanges(const NetworkSettings& before, const NetworkSettings& after) {
  Steps steps;
  const auto percent = [](double share) { return networkNumber(100 * share); };
  steps.add(QObject::tr("network's input"), before.input, after.input, [](InputKind its) {
    return its == InputKind::Displacement ? QObject::tr("displacements") : QObject::tr("resistances");
  });
  steps.add(QObject::tr("mode"), before.mode, after.mode, [](DecoderMode its) { return text(name(its)); });
  steps.add(QObject::tr("decoder"), before.decoder, after.decoder, [](DecoderKind its) { return text(name(its)); });
  steps.add(QObject::tr("learns"), before.target, after.target, [](DecoderTarget its) {
    return its == DecoderTarget::Force ? QObject::tr("the force") : QObject::tr("force and place");
  });
  steps.add(QObject::tr("row-wires"), before.rows, after.rows, [](const std::string& its) { return text(its); });
  steps.add(QObject::tr("spread"), spreadWords(before), spreadWords(after), [](const QString& its) { return its; });
  steps.add(QObject::tr("centres"), before.centers, after.centers,
            [](int its) { return its > 0 ? QString::number(its) : QObject::tr("as the mode says"); });
  steps.add(QObject::tr("noise of the training"), before.noise, after.noise, percent, "%");
  steps.add(QObject::tr("noise of the test"), before.testNoise, after.testNoise, percent, "%");
  steps.addChoice(QObject::tr("centres by"), before.centerChoice, after.centerChoice, kCenterChoices);
  steps.add(QObject::tr("a centre on every sample:"), before.allCenters, after.allCenters, onOff);
  steps.addChoice(QObject::tr("solver"), before.solver, after.solver, kLeastSquaresMethods);
  steps.add(QObject::tr("ridge"), before.ridge, after.ridge, [](const std::optional<double>& its) {
    return its ? networkNumber(*its) : QObject::tr("as the mode says");
  });
  steps.addChoice(QObject::tr("scaler"), before.scaling, after.scaling, kScalings);
  steps.addChoice(QObject::tr("tail"), before.tail, after.tail, kTails);
  steps.addChoice(QObject::tr("convention"), before.convention, after.convention, kSpreadConventions);
  steps.add(QObject::tr("forgetting"), before.forgetting, after.forgetting, networkNumber);
  steps.add(QObject::tr("seed of the training"), before.seed, after.seed, whole);
  steps.add(QObject::tr("sweep"), sweepWords(before), sweepWords(after), [](const QString& its) { return its; });
  return steps.all();
}

QStringList sampleChanges(const SampleSettings& before, const SampleSettings& after) {
  Steps steps;
  steps.add(QObject::tr("samples an area"), before.perArea, after.perArea,
            [](int its) { return QString::number(its); });
  steps.add(QObject::tr("seed of the samples"), before.seed, after.seed, whole);
  steps.add(QObject::tr("samples by a surrogate:"), before.surrogate, after.surrogate, onOff);
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
