#pragma once

// Private to io: the networks and models of nn as JSON.

#include "io/Decoder.h"
#include "io/StrictJson.h"

namespace palp {

using OrderedJson = nlohmann::ordered_json;

OrderedJson toJson(const Eigen::VectorXd& values);
/// { "rows", "columns", "values": column by column }.
OrderedJson toJson(const Eigen::MatrixXd& matrix);
OrderedJson toJson(const RbfNetwork& network);
OrderedJson toJson(const ForwardModel& model);
OrderedJson toJson(const KernelForwardModel& model);
OrderedJson toJson(const SplineTable& table);
OrderedJson toJson(const MeasuredTraining& measured);

/// Readers throw Error with file, key, value and what is allowed; sizes that do not fit together too.
Eigen::VectorXd readVector(const JsonPlace& place);
Eigen::MatrixXd readMatrix(const JsonPlace& place);
std::vector<int> readIntegers(const JsonPlace& place);
RbfNetwork readRbf(const JsonPlace& place);
/// Of a network of measured rows, which reads what a stage makes of the readings.
MeasuredTraining readMeasured(const JsonPlace& place, const RbfNetwork& network, Eigen::Index readings);
ForwardModel readForwardModel(const JsonPlace& place);
KernelForwardModel readKernelForwardModel(const JsonPlace& place);

/// The decoder's model: of a new kind of decoder both are in DecoderJson.cpp.
OrderedJson modelJson(const Decoder& decoder);
/// Reads the model of the decoder's kind.
void readModel(const JsonPlace& place, Decoder& decoder);

/// Refuses `place` unless its size is what the remainder of the file needs.
void requireSize(const JsonPlace& place, Eigen::Index size, Eigen::Index wanted, const std::string& what);

} // namespace palp
