#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/study/decoding/Calibration.h"
#include "app/study/decoding/RestRecording.h"
#include "io/DecoderFile.h"
#include "io/DesignFile.h"
#include "io/SampleFile.h"
#include "model/RestFit.h"
#include "model/base/NumberText.h"

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
  std::string rest;
  std::string design;
  OutputFile output;
};

Json byAxis(const Eigen::Vector3d& values) {
  return {values.x(), values.y(), values.z()};
}

/// Days since the frames were written last.
double ageInDays(const std::filesystem::path& path) {
  const auto age = std::filesystem::file_time_type::clock::now() - std::filesystem::last_write_time(path);
  return std::chrono::duration<double, std::ratio<86400>>(age).count();
}

void print(const CalibrationReport& report, double age_days) {
  std::printf("%lld labelled frame%s, %s days old; by area:", static_cast<long long>(report.samples),
              report.samples == 1 ? "" : "s", withDecimals(age_days, 1).c_str());
  for (const int count : report.samplesPerArea) std::printf(" %d", count);
  std::printf("\n        labels [N]        coverage  rms error before  after (unseen)\n");
  for (int axis = 0; axis < 3; ++axis)
    std::printf("F%c  %8s to %8s  %7s %%  %14s N  %8s N = %s %% of range\n", "xyz"[axis],
                withDecimals(report.lowest_N(axis), 3).c_str(), withDecimals(report.highest_N(axis), 3).c_str(),
                withDecimals(report.coverage_percent(axis), 1).c_str(),
                withDecimals(report.rmseBefore_N(axis), 4).c_str(), withDecimals(report.rmseAfter_N(axis), 4).c_str(),
                withDecimals(report.rmseAfter_percentOfRange(axis), 2).c_str());
  const auto both = [](const Eigen::Vector2d& v_mm) {
    return withDecimals(v_mm.x(), 3) + ", " + withDecimals(v_mm.y(), 3);
  };
  if (const auto& place = report.place)
    std::printf("position along x, y: rms error before %s mm, after (unseen) %s mm\n",
                both(place->rmseBefore_mm).c_str(), both(place->rmseAfter_mm).c_str());
  std::printf("worst frame: %lld, %s N\n", static_cast<long long>(report.worstSample),
              withDecimals(report.worstError_N, 4).c_str());
}

void fill(Json& result, const CalibrationReport& report, double age_days) {
  result["samples"] = report.samples;
  result["samples_per_area"] = report.samplesPerArea;
  result["lowest_N"] = byAxis(report.lowest_N);
  result["highest_N"] = byAxis(report.highest_N);
  result["coverage_percent"] = byAxis(report.coverage_percent);
  result["rmse_before_N"] = byAxis(report.rmseBefore_N);
  result["rmse_after_N"] = byAxis(report.rmseAfter_N);
  result["rmse_after_percent_of_range"] = byAxis(report.rmseAfter_percentOfRange);
  result["worst_sample"] = report.worstSample;
  result["worst_error_N"] = report.worstError_N;
  result["improved"] = report.improved;
  if (const auto& place = report.place)
    result["place"] = {{"rmse_before_mm", {place->rmseBefore_mm.x(), place->rmseBefore_mm.y()}},
                       {"rmse_after_mm", {place->rmseAfter_mm.x(), place->rmseAfter_mm.y()}},
                       {"improved", place->improved}};
  result["age_days"] = age_days;
}

/// Throws Error where the board reports another read-out than that of the design, or where readings are missing.
void requireBoard(const CalibrateArguments& arguments, const SensorDesign& design, const RestRecording& rest) {
  if (design.field() && rest.info.readout && *rest.info.readout != design.field()->readout)
    throw Error(arguments.rest + ": the board has read-out " + kReadouts.name(*rest.info.readout) + ", the design " +
                kReadouts.name(design.field()->readout) + "; set resistance.readout of the design");
  if (rest.faults.empty()) return;
  std::string all;
  for (const std::string& fault : rest.faults) {
    if (all.size() > 200) {
      all += ", ...";
      break;
    }
    all += (all.empty() ? "" : "; ") + fault;
  }
  throw Error(arguments.rest + ": " + all + "; the field joins all wires, so repair this first");
}

void printFitted(const char* what, double value, double deviation, const char* unit) {
  std::printf("%-12s %10s +- %s %s\n", what, withDigits(value, 5).c_str(), withDigits(deviation, 2).c_str(), unit);
}

