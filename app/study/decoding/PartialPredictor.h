#pragma once

#include "app/study/decoding/FewerReadings.h"
#include "app/study/decoding/Prediction.h"

#include <map>
#include <memory>

namespace palp {

/// Decodes where some readings are missing: a decoder by inversion inverts its model for the others, any other decoder
/// gets the missing ones from its model of the areas under the most likely touch of the others. The deviations are
/// wider by the information of the missing readings. Keeps what many calls share.
class PartialPredictor {
public:
  /// The decoder must outlive it; whyNotFewer(decoder) is empty.
  explicit PartialPredictor(const Decoder& decoder, const PredictOptions& options = {});
  ~PartialPredictor();
  PartialPredictor(const PartialPredictor&) = delete;
  PartialPredictor& operator=(const PartialPredictor&) = delete;

  /// One sample; values at missing readings are finite, and not used.
  [[nodiscard]] Prediction operator()(const Eigen::Ref<const Eigen::VectorXd>& input, const PresentReadings& readings);

private:
  struct Way;
  Way& wayFor(const PresentReadings& readings);
  [[nodiscard]] Prediction decode(const Way& way, const Eigen::Ref<const Eigen::VectorXd>& input,
                                  const PresentReadings& readings) const;

  const Decoder& decoder_;
  PredictOptions options_;
  std::optional<Predictor> whole_;                ///< of decoders that want all inputs
  std::optional<ForwardModel> areas_;             ///< theirs, with the noise
  std::optional<KernelForwardModel> touches_;     ///< of a decoder of touches, with the noise
  std::optional<KernelInversion> touchInversion_; ///< of the same
  std::map<std::vector<Eigen::Index>, Way> ways_; ///< by what is missing
};

} // namespace palp
