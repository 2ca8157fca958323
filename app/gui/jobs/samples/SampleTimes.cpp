#include "app/gui/jobs/samples/SampleTimes.h"

#include "app/gui/project/Command.h"

#include <QSettings>

namespace palp {

namespace {

constexpr const char* kFactors = "sampleTimes/"; ///< of a kind: its last seconds here over those of shipped_s()
constexpr const char* kLast = "sampleTimes/last";

struct Kind {
  QString name;
  double begin_s = 0; ///< whatever the number
  double each_s = 0;  ///< of a sample
  double field_s = 0; ///< of a sample more under the law of the field
};

/// Measured on the paper's design and two cores: palp sample with 5 to 200 samples per area and 20 to 700 touches,
/// twice, for a training and a test; under the field of a surrogate and of touches it is estimated.
Kind kindOf(const SampleSettings& samples) {
  if (!samples.touches) return samples.surrogate ? Kind{"surrogate", 9, 0.0005, 0.005} : Kind{"areas", 5, 0.007, 0.32};
  return samples.touches->mostFriction > 0 ? Kind{"friction", 36, 0.128, 0.5} : Kind{"touches", 17.5, 0.0235, 0.5};
}

double shipped_s(const SampleSettings& samples, const SensorDesign& design) {
  const Kind kind = kindOf(samples);
  const int count = 2 * (samples.touches ? samples.touches->count : samples.perArea * design.areas.count());
  return kind.begin_s + count * (kind.each_s + (design.field() != nullptr ? kind.field_s : 0));
}

QString key(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh) {
  return kFactors + kindOf(samples).name + (design.field() != nullptr ? " field" : "") + meshOption(mesh);
}

} // namespace

std::optional<SampleTime> sampleTime(const SampleSettings& samples, const SensorDesign& design,
                                     const MeshOptions& mesh) {
  const QSettings settings;
  const double own = settings.value(key(samples, design, mesh), 0).toDouble();
  const double last = settings.value(kLast, 1).toDouble();
  if (!(own > 0) && !meshOption(mesh).isEmpty()) return std::nullopt;
  return SampleTime{shipped_s(samples, design) * (own > 0 ? own : last > 0 ? last : 1), own > 0};
}

void rememberSampleTime(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh,
                        double seconds) {
  const double factor = seconds / shipped_s(samples, design);
  QSettings settings;
  settings.setValue(key(samples, design, mesh), factor);
  constexpr double kTelling_s = 20; // of a short one other things take most
  if (meshOption(mesh).isEmpty() && seconds > kTelling_s) settings.setValue(kLast, factor);
}

} // namespace palp
