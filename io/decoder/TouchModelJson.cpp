#include "io/decoder/DecoderJson.h"

#include "io/samples/ShuffledDeflate.h"
#include "model/base/Base64.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace palp {

namespace {

constexpr int kMostTableNodes = 1000, kMostExponent = 12;
constexpr std::size_t kMostDeflated = 1100; // largest ratio of inflated to deflated bytes

/// What the coefficients are packed along: from one node to the next along the first place, and along the second. They
/// are smooth, so the mixed difference is small.
std::array<std::size_t, 2> stridesOf(const SplineTable& table) {
  const auto one = static_cast<std::size_t>(table.outputs() * table.terms());
  return {one, one * static_cast<std::size_t>(table.nodes[0])};
}

/// The coefficients as integers, in mixed differences, deflated; null where they are not integers (older files).
OrderedJson packedCoefficients(const SplineTable& table) {
  std::vector<std::uint32_t> parts;
  parts.reserve(static_cast<std::size_t>(table.coefficients.size()));
  for (const double value : table.coefficients.reshaped()) {
    const double part = std::round(SplineTable::kParts * value);
    if (!(std::abs(part) < std::numeric_limits<std::int32_t>::max()) || part / SplineTable::kParts != value) return {};
    parts.push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(part)));
  }
  for (const std::size_t stride : stridesOf(table))
    for (std::size_t i = parts.size(); i-- > stride;) parts[i] -= parts[i - stride];
  for (std::uint32_t& part : parts) part = part << 1U ^ (part >> 31U ? ~0U : 0U); // small ones of both signs alike
  std::vector<unsigned char> bytes(parts.size() * sizeof(std::uint32_t));
  if (!bytes.empty()) std::memcpy(bytes.data(), parts.data(), bytes.size());
  return base64(shuffledDeflate(bytes, sizeof(std::uint32_t)));
}

/// As `packedCoefficients` wrote them.
Eigen::MatrixXd readPacked(const JsonPlace& place, const SplineTable& table) {
  const Eigen::Index columns = table.terms() * Eigen::Index(table.nodes[0]) * Eigen::Index(table.nodes[1]);
  const std::size_t count = static_cast<std::size_t>(table.outputs()) * static_cast<std::size_t>(columns);
  const auto packed = fromBase64(place.string());
  if (!packed || packed->size() * kMostDeflated < count * sizeof(std::uint32_t))
    place.refuse("base64 with as many numbers as the table has");
  std::vector<unsigned char> bytes(count * sizeof(std::uint32_t));
  if (!ShuffledInflate().inflate(*packed, sizeof(std::uint32_t), bytes))
    place.refuse("an undamaged zlib stream with as many numbers as the table has");
  std::vector<std::uint32_t> parts(count);
  std::memcpy(parts.data(), bytes.data(), bytes.size());
  for (std::uint32_t& part : parts) part = part >> 1U ^ (part & 1U ? ~0U : 0U);
  for (const std::size_t stride : stridesOf(table))
    for (std::size_t i = stride; i < count; ++i) parts[i] += parts[i - stride];
  Eigen::MatrixXd coefficients(table.outputs(), columns);
  for (std::size_t i = 0; i < count; ++i)
    coefficients.data()[i] = static_cast<std::int32_t>(parts[i]) / SplineTable::kParts;
  return coefficients;
}

} // namespace

OrderedJson toJson(const KernelForwardModel& model) {
  OrderedJson json = {{"cause_offset", toJson(model.parameterOffset)},
                      {"cause_factor", toJson(model.parameterFactor)},
                      {"cause_deviation", toJson(model.parameterDeviation)},
                      {"measurement_offset", toJson(model.measurementOffset)},
                      {"projection", toJson(model.projection)},
                      {"deviation", toJson(model.deviation)},
                      {"inflation", toJson(model.inflation)}};
  if (model.residualLimit > 0) json["left_by_one"] = model.residualLimit;
  if (model.table.inputs() == 0) {
    json["network"] = toJson(model.network);
    return json;
  }
  json["starts"] = toJson(model.initialGuesses);
  json["strengths"] = model.amplitudes;
  json["table"] = toJson(model.table);
  return json;
}

