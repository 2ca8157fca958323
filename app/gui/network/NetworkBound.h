#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/jobs/NetworkSession.h"
#include "app/study/decoding/NoiseBound.h"

#include <memory>
#include <optional>
#include <vector>

namespace palp {

/// The Cramer-Rao bound at the noise that a network is tested with, next to its errors (NoiseBound.h): of the
/// inputs that it reads, from the loaded samples, computed once for each input, rows and noise.
class NetworkBound : public QObject {
  Q_OBJECT

public:
  explicit NetworkBound(NetworkSession& session, QObject* parent = nullptr);

  /// For this input, these rows and this noise of the test; null where there is no noise, there are no samples of the
  /// design, or it is computed now: then changed() follows. Not a number where it cannot be computed.
  const NoiseBound* of(const NetworkSettings& settings);
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void changed();

private:
  struct Question {
    InputKind input = InputKind::Displacement;
    std::string rows;
    double noise = 0;
    std::optional<NoiseBound> answer{};
  };
  void compute();

  NetworkSession& session_;
  JobRunner runner_;
  std::weak_ptr<const NetworkSamples> samples_; ///< of which the answers are
  std::vector<std::unique_ptr<Question>> questions_;
};

} // namespace palp
