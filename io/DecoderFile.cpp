#include "io/DecoderFile.h"

#include "io/AtomicFile.h"
#include "io/StrictJson.h"
#include "io/decoder/DecoderJson.h"
#include "model/base/Error.h"
#include "model/base/NumberText.h"
#include "nn/NetworkError.h"

#include <cmath>
#include <limits>

namespace palp {
namespace {

constexpr int kNewestNetwork = 1;

/// Throws NetworkError where a number is not finite, which JSON would make null and no reader takes.
void requireFinite(const OrderedJson& json, const std::string& key) {
  if (json.is_number_float() && !std::isfinite(json.get<double>()))
    throw NetworkError("the network's " + key + " is " + text(json.get<double>()) +
                       ", which cannot be written; train with more samples, or a ridge");
  if (json.is_object())
    for (const auto& [part, value] : json.items()) requireFinite(value, key.empty() ? part : key + "." + part);
  if (json.is_array())
    for (const OrderedJson& value : json) requireFinite(value, key);
}

OrderedJson inputJson(const DecoderInput& input) {
  return {{"kind", name(input.kind)},    {"rows", input.rows},
          {"row_wires", input.rowWires}, {"values_per_row", input.valuesPerRow},
          {"low", toJson(input.low)},    {"high", toJson(input.high)}};
}

OrderedJson reportJson(const FitReport& report) {
  return {{"spread", report.spread},
          {"ridge", report.ridge},
          {"centers", report.centers},
          {"condition", std::isfinite(report.condition) ? OrderedJson(report.condition) : OrderedJson()},
          {"rank", report.rank},
          {"largest_weight", report.largestWeight},
          {"leave_one_out_N", toJson(report.leaveOneOut)},
          {"seconds", report.seconds},
          {"warnings", report.warnings}};
}

DecoderInput readInput(const JsonPlace& place) {
  place.onlyKeys({"kind", "rows", "row_wires", "values_per_row", "low", "high"});
  DecoderInput input;
  input.kind = place.at("kind").named(kInputKinds);
  input.rows = readIntegers(place.at("rows"));
  input.rowWires = place.at("row_wires").integer();
  input.valuesPerRow = place.at("values_per_row").integer();
  if (input.rows.empty()) place.at("rows").refuse("one row-wire or more");
  if (input.valuesPerRow < 1) place.at("values_per_row").refuse("1 or more");
  for (const int row : input.rows)
    if (row < 0 || row >= input.rowWires) place.at("rows").refuse("0 to " + std::to_string(input.rowWires - 1));
  input.low = readVector(place.at("low"));
  input.high = readVector(place.at("high"));
  const Eigen::Index inputs = static_cast<Eigen::Index>(input.rows.size()) * input.valuesPerRow;
  requireSize(place.at("low"), input.low.size(), inputs, "numbers, one per input");
  requireSize(place.at("high"), input.high.size(), inputs, "numbers, one per input");
  return input;
}

FitReport readReport(const JsonPlace& place) {
  place.onlyKeys(
      {"spread", "ridge", "centers", "condition", "rank", "largest_weight", "leave_one_out_N", "seconds", "warnings"});
  FitReport report;
  report.spread = place.at("spread").number();
  report.ridge = place.at("ridge").number();
  report.centers = place.at("centers").integer();
  report.condition =
      place.at("condition").isNull() ? std::numeric_limits<double>::infinity() : place.at("condition").number();
  report.rank = place.at("rank").integer();
  report.largestWeight = place.at("largest_weight").number();
  report.leaveOneOut = readVector(place.at("leave_one_out_N"));
  report.seconds = place.at("seconds").number();
  for (const JsonPlace& warning : place.at("warnings").list()) report.warnings.push_back(warning.string());
  return report;
}

DecoderPlace readPlace(const JsonPlace& json) {
  json.onlyKeys({"low_mm", "high_mm", "residual_mm"}, {});
  DecoderPlace place{readVector(json.at("low_mm")), readVector(json.at("high_mm")), readVector(json.at("residual_mm"))};
  for (const auto& [key, values] :
       {std::pair{"low_mm", &place.low_mm}, {"high_mm", &place.high_mm}, {"residual_mm", &place.residual_mm}})
    requireSize(json.at(key), values->size(), 2, "numbers, along x and y");
  return place;
}

OutputCorrection readCorrection(const JsonPlace& json, Eigen::Index outputs) {
  json.onlyKeys({"gains", "offset"}, {});
  OutputCorrection correction{readMatrix(json.at("gains")), readVector(json.at("offset"))};
  requireSize(json.at("gains"), correction.gains.rows(), outputs, "rows, one per output");
  requireSize(json.at("gains"), correction.gains.cols(), outputs, "columns, one per output");
  requireSize(json.at("offset"), correction.offset.size(), outputs, "numbers, one per output");
  return correction;
}

Eigen::Index inputsOf(const Decoder& decoder) {
  return std::visit(
      [](const auto& model) -> Eigen::Index {
        using Model = std::decay_t<decltype(model)>;
        if constexpr (std::is_same_v<Model, ForwardModel> || std::is_same_v<Model, KernelForwardModel>)
          return model.measurements();
        else if constexpr (std::is_same_v<Model, TwoStep>)
          return model.network ? model.network->inputs()
                 : model.block ? model.block->rest_ohm.size()
                               : static_cast<Eigen::Index>(model.rows.size()) * model.design->columnWires();
        else
          return model.inputs();
      },
      decoder.model);
}

constexpr Eigen::Index kTouchOutputs = 5; // force and position

Eigen::Index outputsOf(const Decoder& decoder) {
  return std::visit(
      [](const auto& model) -> Eigen::Index {
        using Model = std::decay_t<decltype(model)>;
        if constexpr (std::is_same_v<Model, KernelForwardModel>)
          return std::min<Eigen::Index>(model.parameters(),
                                        kTouchOutputs); // after them the others: size, friction
        else if constexpr (std::is_same_v<Model, ForwardModel>)
          return model.parameters();
        else if constexpr (std::is_same_v<Model, TwoStep>)
          return model.force.outputs();
        else
          return model.outputs();
      },
      decoder.model);
}

/// The area of each class: one of the design's; -1 alone where all are loaded together.
void requireAreas(const JsonPlace& root, const Decoder& decoder) {
  if (decoder.together && decoder.areas) root.at("areas").refuse("null where all areas are loaded together");
  const ForwardModel* classes = decoder.areas ? &*decoder.areas : std::get_if<ForwardModel>(&decoder.model);
  const JsonPlace areaOfClass = root.at("area_of_class");
  requireSize(areaOfClass, static_cast<Eigen::Index>(decoder.areaOfClass.size()),
              classes ? static_cast<Eigen::Index>(classes->classes()) : 0, "numbers, one per class");
  for (const int area : decoder.areaOfClass) {
    if (decoder.together && area != -1) areaOfClass.refuse("[-1] where all areas are loaded together");
    if (!decoder.together && (area < 0 || area >= decoder.areaCount))
      areaOfClass.refuse("numbers from 0 to " + std::to_string(decoder.areaCount - 1));
  }
  if (decoder.together && decoder.areaOfClass.size() > 1)
    areaOfClass.refuse("[-1] where all areas are loaded together");
}

void requireFitting(const JsonPlace& root, const Decoder& decoder) {
  const Eigen::Index forces = 3 * static_cast<Eigen::Index>(decoder.together ? decoder.areaCount : 1);
  if (decoder.place && (decoder.together || !traits(decoder.kind).givesPosition))
    root.at("place").refuse("no such key, because this decoder gives no position");
  if (!traits(decoder.kind).ofAreas && !decoder.place)
    root.at("model").refuse("a file with \"place\", because this decoder gives a position");
  requireSize(root.at("model"), outputsOf(decoder), forces + (decoder.place ? 2 : 0),
              decoder.together ? "outputs, three per area"
              : decoder.place  ? "outputs, the components of one force and the two of its place"
                               : "outputs, the components of one force");
  const Eigen::Index staged = decoder.measured ? decoder.measured->stage.inputs(decoder.inputs()) : decoder.inputs();
  requireSize(root.at("input"), staged, inputsOf(decoder), "inputs, as in the model");
  requireSize(root.at("low_N"), decoder.low_N.size(), forces, "numbers, one per component of the force");
  requireSize(root.at("high_N"), decoder.high_N.size(), forces, "numbers, one per component of the force");
  requireSize(root.at("residual_N"), decoder.residual_N.rows(), forces, "rows, one per component of the force");
  if (decoder.residual_N.cols() < 1) root.at("residual_N").refuse("one column or more");
  if (decoder.areas) {
    requireSize(root.at("areas"), decoder.areas->measurements(), decoder.inputs(), "measurements, one per input");
    requireSize(root.at("areas"), decoder.areas->parameters(), forces, "causes, one per component of the force");
  }
  requireAreas(root, decoder);
}

} // namespace

std::string networkText(const Decoder& decoder) {
  OrderedJson json = {{"palp_network", kNewestNetwork},
                      {"decoder", name(decoder.kind)},
                      {"mode", name(decoder.mode)},
                      {"trained_with", decoder.trainedWith},
                      {"design_fingerprint", decoder.designFingerprint},
                      {"seed", decoder.seed},
                      {"noise_relative", decoder.noise},
                      {"input", inputJson(decoder.input)},
                      {"area_count", decoder.areaCount},
                      {"together", decoder.together},
                      {"low_N", toJson(decoder.low_N)},
                      {"high_N", toJson(decoder.high_N)},
                      {"residual_N", toJson(decoder.residual_N)},
                      {"fit", reportJson(decoder.report)}};
  if (!decoder.touches.empty()) json["touches"] = decoder.touches;
  if (decoder.place)
    json["place"] = {{"low_mm", toJson(decoder.place->low_mm)},
                     {"high_mm", toJson(decoder.place->high_mm)},
                     {"residual_mm", toJson(decoder.place->residual_mm)}};
  if (decoder.correction)
    json["correction"] = {{"gains", toJson(decoder.correction->gains)}, {"offset", toJson(decoder.correction->offset)}};
  if (decoder.measured) json["measured"] = toJson(*decoder.measured);
  if (decoder.readout) json["readout"] = kReadouts.name(*decoder.readout);
  json["model"] = modelJson(decoder);
  json["area_of_class"] = decoder.areaOfClass;
  json["areas"] = decoder.areas ? toJson(*decoder.areas) : OrderedJson();
  requireFinite(json, "");
  return jsonText(json) + "\n";
}

Decoder parseNetwork(const std::string& text, const std::string& file) {
  const Json json = parseJson(text, file);
  const JsonPlace root(json, file);
  if (!root.has("palp_network")) throw Error(file + ": not a network file of Palp: palp_network is missing");
  formatVersion(root, "palp_network", kNewestNetwork);
  root.onlyKeys({"palp_network", "decoder", "mode", "trained_with", "design_fingerprint", "seed", "noise_relative",
                 "input", "area_count", "together", "low_N", "high_N", "residual_N", "fit", "model", "area_of_class",
                 "areas"},
                {"readout", "touches", "place", "correction", "measured"});
  Decoder decoder;
  decoder.kind = root.at("decoder").named(kDecoderKinds);
  decoder.mode = root.at("mode").named(kDecoderModes);
  decoder.trainedWith = root.at("trained_with").string();
  decoder.designFingerprint = root.at("design_fingerprint").string();
  if (root.has("readout")) decoder.readout = root.at("readout").named(kReadouts);
  const double seed = root.at("seed").number();
  if (!(seed >= 0 && seed <= 9e15 && seed == std::floor(seed))) root.at("seed").refuse("a whole number, 0 or more");
  decoder.seed = static_cast<std::uint64_t>(seed);
  decoder.noise = root.at("noise_relative").number();
  if (!(decoder.noise >= 0 && decoder.noise < 1)) root.at("noise_relative").refuse("0 up to below 1");
  decoder.input = readInput(root.at("input"));
  decoder.areaCount = root.at("area_count").integer();
  if (decoder.areaCount < 1) root.at("area_count").refuse("1 or more");
  decoder.together = root.at("together").boolean();
  decoder.low_N = readVector(root.at("low_N"));
  decoder.high_N = readVector(root.at("high_N"));
  decoder.residual_N = readMatrix(root.at("residual_N"));
  if (root.has("touches")) decoder.touches = root.at("touches").string();
  if (root.has("place")) decoder.place = readPlace(root.at("place"));
  decoder.report = readReport(root.at("fit"));
  readModel(root.at("model"), decoder);
  if (root.has("measured")) {
    if (!std::holds_alternative<RbfNetwork>(decoder.model))
      root.at("measured").refuse("no such key, because this decoder is not a network of measured rows");
    decoder.measured = readMeasured(root.at("measured"), std::get<RbfNetwork>(decoder.model), decoder.inputs());
  }
  decoder.areaOfClass = readIntegers(root.at("area_of_class"));
  if (!root.at("areas").isNull()) decoder.areas = readForwardModel(root.at("areas"));
  requireFitting(root, decoder);
  if (root.has("correction")) {
    if (!keepsCorrection(decoder))
      root.at("correction").refuse("no such key, because this decoder is refined in its model");
    decoder.correction = readCorrection(root.at("correction"), decoder.answers());
  }
  return decoder;
}

Decoder readNetwork(const std::filesystem::path& path) {
  return parseNetwork(readFile(path), path.string());
}

void writeNetwork(const Decoder& decoder, const std::filesystem::path& path, bool force) {
  writeFile(path, networkText(decoder), force);
}

} // namespace palp
