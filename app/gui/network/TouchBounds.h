#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/jobs/NetworkSession.h"
#include "app/study/reports/map/TouchBound.h"

#include <memory>
#include <optional>
#include <vector>

namespace palp {

/// What no estimate without a bias can beat with the noise that a network of touches is tested with, at each touch of
/// the test: computed once for the loaded samples and a noise (touchBounds), and once for the network that is
/// shown by what it has learned (learnedBounds).
class TouchBounds : public QObject {
  Q_OBJECT

public:
  explicit TouchBounds(NetworkSession& session, QObject* parent = nullptr);

  /// Of the network that is shown. Null where there is no noise of the test, where not all resistances are read, where
  /// the samples are not touches of the design, or while it is computed: then changed() follows. Empty where there is
  /// none.
  const SampleBounds* ofTheShown();
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void changed();

private:
  void compute();
  void computeLearned();

  NetworkSession& session_;
  JobRunner runner_;
  std::weak_ptr<const NetworkSamples> samples_; ///< of which the bounds are
  double noise_ = 0;
  std::weak_ptr<const NetworkFit> fit_; ///< of which `learned` is
  std::optional<SampleBounds> bounds_;  ///< none: on the way
};

} // namespace palp
