#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/study/decoding/Calibration.h"
#include "io/DecoderFile.h"
#include "io/SampleFile.h"

#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>

namespace palp {

namespace {

using Json = nlohmann::ordered_json;

struct CalibrateArguments {
  std::string network;
  std::string frames;
  OutputFile output;
};

Json list(const Eigen::Vector3d& values) {
  return {values.x(), values.y(), values.z()};
}

/// Days since the frames were written last.
double ageInDays(const std::filesystem::path& path) {
  const auto age = std::filesystem::file_time_type::clock::now() - std::filesystem::last_write_time(path);
  return std::chrono::duration<double, std::ratio<86400>>(age).count();
}

void print(const CalibrationReport& report, double age_days) {
  std::printf("%lld labelled frames, %.1f days old; by area:", static_cast<long long>(report.samples), age_days);
  for (const int count : report.samplesPerArea) std::printf(" %d", count);
  std::printf("\n        labels [N]        coverage  rms error before  after (unseen)\n");
  for (int axis = 0; axis < 3; ++axis)
    std::printf("F%c  %8.3f to %8.3f  %7.1f %%  %14.4f N  %8.4f N = %.2f %% of range\n", "xyz"[axis],
                report.lowest_N(axis), report.highest_N(axis), report.coverage_percent(axis), report.rmseBefore_N(axis),
                report.rmseAfter_N(axis), report.rmseAfter_percentOfRange(axis));
  std::printf("worst frame: %lld, %.4f N\n", static_cast<long long>(report.worstSample), report.worstError_N);
}

void fill(Json& result, const CalibrationReport& report, double age_days) {
  result["samples"] = report.samples;
  result["samples_per_area"] = report.samplesPerArea;
  result["lowest_N"] = list(report.lowest_N);
  result["highest_N"] = list(report.highest_N);
  result["coverage_percent"] = list(report.coverage_percent);
  result["rmse_before_N"] = list(report.rmseBefore_N);
  result["rmse_after_N"] = list(report.rmseAfter_N);
  result["rmse_after_percent_of_range"] = list(report.rmseAfter_percentOfRange);
  result["worst_sample"] = report.worstSample;
  result["worst_error_N"] = report.worstError_N;
  result["improved"] = report.improved;
  result["age_days"] = age_days;
}

Exit run(const CalibrateArguments& arguments, Session& session) {
  arguments.output.requireWritable();
  const Decoder decoder = readNetwork(arguments.network);
  const SampleSet frames = loadSamples(arguments.frames);
  const Calibration calibration =
      session.stages.measure("train", [&] { return calibrate(decoder, frames, session.stop); });
  const CalibrationReport& report = calibration.report;
  const double age_days = ageInDays(arguments.frames);
  if (!report.improved)
    session.warnings.emplace_back("on frames that it has not seen, the refined network is no better than the old one");
  if (report.coverage_percent.minCoeff() < 50)
    session.warnings.emplace_back("the labels cover less than half of the network's force range in some direction");
  writeNetwork(calibration.decoder, arguments.output.path, arguments.output.force);
  fill(session.result, report, age_days);
  session.result["file"] = arguments.output.path.string();
  if (session.json) return Exit::Done;
  print(report, age_days);
  for (const std::string& warning : session.warnings) std::cout << "warning: " << warning << '\n';
  std::cout << arguments.output.path.string() << " written\n";
  return Exit::Done;
}

} // namespace

void addCalibrate(Cli& cli) {
  auto arguments = std::make_shared<CalibrateArguments>();
  Command command = cli.command("calibrate", "refine a network with labelled frames of a real board",
                                "palp calibrate network.json frames.csv -o better.json",
                                [arguments](Session& session) { return run(*arguments, session); });
  command.option("network", arguments->network, "network file (rbf or ml, one force)").required();
  command.option("frames", arguments->frames, "labelled frames, from palp listen --label ... --append").required();
  arguments->output.declare(command, "network file to write").required();
}

} // namespace palp
