#include "app/cli/Cli.h"
#include "app/cli/MeshCostLine.h"
#include "app/cli/Options.h"
#include "app/cli/ProgressBar.h"
#include "app/cli/ShardOption.h"
#include "app/cli/TouchOption.h"
#include "app/study/touch/SampleGenerator.h"
#include "io/SamplePartWriter.h"
#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <chrono>
#include <iostream>
#include <memory>

namespace palp {

namespace {

struct SampleArguments {
  std::string design;
  std::string perArea;
  TouchArguments touches;
  std::string seed = "1";
  std::string areas = "each";
  std::string shardText;
  std::string tolerance = "1e-6";
  bool surrogate = false;
  MeshChoice mesh;
  OutputFile output;
};

std::uint64_t seedOption(const std::string& text) {
  return static_cast<std::uint64_t>(wholeNumber("--seed", text, 0, 2'147'483'647));
}

SampleRequest request(const SampleArguments& arguments, const SensorDesign& design, const Session& session) {
  SampleRequest request;
  if (arguments.touches.given()) {
    request.touches = arguments.touches.range(design);
    request.perArea = wholeNumber("--count", arguments.touches.count, 1, 10'000'000);
  } else {
    if (arguments.perArea.empty()) throw UsageError("--per-area is missing; give it, or --touch with --count");
    request.perArea = wholeNumber("--per-area", arguments.perArea, 1, 10'000'000);
  }
  request.seed = seedOption(arguments.seed);
  request.areas = arguments.areas;
  request.surrogate = arguments.surrogate;
  request.relativeTolerance = number("--tolerance", arguments.tolerance);
  if (!(request.relativeTolerance >= 1e-10 && request.relativeTolerance <= 1e-2))
    throw badValue("--tolerance", arguments.tolerance, "1e-10 to 0.01 (relative, against full Newton)");
  request.mesh = arguments.mesh.options();
  request.threads = session.threads;
  return request;
}

Exit run(const SampleArguments& arguments, Session& session) {
  const SensorDesign design = designOption(arguments.design);
  arguments.output.requireWritable();
  const SampleRequest wanted = request(arguments, design, session);
  SampleGenerator generator(design, wanted);
  printMeshCost(design, generator.meshing(), session);
  const SampleRange range = shardOption(arguments.shardText, generator.total());
  SampleSet head = generator.emptySet(session.stop);
  if (session.stop.stop_requested()) { // before there is a head to write
    session.stages.add(generator.stages());
    session.result["samples"] = 0;
    return Exit::NoResult;
  }
  head.origin.firstSample = range.first;
  SamplePartWriter writer(arguments.output.path, head, arguments.output.force);
  const std::size_t kept = writer.samplesKept();
  if (kept > range.last - range.first)
    throw UsageError(writer.partPath().string() + ": samples: " +
                     gotExpected(std::to_string(kept), "at most the requested " +
                                                           std::to_string(range.last - range.first) +
                                                           "; remove the file to start over"));
  if (kept > 0) std::cerr << "continuing after " << kept << " samples in " << writer.partPath().string() << '\n';

  const auto start = std::chrono::steady_clock::now();
  ProgressBar bar("samples", range.last - range.first);
  const std::size_t made = generator.generate(
      {range.first + kept, range.last}, [&](const SampleSet& block) { writer.append(block); },
      [&](std::size_t done) { bar.show(kept + done); }, session.stop);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  session.stages.add(generator.stages());
  bool whole = kept + made == range.last - range.first;
  try {
    if (whole) writer.finish(session.stop);
  } catch (const Cancelled&) { // while arrays were written of what is made
    whole = false;
  }

  session.result["samples"] = kept + made;
  session.result["samples_of_all_shards"] = generator.total();
  session.result["solves"] = generator.solves();
  session.result["left_to_newton"] = generator.leftToNewton();
  session.result["redrawn"] = generator.redrawn();
  if (const int count = generator.redrawn(); count > 0) {
    session.warnings.push_back((count == 1
                                    ? "a touch without equilibrium was replaced: touch "
                                    : text(count) + " touches without equilibrium were replaced; the first: touch ") +
                               generator.whyRedrawn());
    std::cerr << "palp sample: " << session.warnings.back() << '\n';
  }
  session.result["solves_per_s"] = seconds > 0 ? static_cast<double>(made) / seconds : 0;
  if (std::string doubts = generator.doubts(); !doubts.empty()) {
    session.warnings.push_back(std::move(doubts));
    std::cerr << "palp sample: " << session.warnings.back() << '\n';
  }
  session.result["measured_error_relative"] =
      generator.errorMeasured() ? nlohmann::ordered_json(generator.measuredError()) : nlohmann::ordered_json();
  session.result["mesh"] = generator.origin().mesh;
  session.result["file"] = whole ? arguments.output.path.string() : writer.partPath().string();
  if (!session.json)
    std::cout << kept + made << " samples in " << session.result["file"].get<std::string>() << "; "
              << (arguments.surrogate ? "surrogate" : "full solves");
  if (!session.json && generator.errorMeasured())
    std::cout << ", measured error " << (arguments.surrogate ? "" : "against full Newton ")
              << generator.measuredError();
  if (!session.json && !generator.errorMeasured()) std::cout << ", error not measured";
  if (!session.json && generator.leftToNewton() > 0)
    std::cout << "; " << generator.leftToNewton() << " solved one by one by Newton's method";
  if (!session.json) std::cout << '\n';
  if (!whole && !session.json) std::cout << "stopped; the same command continues from here\n";
  return whole ? Exit::Done : Exit::NoResult;
}

} // namespace

void addSample(Cli& cli) {
  auto arguments = std::make_shared<SampleArguments>();
  Command command = cli.command("sample", "Computes labelled samples: forces, electrode displacements and resistances.",
                                "palp sample paper --per-area 100 --seed 1 -o samples.csv",
                                [arguments](Session& session) { return run(*arguments, session); });
  command.option("design", arguments->design, "DESIGN", "design file, or paper").required();
  command.group("Forces on areas");
  Option perArea =
      command.option("--per-area", arguments->perArea, "N", "samples per area (with --areas together: in all)");
  command.option("--areas", arguments->areas, "TEXT", "each, together, or the number of one area (default each)")
      .needs(perArea);
  command
      .flag("--surrogate", arguments->surrogate,
            "use a polynomial per area, fitted to full solves: many samples in seconds")
      .needs(perArea);
  arguments->touches.declare(command, perArea);
  command.group("Samples");
  command.option("--seed", arguments->seed, "N", "seed of the forces (default 1)");
  command.option("--tolerance", arguments->tolerance, "NUMBER",
                 "relative tolerance against full Newton (default 1e-6)");
  command.option("--shard", arguments->shardText, "I/N", "compute part I of N; palp merge joins the parts");
  arguments->mesh.declare(command, false);
  arguments->output.declare(command, "sample file to write: .csv, .h5 or .npz").required();
}

} // namespace palp