OrderedJson toJson(const SplineTable& table) {
  OrderedJson exponents = OrderedJson::array();
  for (Eigen::Index j = 0; j < table.terms(); ++j)
    exponents.push_back(std::vector<int>(table.exponents.col(j).begin(), table.exponents.col(j).end()));
  OrderedJson json = {
      {"place", table.place},      {"low", {table.low(0), table.low(1)}}, {"step", {table.step(0), table.step(1)}},
      {"nodes", table.nodes},      {"shift", toJson(table.shift)},        {"exponents", exponents},
      {"rest", toJson(table.rest)}};
  const OrderedJson packed = packedCoefficients(table);
  json[packed.is_null() ? "coefficients" : "packed"] = packed.is_null() ? toJson(table.coefficients) : packed;
  return json;
}

namespace {

/// Which of the inputs are places: two different ones of them, or -1.
std::array<int, 2> readPlaces(const JsonPlace& place, Eigen::Index inputs) {
  const std::vector<int> given = readIntegers(place);
  requireSize(place, static_cast<Eigen::Index>(given.size()), 2, "numbers, one per axis");
  for (const int input : given)
    if (input < -1 || input >= inputs) place.refuse("-1 to " + std::to_string(inputs - 1));
  if (given[0] < 0 || given[0] == given[1]) place.refuse("an input, and another one or -1");
  return {given[0], given[1]};
}

SplineTable readTable(const JsonPlace& place) {
  place.onlyKeys({"place", "low", "step", "nodes", "shift", "exponents", "rest"}, {"coefficients", "packed"});
  SplineTable table;
  table.shift = readVector(place.at("shift"));
  table.rest = readVector(place.at("rest"));
  table.place = readPlaces(place.at("place"), table.inputs());
  const std::vector<double> low = place.at("low").numbers(2), step = place.at("step").numbers(2);
  const std::vector<int> nodes = readIntegers(place.at("nodes"));
  requireSize(place.at("nodes"), static_cast<Eigen::Index>(nodes.size()), 2, "numbers, one per axis");
  for (std::size_t axis = 0; axis < 2; ++axis) {
    table.low(static_cast<Eigen::Index>(axis)) = low[axis];
    table.step(static_cast<Eigen::Index>(axis)) = step[axis];
    table.nodes[axis] = nodes[axis];
    if (!(step[axis] > 0)) place.at("step").refuse("numbers above 0");
    if (nodes[axis] < 4 || nodes[axis] > kMostTableNodes)
      place.at("nodes").refuse("4 to " + std::to_string(kMostTableNodes));
  }
  const std::vector<JsonPlace> terms = place.at("exponents").list();
  table.exponents.resize(table.inputs(), static_cast<Eigen::Index>(terms.size()));
  for (std::size_t j = 0; j < terms.size(); ++j) {
    const std::vector<int> powers = readIntegers(terms[j]);
    requireSize(terms[j], static_cast<Eigen::Index>(powers.size()), table.inputs(), "numbers, one per input");
    for (std::size_t k = 0; k < powers.size(); ++k) {
      const bool isPlace = static_cast<int>(k) == table.place[0] || static_cast<int>(k) == table.place[1];
      if (powers[k] < 0 || powers[k] > (isPlace ? 0 : kMostExponent))
        terms[j].refuse("0 to " + std::to_string(kMostExponent) + ", 0 for a position");
      table.exponents(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) = powers[k];
    }
  }
  if (table.terms() < 1) place.at("exponents").refuse("one term or more");
  if (place.has("packed")) {
    table.coefficients = readPacked(place.at("packed"), table);
    return table;
  }
  table.coefficients = readMatrix(place.at("coefficients"));
  requireSize(place.at("coefficients"), table.coefficients.rows(), table.outputs(), "rows, one per output");
  requireSize(place.at("coefficients"), table.coefficients.cols(),
              table.terms() * Eigen::Index(table.nodes[0]) * Eigen::Index(table.nodes[1]),
              "columns, one per term and node");
  return table;
}

/// What a table needs with it to be inverted.
void readInversion(const JsonPlace& place, KernelForwardModel& model) {
  model.table = readTable(place.at("table"));
  model.initialGuesses = readMatrix(place.at("starts"));
  model.amplitudes = readIntegers(place.at("strengths"));
  requireSize(place.at("starts"), model.initialGuesses.rows(), model.table.inputs(),
              "rows, one per input of the table");
  if (model.initialGuesses.cols() < 1) place.at("starts").refuse("one column or more");
  for (const int input : model.amplitudes)
    if (input < 0 || input >= model.table.inputs() || input == model.table.place[0] || input == model.table.place[1])
      place.at("strengths").refuse("inputs of the table other than positions");
}

} // namespace

