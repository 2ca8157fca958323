#include "io/decoder/DecoderJson.h"

namespace palp {

namespace {

OrderedJson memoryJson(const InputStage& stage) {
  OrderedJson json{{"times_s", stage.times_s}, {"of", "readings"}, {"longest_gap_s", stage.longestGap_s}};
  if (stage.rowsAreClock) json["clock"] = "rows";
  if (stage.weights.size() > 0) json["of"] = {{"weights", toJson(stage.weights)}, {"constant", toJson(stage.constant)}};
  return json;
}

void readMemory(const JsonPlace& place, InputStage& stage, Eigen::Index readings) {
  place.onlyKeys({"times_s", "of", "longest_gap_s"}, {"clock"});
  if (place.has("clock")) {
    if (place.at("clock").string() != "rows") place.at("clock").refuse("\"rows\", or no such key for times");
    stage.rowsAreClock = true;
  }
  stage.times_s = place.at("times_s").numbers();
  if (stage.times_s.empty()) place.at("times_s").refuse("one time constant or more");
  for (const double time_s : stage.times_s)
    if (!(time_s > 0)) place.at("times_s").refuse("times above 0");
  stage.longestGap_s = place.at("longest_gap_s").number(0, 1e300);
  const JsonPlace of = place.at("of");
  if (of.isString()) {
    if (of.string() != "readings") of.refuse("\"readings\", or weights and constant");
    return;
  }
  of.onlyKeys({"weights", "constant"});
  stage.weights = readMatrix(of.at("weights"));
  stage.constant = readVector(of.at("constant"));
  requireSize(of.at("weights"), stage.weights.cols(), readings, "columns, one per input");
  requireSize(of.at("constant"), stage.constant.size(), stage.weights.rows(), "entries, one per row of the weights");
}

/// One number for each output.
Eigen::VectorXd readOutputs(const JsonPlace& place, Eigen::Index outputs) {
  Eigen::VectorXd values = readVector(place);
  requireSize(place, values.size(), outputs, "entries, one per output");
  return values;
}

} // namespace

OrderedJson toJson(const MeasuredTraining& measured) {
  OrderedJson validation{{"order", kRowOrders.name(measured.dependence.order)},
                         {"correlation", measured.dependence.correlation},
                         {"leaders", measured.dependence.leaders},
                         {"stated", toJson(measured.stated)},
                         {"stated_relative", measured.relative},
                         {"single_rows", toJson(measured.singleRows)}};
  if (measured.recording) validation["recording"] = toJson(*measured.recording);
  if (measured.relativeRecording) validation["recording_relative"] = *measured.relativeRecording;
  return {{"transform", kReadingTransforms.name(measured.stage.transform)},
          {"memory", measured.stage.hasMemory() ? memoryJson(measured.stage) : OrderedJson()},
          {"validation", validation},
          {"deviation",
           {{"a", toJson(measured.deviation.a)},
            {"b", toJson(measured.deviation.b)},
            {"range", toJson(measured.deviation.range)}}},
          {"outside",
           {{"offset", toJson(measured.ellipse.offset)},
            {"inverse_covariance", toJson(measured.ellipse.inverseCovariance)},
            {"limit", measured.ellipse.limit}}}};
}

MeasuredTraining readMeasured(const JsonPlace& place, const RbfNetwork& network, Eigen::Index readings) {
  place.onlyKeys({"transform", "memory", "validation", "deviation", "outside"});
  MeasuredTraining measured;
  measured.stage.transform = place.at("transform").named(kReadingTransforms);
  if (!place.at("memory").isNull()) readMemory(place.at("memory"), measured.stage, readings);
  const Eigen::Index outputs = network.outputs(), dimensions = network.scaler.dimensions();
  const JsonPlace validation = place.at("validation");
  validation.onlyKeys({"order", "correlation", "leaders", "stated", "stated_relative", "single_rows"},
                      {"recording", "recording_relative"});
  measured.dependence.order = validation.at("order").named(kRowOrders);
  measured.dependence.correlation = validation.at("correlation").number();
  measured.dependence.leaders = validation.at("leaders").number();
  measured.stated = readOutputs(validation.at("stated"), outputs);
  measured.relative = validation.at("stated_relative").number();
  measured.singleRows = readOutputs(validation.at("single_rows"), outputs);
  if (validation.has("recording")) measured.recording = readOutputs(validation.at("recording"), outputs);
  if (validation.has("recording_relative")) measured.relativeRecording = validation.at("recording_relative").number();
  const JsonPlace deviation = place.at("deviation"), outside = place.at("outside");
  deviation.onlyKeys({"a", "b", "range"});
  measured.deviation = {readOutputs(deviation.at("a"), outputs), readOutputs(deviation.at("b"), outputs),
                        readOutputs(deviation.at("range"), outputs)};
  outside.onlyKeys({"offset", "inverse_covariance", "limit"});
  measured.ellipse = {readVector(outside.at("offset")), readMatrix(outside.at("inverse_covariance")),
                      outside.at("limit").number()};
  requireSize(outside.at("offset"), measured.ellipse.offset.size(), dimensions, "entries, one per scaled input");
  requireSize(outside.at("inverse_covariance"), measured.ellipse.inverseCovariance.rows(), dimensions, "rows");
  requireSize(outside.at("inverse_covariance"), measured.ellipse.inverseCovariance.cols(), dimensions, "columns");
  return measured;
}

} // namespace palp
