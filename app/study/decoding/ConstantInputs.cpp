#include "app/study/decoding/ConstantInputs.h"

#include "nn/ConstantReadings.h"

namespace palp {

std::string constantInputs(const DecoderInput& input, const Eigen::Ref<const Eigen::MatrixXd>& inputs) {
  ConstantReadings readings;
  readings.add(inputs);
  const bool displacement = input.kind == InputKind::Displacement;
  const auto name = [&](Eigen::Index i) {
    const std::string row = "r" + std::to_string(input.rows.at(static_cast<std::size_t>(i / input.valuesPerRow)));
    const Eigen::Index k = i % input.valuesPerRow;
    return displacement ? "u_" + row + "_e" + std::to_string(k / 3) + "_" + "xyz"[k % 3]
                        : "R_" + row + "_c" + std::to_string(k);
  };
  return readings.inWords(name, displacement ? "mm" : "ohm");
}

} // namespace palp