KernelForwardModel readKernelForwardModel(const JsonPlace& place) {
  place.onlyKeys(
      {"cause_offset", "cause_factor", "cause_deviation", "measurement_offset", "projection", "deviation", "inflation"},
      {"left_by_one", "network", "table", "starts", "strengths"});
  KernelForwardModel model;
  model.parameterOffset = readVector(place.at("cause_offset"));
  model.parameterFactor = readVector(place.at("cause_factor"));
  model.parameterDeviation = readVector(place.at("cause_deviation"));
  model.measurementOffset = readVector(place.at("measurement_offset"));
  model.projection = readMatrix(place.at("projection"));
  model.deviation = readVector(place.at("deviation"));
  model.inflation = readVector(place.at("inflation"));
  requireSize(place.at("inflation"), model.inflation.size(), model.parameters(), "entries, one per parameter");
  requireSize(place.at("cause_factor"), model.parameterFactor.size(), model.parameters(), "entries, one per parameter");
  requireSize(place.at("cause_deviation"), model.parameterDeviation.size(), model.parameters(),
              "entries, one per parameter");
  for (Eigen::Index k = 0; k < model.parameters(); ++k)
    if (model.parameterFactor(k) != 0 && !(model.parameterFactor(k) > 0 && model.parameterDeviation(k) > 0))
      place.at("cause_factor")
          .refuse("numbers above 0, with a deviation above 0, or 0 for a parameter that does not vary");
  const Eigen::Index varied = (model.parameterFactor.array() != 0).count();
  requireSize(place.at("projection"), model.projection.cols(), model.measurements(), "columns, one per measurement");
  requireSize(place.at("projection"), model.projection.rows(), model.components(), "rows, one per component");
  if (model.components() < 1 || !(model.deviation.array() > 0).all())
    place.at("deviation").refuse("numbers above 0, one or more");
  if (place.has("left_by_one")) {
    model.residualLimit = place.at("left_by_one").number();
    if (!(model.residualLimit > 0)) place.at("left_by_one").refuse("a number above 0");
  }
  const std::string form = place.has("table") ? "table" : "network";
  if (place.has("table"))
    readInversion(place, model);
  else
    model.network = readRbf(place.at("network"));
  const bool table = model.table.inputs() > 0;
  requireSize(place.at(form), table ? model.table.inputs() : model.network.inputs(), varied,
              "inputs, one per parameter that varies");
  requireSize(place.at(form), table ? model.table.outputs() : model.network.outputs(), model.components(),
              "outputs, one per component");
  if (!table && (model.network.scaler.scaling != Scaling::Raw || model.network.centers.cols() < 1))
    place.at("network").refuse("a network of unscaled inputs with one centre or more");
  return model;
}

} // namespace palp
