#include "nn/NoisyCopies.h"

#include "model/base/Cancelled.h"
#include "nn/linear/RandomNumbers.h"

namespace palp {

Eigen::MatrixXd noisyCopies(const Eigen::Ref<const Eigen::MatrixXd>& samples, double relative, int copies,
                            std::uint64_t seed, const std::stop_token& stop) {
  Eigen::MatrixXd result(samples.rows(), samples.cols() * copies);
  RandomNumbers random(seed ^
                       0x6e6f697365ULL); // "noise": other numbers than those that choose centres with the same seed
  for (Eigen::Index i = 0; i < result.cols(); ++i) {
    throwIfStopped(stop);
    for (Eigen::Index d = 0; d < result.rows(); ++d) {
      const double value = samples(d, i / copies);
      result(d, i) = relative > 0 ? value * (1 + relative * random.normal()) : value;
    }
  }
  return result;
}

} // namespace palp
