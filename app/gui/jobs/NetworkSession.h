#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Project.h"
#include "app/study/StageLog.h"
#include "app/study/decoding/Prediction.h"

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

namespace palp {

/// Training and test samples of the design, 100 forces an area each unless set otherwise.
struct NetworkSamples {
  SampleSet training;
  SampleSet test;
  double batchError = 0; ///< relative, against full Newton
  SampleSettings settings;
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

/// One kind of decoder, trained on the same samples as the others.
struct DecoderTrial {
  DecoderKind kind = DecoderKind::Rbf;
  PredictionError error;
  double seconds = 0; ///< of the training
  double microsecondsPerSample = 0;
  QString refusal; ///< why it cannot be trained; empty where it was
};

/// The samples and networks behind the Network scene: made in the background, only when asked.
class NetworkSession : public QObject {
  Q_OBJECT

public:
  explicit NetworkSession(QObject* parent = nullptr);
  ~NetworkSession() override;

  /// Samples of another design are of no use any more: they are dropped.
  void setDesign(const SensorDesign& design);
  /// Goes on where the same samples were stopped before.
  void generate(const SampleSettings& samples, const MeshOptions& mesh);
  void train(const NetworkSettings& settings);
  void sweep(const NetworkSettings& settings);
  /// Trains every kind of decoder with the same input, rows and noise.
  void compare(const NetworkSettings& settings);
  void cancel() { runner_.cancel(); }
  /// Tries a network from a file on the test samples; the job fails where it cannot be read or does not fit them.
  /// Throws Error where there are no samples.
  void open(const std::filesystem::path& file);

  [[nodiscard]] const NetworkSamples* samples() const { return samples_.get(); }
  /// The same, for a job that outlives them.
  [[nodiscard]] std::shared_ptr<const NetworkSamples> sharedSamples() const { return samples_; }
  [[nodiscard]] const NetworkFit* fit() const { return fit_.get(); }
  [[nodiscard]] const std::vector<SweepPoint>& sweepPoints() const { return sweep_; }
  [[nodiscard]] const NetworkSettings& sweepSettings() const { return sweepSettings_; }
  [[nodiscard]] const std::vector<DecoderTrial>& trials() const { return trials_; }
  /// The input that the trials read.
  [[nodiscard]] InputKind trialsInput() const { return trialsInput_; }
  /// Samples of a generation that was stopped, of how many; {0, 0} where there is none.
  [[nodiscard]] std::array<std::size_t, 2> stoppedAt() const;
  [[nodiscard]] const StageLog& stages() const { return stages_; }
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void samplesChanged();
  void fitChanged();
  void sweepChanged();
  void trialsChanged();

private:
  /// What the job has finished, drained by the window.
  struct Rows {
    std::mutex mutex;
    std::vector<SweepPoint> points;
    std::vector<DecoderTrial> trials;
  };
  /// Samples on the way; written by the job alone while it runs.
  struct Generation;
  void drain();
  void dropResults();

  JobRunner runner_;
  SensorDesign design_;
  std::shared_ptr<const NetworkSamples> samples_;
  std::shared_ptr<const NetworkFit> fit_;
  std::vector<SweepPoint> sweep_;
  NetworkSettings sweepSettings_;
  std::vector<DecoderTrial> trials_;
  InputKind trialsInput_ = InputKind::Displacement;
  std::shared_ptr<Generation> generation_;
  std::shared_ptr<Rows> rows_;
  StageLog stages_;
};

} // namespace palp
