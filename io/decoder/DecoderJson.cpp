#include "io/decoder/DecoderJson.h"

#include "io/DesignFile.h"

#include <cmath>

namespace palp {
namespace {

OrderedJson scalerJson(const FeatureScaler& scaler) {
  OrderedJson json{
      {"scaling", name(scaler.scaling)}, {"offset", toJson(scaler.offset)}, {"factor", toJson(scaler.factor)}};
  if (scaler.rotation.size() > 0) json["rotation"] = toJson(scaler.rotation);
  return json;
}

FeatureScaler readScaler(const JsonPlace& place) {
  place.onlyKeys({"scaling", "offset", "factor"}, {"rotation"});
  FeatureScaler scaler;
  scaler.scaling = place.at("scaling").named(kScalings);
  scaler.offset = readVector(place.at("offset"));
  scaler.factor = readVector(place.at("factor"));
  requireSize(place.at("factor"), scaler.factor.size(), scaler.offset.size(), "entries, as offset has");
  if (!place.has("rotation")) return scaler;
  scaler.rotation = readMatrix(place.at("rotation"));
  requireSize(place.at("rotation"), scaler.rotation.cols(), scaler.offset.size(), "columns, as offset has");
  return scaler;
}

double readPositive(const JsonPlace& place) {
  const double value = place.number();
  if (!(value > 0)) place.refuse("a number above 0");
  return value;
}

} // namespace

void requireSize(const JsonPlace& place, Eigen::Index size, Eigen::Index wanted, const std::string& what) {
  if (size != wanted) place.refuse(std::to_string(wanted) + " " + what + " instead of " + std::to_string(size));
}

OrderedJson toJson(const Eigen::VectorXd& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

OrderedJson toJson(const Eigen::MatrixXd& matrix) {
  return {{"rows", matrix.rows()},
          {"columns", matrix.cols()},
          {"values", std::vector<double>(matrix.data(), matrix.data() + matrix.size())}};
}

OrderedJson toJson(const ForwardModel& model) {
  OrderedJson coefficients = OrderedJson::array();
  for (const Eigen::MatrixXd& matrix : model.coefficients) coefficients.push_back(toJson(matrix));
  return {{"degree", model.degree},
          {"cause_offset", toJson(model.parameterOffset)},
          {"cause_factor", toJson(model.parameterFactor)},
          {"deviation", toJson(model.deviation)},
          {"coefficients", coefficients}};
}

Eigen::VectorXd readVector(const JsonPlace& place) {
  const std::vector<double> values = place.numbers();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd readMatrix(const JsonPlace& place) {
  place.onlyKeys({"rows", "columns", "values"});
  const int rows = place.at("rows").integer(), columns = place.at("columns").integer();
  if (rows < 0) place.at("rows").refuse("0 or more");
  if (columns < 0) place.at("columns").refuse("0 or more");
  const Eigen::VectorXd values = readVector(place.at("values"));
  requireSize(place.at("values"), values.size(), static_cast<Eigen::Index>(rows) * columns,
              "numbers (rows times columns)");
  return values.reshaped(rows, columns);
}

std::vector<int> readIntegers(const JsonPlace& place) {
  std::vector<int> values;
  for (const JsonPlace& entry : place.list()) values.push_back(entry.integer());
  return values;
}

OrderedJson toJson(const RbfNetwork& network) {
  return {{"scaler", scalerJson(network.scaler)},
          {"spread", network.spread},
          {"spread_convention", name(network.convention)},
          {"basis", name(network.form)},
          {"centers", toJson(network.centers)},
          {"weights", toJson(network.weights)},
          {"tail", network.tail.size() == 0 ? OrderedJson() : toJson(network.tail)},
          {"bias", toJson(network.bias)}};
}

RbfNetwork readRbf(const JsonPlace& place) {
  place.onlyKeys({"scaler", "spread", "spread_convention", "basis", "centers", "weights", "tail", "bias"});
  RbfNetwork network;
  network.scaler = readScaler(place.at("scaler"));
  network.spread = readPositive(place.at("spread"));
  network.convention = place.at("spread_convention").named(kSpreadConventions);
  network.form = place.at("basis").named(kBasisForms);
  network.centers = readMatrix(place.at("centers"));
  network.weights = readMatrix(place.at("weights"));
  if (!place.at("tail").isNull()) network.tail = readMatrix(place.at("tail"));
  network.bias = readVector(place.at("bias"));
  requireSize(place.at("centers"), network.centers.rows(), network.scaler.dimensions(), "rows, one per scaled input");
  requireSize(place.at("weights"), network.weights.cols(), network.centers.cols(), "columns, one per centre");
  requireSize(place.at("bias"), network.bias.size(), network.outputs(), "entries, one per output");
  if (network.tail.size() > 0) {
    requireSize(place.at("tail"), network.tail.rows(), network.outputs(), "rows, one per output");
    requireSize(place.at("tail"), network.tail.cols(), network.scaler.dimensions(), "columns, one per scaled input");
  }
  return network;
}

ForwardModel readForwardModel(const JsonPlace& place) {
  place.onlyKeys({"degree", "cause_offset", "cause_factor", "deviation", "coefficients"});
  ForwardModel model;
  model.degree = place.at("degree").integer();
  if (model.degree < 0 || model.degree > 6) place.at("degree").refuse("0 to 6");
  model.parameterOffset = readVector(place.at("cause_offset"));
  model.parameterFactor = readVector(place.at("cause_factor"));
  model.deviation = readVector(place.at("deviation"));
  if (model.parameters() < 1) place.at("cause_offset").refuse("one number or more");
  if (!(model.deviation.array() > 0).all()) place.at("deviation").refuse("numbers above 0");
  requireSize(place.at("cause_factor"), model.parameterFactor.size(), model.parameters(), "entries, one per parameter");
  const Eigen::Index monomials = monomialCount(model.parameters(), model.degree);
  for (const JsonPlace& entry : place.at("coefficients").list()) {
    model.coefficients.push_back(readMatrix(entry));
    requireSize(entry, model.coefficients.back().rows(), model.measurements(), "rows, one per measurement");
    requireSize(entry, model.coefficients.back().cols(), monomials, "columns, one per monomial");
  }
  if (model.coefficients.empty()) place.at("coefficients").refuse("one matrix or more");
  return model;
}

namespace {

OrderedJson jsonOf(const RbfNetwork& network) {
  return toJson(network);
}

OrderedJson jsonOf(const PolynomialRidge& model) {
  return {{"degree", model.degree},
          {"scaler", scalerJson(model.scaler)},
          {"size", model.size},
          {"centers", model.degree == 1 ? OrderedJson() : toJson(model.centers)},
          {"weights", toJson(model.weights)},
          {"bias", toJson(model.bias)}};
}

OrderedJson jsonOf(const GaussianProcess& process) {
  return {{"mean", toJson(process.mean)},
          {"output_variance", toJson(process.outputVariance)},
          {"linear_variance", process.linearVariance},
          {"noise_variance", process.noiseVariance},
          {"factor", toJson(process.factor)}};
}

OrderedJson jsonOf(const BackPropagationNetwork& network) {
  return {{"input_scaler", scalerJson(network.inputScaler)}, {"output_scaler", scalerJson(network.outputScaler)},
          {"components", toJson(network.components)},        {"hidden_weights", toJson(network.hiddenWeights)},
          {"hidden_bias", toJson(network.hiddenBias)},       {"output_weights", toJson(network.outputWeights)},
          {"output_bias", toJson(network.outputBias)}};
}

OrderedJson jsonOf(const TwoStep& decoder) {
  OrderedJson json{{"network", decoder.network ? jsonOf(*decoder.network) : OrderedJson()},
                   {"design", decoder.design ? OrderedJson::parse(toJson(*decoder.design)) : OrderedJson()},
                   {"rows", decoder.rows},
                   {"force", toJson(decoder.force)}};
  if (decoder.block)
    json["block"] = {{"rest_ohm", toJson(decoder.block->rest_ohm)},
                     {"forces_N", toJson(decoder.block->forces_N)},
                     {"modes_mm_per_N", toJson(decoder.block->modes_mm_per_N)}};
  return json;
}

OrderedJson jsonOf(const ForwardModel& model) {
  return toJson(model);
}

OrderedJson jsonOf(const KernelForwardModel& model) {
  return toJson(model);
}

PolynomialRidge readPolynomial(const JsonPlace& place) {
  place.onlyKeys({"degree", "scaler", "size", "centers", "weights", "bias"});
  PolynomialRidge model;
  model.degree = place.at("degree").integer();
  if (model.degree < 1 || model.degree > 5) place.at("degree").refuse("1 to 5");
  model.scaler = readScaler(place.at("scaler"));
  model.size = readPositive(place.at("size"));
  model.weights = readMatrix(place.at("weights"));
  model.bias = readVector(place.at("bias"));
  if (model.degree > 1) {
    model.centers = readMatrix(place.at("centers"));
    requireSize(place.at("centers"), model.centers.rows(), model.scaler.dimensions(), "rows, one per scaled input");
  }
  requireSize(place.at("weights"), model.weights.cols(),
              model.degree == 1 ? model.scaler.dimensions() : model.centers.cols(),
              model.degree == 1 ? "columns, one per scaled input" : "columns, one per centre");
  requireSize(place.at("weights"), model.weights.rows(), model.bias.size(), "rows, one per output");
  return model;
}

GaussianProcess readGaussianProcess(const JsonPlace& place) {
  place.onlyKeys({"mean", "output_variance", "linear_variance", "noise_variance", "factor"});
  GaussianProcess process;
  process.mean = readRbf(place.at("mean"));
  process.outputVariance = readVector(place.at("output_variance"));
  process.linearVariance = place.at("linear_variance").number();
  process.noiseVariance = place.at("noise_variance").number();
  process.factor = readMatrix(place.at("factor"));
  const Eigen::Index centers = process.mean.centers.cols();
  requireSize(place.at("output_variance"), process.outputVariance.size(), process.outputs(), "entries, one per output");
  requireSize(place.at("factor"), process.factor.rows(), centers, "rows, one per centre");
  requireSize(place.at("factor"), process.factor.cols(), centers, "columns, one per centre");
  return process;
}

BackPropagationNetwork readBackPropagation(const JsonPlace& place) {
  place.onlyKeys({"input_scaler", "output_scaler", "components", "hidden_weights", "hidden_bias", "output_weights",
                  "output_bias"});
  BackPropagationNetwork network;
  network.inputScaler = readScaler(place.at("input_scaler"));
  network.outputScaler = readScaler(place.at("output_scaler"));
  network.components = readMatrix(place.at("components"));
  network.hiddenWeights = readMatrix(place.at("hidden_weights"));
  network.hiddenBias = readVector(place.at("hidden_bias"));
  network.outputWeights = readMatrix(place.at("output_weights"));
  network.outputBias = readVector(place.at("output_bias"));
  const Eigen::Index hidden = network.hiddenBias.size(), outputs = network.outputBias.size();
  if (network.outputScaler.rotation.size() > 0)
    place.at("output_scaler").refuse("a scaler without rotation, which can be inverted");
  requireSize(place.at("components"), network.components.cols(), network.inputScaler.dimensions(),
              "columns, one per scaled input");
  requireSize(place.at("hidden_weights"), network.hiddenWeights.cols(), network.components.rows(),
              "columns, one per component");
  requireSize(place.at("hidden_weights"), network.hiddenWeights.rows(), hidden, "rows, one per hidden unit");
  requireSize(place.at("output_weights"), network.outputWeights.cols(), hidden, "columns, one per hidden unit");
  requireSize(place.at("output_weights"), network.outputWeights.rows(), outputs, "rows, one per output");
  requireSize(place.at("output_scaler"), network.outputScaler.offset.size(), outputs, "entries, one per output");
  return network;
}

BlockInversion readBlockInversion(const JsonPlace& place) {
  place.onlyKeys({"rest_ohm", "forces_N", "modes_mm_per_N"});
  BlockInversion block;
  block.rest_ohm = readVector(place.at("rest_ohm"));
  if (block.rest_ohm.size() == 0 || !(block.rest_ohm.array() > 0).all())
    place.at("rest_ohm").refuse("resistances above 0, one or more");
  block.forces_N = readMatrix(place.at("forces_N"));
  requireSize(place.at("forces_N"), block.forces_N.cols(), block.rest_ohm.size(), "columns, as rest_ohm has entries");
  block.modes_mm_per_N = readMatrix(place.at("modes_mm_per_N"));
  requireSize(place.at("modes_mm_per_N"), block.modes_mm_per_N.cols(), block.forces_N.rows(),
              "columns, as forces_N has rows");
  return block;
}

TwoStep readTwoStep(const JsonPlace& place) {
  place.onlyKeys({"network", "design", "rows", "force"}, {"block"});
  TwoStep decoder;
  if (!place.at("network").isNull()) decoder.network = readBackPropagation(place.at("network"));
  if (!place.at("design").isNull()) {
    decoder.design = readDesign(place.at("design"));
    requireValid(*decoder.design);
    requirePairs(*decoder.design, "the inversion of Eq. (1)");
  }
  if (place.has("block")) decoder.block = readBlockInversion(place.at("block"));
  if (int(decoder.network.has_value()) + int(decoder.design.has_value()) + int(decoder.block.has_value()) != 1)
    place.refuse("an object with one of network, design and block; network and design null if unused");
  decoder.rows = readIntegers(place.at("rows"));
  decoder.force = readRbf(place.at("force"));
  if (decoder.network)
    requireSize(place.at("force"), decoder.force.inputs(), decoder.network->outputs(), "inputs, the outputs of step 1");
  if (decoder.block)
    requireSize(place.at("force"), decoder.force.inputs(), decoder.block->modes_mm_per_N.rows(),
                "inputs, the outputs of step 1");
  if (decoder.design) {
    for (const int row : decoder.rows)
      if (row < 0 || row >= decoder.design->rowWires())
        place.at("rows").refuse("0 to " + std::to_string(decoder.design->rowWires() - 1));
    requireSize(place.at("force"), decoder.force.inputs(),
                static_cast<Eigen::Index>(decoder.rows.size()) * 3 * decoder.design->electrodesPerRowWire(),
                "inputs, the outputs of step 1");
  }
  return decoder;
}

} // namespace

OrderedJson modelJson(const Decoder& decoder) {
  return std::visit([](const auto& model) { return jsonOf(model); }, decoder.model);
}

void readModel(const JsonPlace& place, Decoder& decoder) {
  switch (decoder.kind) {
  case DecoderKind::Rbf:
    decoder.model = readRbf(place);
    return;
  case DecoderKind::Linear:
  case DecoderKind::Polynomial2:
  case DecoderKind::Polynomial3:
    decoder.model = readPolynomial(place);
    return;
  case DecoderKind::GaussianProcess:
    decoder.model = readGaussianProcess(place);
    return;
  case DecoderKind::BackPropagation:
    decoder.model = readBackPropagation(place);
    return;
  case DecoderKind::TwoStepBackPropagation:
  case DecoderKind::TwoStepGaussNewton:
    decoder.model = readTwoStep(place);
    return;
  case DecoderKind::MaximumLikelihood:
    decoder.model = readForwardModel(place);
    return;
  case DecoderKind::TouchInversion:
    decoder.model = readKernelForwardModel(place);
    return;
  }
}

} // namespace palp
