#pragma once

#include "app/gui/JobRunner.h"
#include "app/gui/Project.h"
#include "app/study/Decoder.h"
#include "app/study/StageLog.h"

#include <memory>
#include <mutex>
#include <vector>

namespace palp {

/// Training and test samples of the design, 100 forces an area each unless set otherwise.
struct NetworkSamples {
  SampleSet training;
  SampleSet test;
  double batchError = 0; ///< relative, against full Newton
};

/// A trained decoder and what it says about the test samples.
struct NetworkFit {
  NetworkSettings settings;
  Decoder decoder;
  Prediction prediction;
  DecoderError error;
};

/// One spread of a sweep.
struct SweepPoint {
  double spread = 0;
  PredictionError error;
  FitReport report;
};

/// The samples and networks behind the Network scene: made in the background, only when asked.
class NetworkSession : public QObject {
  Q_OBJECT

public:
  explicit NetworkSession(QObject* parent = nullptr);

  /// Samples of another design are of no use any more: they are dropped.
  void setDesign(const SensorDesign& design);
  void generate(const SampleSettings& samples, const MeshOptions& mesh);
  void train(const NetworkSettings& settings);
  void sweep(const NetworkSettings& settings);
  void cancel() { runner_.cancel(); }
  /// Uses a network from a file on the test samples. Throws Error where it does not fit the samples.
  void use(Decoder decoder);

  [[nodiscard]] const NetworkSamples* samples() const { return samples_.get(); }
  [[nodiscard]] const NetworkFit* fit() const { return fit_.get(); }
  [[nodiscard]] const std::vector<SweepPoint>& sweepPoints() const { return sweep_; }
  [[nodiscard]] const NetworkSettings& sweepSettings() const { return sweepSettings_; }
  [[nodiscard]] const StageLog& stages() const { return stages_; }
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void samplesChanged();
  void fitChanged();
  void sweepChanged();

private:
  /// Rows that the job has finished, drained by the window.
  struct Rows {
    std::mutex mutex;
    std::vector<SweepPoint> points;
  };
  void drainSweep();

  JobRunner runner_;
  SensorDesign design_;
  std::shared_ptr<const NetworkSamples> samples_;
  std::shared_ptr<const NetworkFit> fit_;
  std::vector<SweepPoint> sweep_;
  NetworkSettings sweepSettings_;
  std::shared_ptr<Rows> rows_;
  StageLog stages_;
};

} // namespace palp
