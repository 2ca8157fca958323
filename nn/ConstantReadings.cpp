#include "nn/ConstantReadings.h"

#include "model/base/Text.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kConstantTo = 1e-14; // of the value: the rest is rounding
constexpr Eigen::Index kFewestSamples = 3;
constexpr std::size_t kMostNamed = 5;

} // namespace

void ConstantReadings::add(const Eigen::Ref<const Eigen::MatrixXd>& readings) {
  if (readings.cols() == 0) return;
  const Eigen::VectorXd low = readings.rowwise().minCoeff(), high = readings.rowwise().maxCoeff();
  low_ = samples_ == 0 ? low : low_.cwiseMin(low).eval();
  high_ = samples_ == 0 ? high : high_.cwiseMax(high).eval();
  samples_ += readings.cols();
}

std::vector<Eigen::Index> ConstantReadings::constant() const {
  std::vector<Eigen::Index> found;
  for (Eigen::Index i = 0; i < low_.size(); ++i)
    if (!(high_(i) - low_(i) > kConstantTo * std::max(std::abs(low_(i)), std::abs(high_(i))))) found.push_back(i);
  return found;
}

std::string ConstantReadings::inWords(const std::function<std::string(Eigen::Index)>& name,
                                      const std::string& unit) const {
  const std::vector<Eigen::Index> found = constant();
  if (found.empty() || samples_ < kFewestSamples) return {};
  std::string words = found.size() == 1 ? "reading " : std::to_string(found.size()) + " readings: ";
  for (std::size_t k = 0; k < std::min(kMostNamed, found.size()); ++k)
    words += (k > 0 ? ", " : "") + name(found[k]) + " (" + text(low_(found[k])) + " " + unit + ")";
  if (found.size() > kMostNamed) words += ", ...";
  return words + (found.size() == 1 ? " has" : " have") + " the same value in all " + std::to_string(samples_) +
         " samples; check for a broken wire or a dead channel";
}

} // namespace palp
