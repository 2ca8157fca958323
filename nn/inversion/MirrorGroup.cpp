#include "nn/inversion/MirrorGroup.h"

#include "nn/NetworkError.h"

#include <algorithm>
#include <numeric>

namespace palp {

MirrorGroup::MirrorGroup(const std::vector<KernelMirror>& mirrors, Eigen::Index measurements, Eigen::Index parameters)
    : mirrors_(mirrors) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(measurements));
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  order_.push_back(order);
  for (const KernelMirror& mirror : mirrors) {
    const auto& taken = mirror.measurement;
    bool sound = std::is_permutation(taken.begin(), taken.end(), order.begin(), order.end());
    for (std::size_t k = 0; sound && k < taken.size(); ++k)
      sound = taken[static_cast<std::size_t>(taken[k])] == static_cast<Eigen::Index>(k);
    for (const auto& [parameter, about] : mirror.about) sound = sound && parameter >= 0 && parameter < parameters;
    if (!sound) throw NetworkError("a mirror must exchange measurements in pairs, and reflect existing parameters");
    for (std::size_t k = 0, before = order_.size(); k < before; ++k) {
      std::vector<Eigen::Index> both = order_[k];
      for (Eigen::Index& one : both) one = taken[static_cast<std::size_t>(one)];
      order_.push_back(std::move(both));
    }
  }
}

Eigen::MatrixXd MirrorGroup::part(const Eigen::MatrixXd& measurements, int parity) const {
  Eigen::MatrixXd sum = measurements;
  for (int element = 1; element < size(); ++element)
    sum += sign(parity, element) * measurements(order_[static_cast<std::size_t>(element)], Eigen::all);
  return sum / size();
}

Eigen::MatrixXd MirrorGroup::image(Eigen::MatrixXd parameters, int element) const {
  for (std::size_t k = 0; k < mirrors_.size(); ++k)
    if ((static_cast<unsigned>(element) >> k & 1U) != 0)
      for (const auto& [parameter, about] : mirrors_[k].about)
        parameters.row(parameter) = (2 * about - parameters.row(parameter).array()).matrix();
  return parameters;
}

} // namespace palp