void print(const RestRecording& rest, const RestFit& fit) {
  std::printf("%d readings at rest, mean of %d frames, noise of the mean %s of R; the fit leaves %s (rms)\n",
              fit.readings, rest.frames, withDigits(rest.noise, 2).c_str(), withDigits(fit.misfit, 2).c_str());
  printFitted("radius", fit.law.electrodeRadius_mm, fit.radiusDeviation_mm, "mm");
  printFitted("resistivity", fit.law.resistivity_ohm_mm, fit.resistivityDeviation_ohm_mm, "ohm mm");
  if (fit.keptContact.empty()) {
    printFitted("contact", fit.law.contact_ohm_mm2, fit.contactDeviation_ohm_mm2, "ohm mm2");
    std::printf("radius and contact are correlated: %s\n", withDecimals(fit.correlation, 4).c_str());
  } else {
    std::printf("%-12s %10s ohm mm2, not fitted: %s\n", "contact", withDigits(fit.law.contact_ohm_mm2, 5).c_str(),
                fit.keptContact.c_str());
  }
}

void fill(nlohmann::ordered_json& result, const RestRecording& rest, const RestFit& fit, const std::string& whyNot) {
  result["frames"] = rest.frames;
  result["readings"] = fit.readings;
  result["noise"] = rest.noise;
  result["misfit"] = fit.misfit;
  result["electrode_radius_mm"] = fit.law.electrodeRadius_mm;
  result["electrode_radius_deviation_mm"] = fit.radiusDeviation_mm;
  result["resistivity_ohm_mm"] = fit.law.resistivity_ohm_mm;
  result["resistivity_deviation_ohm_mm"] = fit.resistivityDeviation_ohm_mm;
  result["contact_ohm_mm2"] = fit.law.contact_ohm_mm2;
  result["contact_deviation_ohm_mm2"] = fit.keptContact.empty() ? Json(fit.contactDeviation_ohm_mm2) : Json();
  result["contact_kept"] = fit.keptContact;
  result["why_no_fit"] = whyNot;
}

/// Fits the design's law of the field to a board at rest; writes no design that does not fit.
Exit runRest(const CalibrateArguments& arguments, Session& session) {
  if (!arguments.network.empty() || arguments.design.empty())
    throw UsageError("--rest: fits a design; give --design, and no network and frames");
  arguments.output.requireWritable();
  SensorDesign design = designOption(arguments.design);
  const RestRecording rest = readRest(arguments.rest);
  requireBoard(arguments, design, rest);
  const auto [fit, whyNot] = session.stages.measure("train", [&] {
    const RestFit found = fitAtRest(design, rest.resistances_ohm, rest.noise, session.stop);
    return std::pair{found, whyNoFit(found, design, rest.resistances_ohm, rest.noise, session.stop)};
  });
  design.resistance = fit.law;
  fill(session.result, rest, fit, whyNot);
  if (!session.json) print(rest, fit);
  if (!whyNot.empty()) {
    std::cerr << "palp calibrate: " << arguments.rest << ": " << whyNot << '\n';
    return Exit::NoResult;
  }
  saveDesign(arguments.output.path, design, arguments.output.force);
  session.result["file"] = arguments.output.path.string();
  if (!session.json) std::cout << arguments.output.path.string() << " written\n";
  return Exit::Done;
}

Exit run(const CalibrateArguments& arguments, Session& session) {
  if (!arguments.rest.empty()) return runRest(arguments, session);
  if (arguments.network.empty() || arguments.frames.empty() || !arguments.design.empty())
    throw UsageError("give a network and labelled frames, or --rest RECORDING --design DESIGN");
  arguments.output.requireWritable();
  const Decoder decoder = readNetwork(arguments.network);
  const SampleSet frames = loadSamples(arguments.frames, session.stop);
  const Calibration calibration =
      session.stages.measure("train", [&] { return calibrate(decoder, frames, session.stop); });
  const CalibrationReport& report = calibration.report;
  const double age_days = ageInDays(arguments.frames);
  session.warnings = warningsOf(report);
  if (!report.opposed.empty() && !arguments.output.force)
    throw Error(arguments.frames + ": " + session.warnings.front() + " (no network was written; --force writes it)");
  if (decoder.place && !report.place)
    session.warnings.emplace_back(
        "the frames have no positions, so the positions of the network are not refined (palp listen "
        "--label @X,Y:FX,FY,FZ, or palp import)");
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
  Command command = cli.command(
      "calibrate", "Refines a network with labelled frames of a board, or fits a design to a board at rest.",
      "palp calibrate network.json frames.csv -o better.json",
      [arguments](Session& session) { return run(*arguments, session); });
  command.option("network", arguments->network, "FILE",
                 "network to refine (" + namesOfDecodersWith(&DecoderTraits::canBeCalibrated) + ", one force)");
  command.option("frames", arguments->frames, "FILE", "labelled frames, from palp listen --label ... --append");
  command.group("Fit of a design at rest");
  command.option("--rest", arguments->rest, "FILE",
                 "recording of the board at rest; fits electrode radius, resistivity and contact of the field law");
  command.option("--design", arguments->design, "DESIGN", "design file with the field law that the fit starts from");
  arguments->output.declare(command, "network or, with --rest, design file to write").required();
}

} // namespace palp
