// Fuzzing: any text as a network file. It is refused in a sentence, or read; what was read writes and reads the same,
// and predicts on inputs of its size without a crash (with a sentence where its design cannot be inverted).

#include "app/study/decoding/Prediction.h"
#include "io/DecoderFile.h"
#include "model/base/Error.h"
#include "nn/NetworkError.h"

#include <cstdlib>

namespace {

void use(const palp::Decoder& decoder) {
  Eigen::MatrixXd inputs(decoder.inputs(), 3);
  inputs << decoder.input.low, decoder.input.high, Eigen::VectorXd::Ones(decoder.inputs());
  palp::PredictOptions noisy;
  noisy.noise = 0.01;
  for (const palp::PredictOptions& options : {palp::PredictOptions{}, noisy}) {
    const palp::Prediction prediction = palp::predict(decoder, inputs, options);
    if (prediction.forces_N.rows() != decoder.outputs() || prediction.forces_N.cols() != inputs.cols()) std::abort();
    if (prediction.standardDeviation_N.rows() != decoder.outputs()) std::abort();
    if (prediction.area.size() > 0 &&
        (prediction.area.minCoeff() < 0 || prediction.area.maxCoeff() >= decoder.areaCount))
      std::abort();
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const palp::Decoder decoder = palp::parseNetwork(std::string(reinterpret_cast<const char*>(data), size), "fuzz");
    const std::string text = palp::networkText(decoder);
    if (palp::networkText(palp::parseNetwork(text, "fuzz")) != text) std::abort();
    try {
      use(decoder);
    } catch (const palp::NetworkError&) { // sizes that do not fit together are for the reader to refuse
      std::abort();
    }
  } catch (const palp::Error&) { // a refusal is an answer
  }
  return 0;
}
