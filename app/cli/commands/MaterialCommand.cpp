#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/cli/ProgressBar.h"
#include "app/study/material/LawFit.h"
#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>

namespace palp {

namespace {

struct MaterialArguments {
  std::string action;
  std::vector<std::string> tests;
  std::vector<std::string> equibiaxial, planar;
  std::vector<std::string> laws;
  std::string residuals = "absolute", stretches, poissonRatio = "0.499";
  OutputFile output;
};

std::vector<TestRow> rowsOf(const MaterialArguments& arguments) {
  std::vector<TestRow> rows;
  const auto add = [&](const std::vector<std::string>& files, TestMode mode) {
    for (const std::string& file : files) {
      const std::vector<TestRow> more = readTestRows(file, mode);
      rows.insert(rows.end(), more.begin(), more.end());
    }
  };
  add(arguments.tests, TestMode::Uniaxial);
  add(arguments.equibiaxial, TestMode::Equibiaxial);
  add(arguments.planar, TestMode::Planar);
  if (rows.empty()) throw UsageError("test: got no file, expected a CSV file of a test");
  if (arguments.stretches.empty()) return rows;
  const std::vector<double> range = numbers("--stretches", arguments.stretches, 2);
  if (!(range[0] > 0 && range[0] < range[1]))
    throw badValue("--stretches", arguments.stretches, "LOW,HIGH with 0 < LOW < HIGH, for example 0.7,1.5");
  std::erase_if(rows, [&](const TestRow& row) { return row.stretch < range[0] || row.stretch > range[1]; });
  if (rows.empty()) throw badValue("--stretches", arguments.stretches, "a range with at least one row of the test");
  return rows;
}

std::vector<LawCandidate> candidatesOf(const MaterialArguments& arguments) {
  const std::vector<LawCandidate> all = lawCandidates();
  if (arguments.laws.empty()) return all;
  std::vector<LawCandidate> chosen;
  for (const std::string& name : arguments.laws) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const LawCandidate& candidate) { return candidate.name() == name; });
    if (found == all.end())
      throw badValue("--law", name, "neo-hooke, mooney-rivlin, yeoh, gent, ogden-1, ogden-2 or ogden-3");
    chosen.push_back(*found);
  }
  return chosen;
}

nlohmann::ordered_json jsonOf(const LawFit& fit, const Material& material) {
  nlohmann::ordered_json json{{"law", fit.candidate.name()}};
  for (std::size_t k = 0; k < fit.names.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    nlohmann::ordered_json constant{{"name", fit.names[k]}, {"value", fit.values(i)}};
    if (fit.covariance.size() > 0) constant["standard_deviation"] = std::sqrt(fit.covariance(i, i));
    json["constants"].push_back(constant);
  }
  for (Eigen::Index row = 0; row < fit.covariance.rows(); ++row) {
    std::vector<double> line;
    for (Eigen::Index k = 0; k < fit.covariance.cols(); ++k) line.push_back(fit.covariance(row, k));
    json["covariance"].push_back(line);
  }
  json["rms_MPa"] = fit.rms_MPa;
  json["rms"] = fit.rms;
  json["held_out_rms"] = fit.heldOut ? nlohmann::ordered_json(*fit.heldOut) : nlohmann::ordered_json();
  for (const auto& [mode, name] : kTestModes.all()) {
    const StableRange& range = fit.stable[static_cast<std::size_t>(mode)];
    json["stable_stretches"][name] = {range.least, range.most};
  }
  json["stable_on_rows"] = fit.stableOnRows;
  json["material"] = nlohmann::ordered_json::parse(materialJson(material));
  return json;
}

std::string rangeText(const StableRange& range) {
  return withDigits(range.least, 3) + " to " + withDigits(range.most, 3);
}

void print(const LawComparison& found, bool relative) {
  const auto shown = [&](double error) {
    return relative ? withDigits(100 * error, 3) + " %" : withDigits(error, 3) + " MPa";
  };
  for (std::size_t k = 0; k < found.fits.size(); ++k) {
    const LawFit& fit = found.fits[k];
    std::cout << fit.candidate.name() << (found.best == k ? " (smallest held-out error of the stable laws)" : "")
              << '\n';
    for (std::size_t c = 0; c < fit.names.size(); ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      std::cout << "  " << fit.names[c] << " = " << withDigits(fit.values(i), 6);
      if (fit.covariance.size() > 0)
        std::cout << "  (standard deviation " << withDigits(std::sqrt(fit.covariance(i, i)), 2) << ")";
      std::cout << '\n';
    }
    std::cout << "  rms residual " << shown(fit.rms) << ", on held-out rows "
              << (fit.heldOut ? shown(*fit.heldOut) : "not available") << '\n'
              << "  stable stretches: uniaxial " << rangeText(fit.stable[0]) << ", equibiaxial "
              << rangeText(fit.stable[1]) << ", planar " << rangeText(fit.stable[2])
              << (fit.stableOnRows ? "" : "; not stable over the rows") << '\n';
  }
  for (const LawWithoutFit& without : found.without)
    std::cout << without.candidate.name() << ": not fitted: " << without.reason << '\n';
}

/// Rows with the fitted stress and its standard deviation.
std::string curveCsv(const LawFit& fit, const std::vector<TestRow>& rows) {
  std::string csv = "mode,stretch,stress_MPa,fitted_MPa,fitted_deviation_MPa\n";
  for (const TestRow& row : rows) {
    const double deviation = fittedDeviation_MPa(fit, row.mode, row.stretch);
    csv += kTestModes.name(row.mode) + "," + text(row.stretch) + "," + text(row.stress_MPa) + "," +
           text(nominalStress_MPa(fit.law, row.mode, row.stretch)) + "," +
           (std::isfinite(deviation) ? text(deviation) : "") + "\n";
  }
  return csv;
}

Exit fit(const MaterialArguments& arguments, Session& session) {
  const double poissonRatio = number("--poisson-ratio", arguments.poissonRatio);
  if (!(poissonRatio >= 0 && poissonRatio <= 0.5))
    throw badValue("--poisson-ratio", arguments.poissonRatio, "0 to 0.5");
  const Residuals residuals = kResiduals.value(arguments.residuals);
  const std::vector<LawCandidate> candidates = candidatesOf(arguments);
  if (!arguments.output.path.empty()) arguments.output.requireWritable();
  const std::vector<TestRow> rows = rowsOf(arguments);
  ProgressBar bar("laws", 1000);
  const LawComparison found = fitLaws(rows, candidates, residuals, session.stop,
                                      [&](double share) { bar.show(static_cast<std::size_t>(1000 * share)); });
  session.warnings = found.warnings;
  session.result["rows"] = rows.size();
  session.result["residuals"] = arguments.residuals;
  session.result["fits"] = nlohmann::ordered_json::array();
  for (const LawFit& one : found.fits)
    session.result["fits"].push_back(jsonOf(one, {.law = one.law, .poissonRatio = poissonRatio}));
  for (const LawWithoutFit& without : found.without)
    session.result["not_fitted"].push_back({{"law", without.candidate.name()}, {"reason", without.reason}});
  // A single law was chosen by the user, stable or not.
  const auto chosen = found.fits.size() == 1 ? std::optional<std::size_t>(0) : found.best;
  if (chosen) {
    const LawFit& best = found.fits[*chosen];
    const Material material{.law = best.law, .poissonRatio = poissonRatio};
    session.result["best"] = best.candidate.name();
    session.result["material"] = nlohmann::ordered_json::parse(materialJson(material));
    if (!arguments.output.path.empty()) {
      writeFile(arguments.output.path, curveCsv(best, rows), arguments.output.force);
      session.result["file"] = arguments.output.path.string();
    }
  }
  if (!session.json) {
    print(found, residuals == Residuals::Relative);
    for (const std::string& warning : found.warnings) std::cerr << "palp material: " << warning << '\n';
    if (chosen)
      std::cout << "\"material\": " << materialJson({.law = found.fits[*chosen].law, .poissonRatio = poissonRatio})
                << '\n';
    else
      std::cout
          << "no law is stable over all rows: expected more rows, a smaller range of --stretches or another law\n";
  }
  return chosen ? Exit::Done : Exit::NoResult;
}

} // namespace

void addMaterial(Cli& cli) {
  auto arguments = std::make_shared<MaterialArguments>();
  Command command = cli.command("material", "Fits laws of rubber to tests of a specimen.",
                                "palp material fit tension.csv --equibiaxial bulge.csv",
                                [arguments](Session& session) { return fit(*arguments, session); });
  command.option("action", arguments->action, "TEXT", "fit: finds the constants of laws from tests")
      .required()
      .oneOf({"fit"});
  command.option("test", arguments->tests, "FILE",
                 "CSV of a test: stretch, strain or strain_percent; stress_MPa, stress_kPa or stress_Pa (nominal); if "
                 "wanted mode (default uniaxial) and weight");
  command.group("Test");
  command.option("--equibiaxial", arguments->equibiaxial, "FILE", "the same of an equibiaxial test").oneValueEach();
  command.option("--planar", arguments->planar, "FILE", "the same of a planar test (pure shear)").oneValueEach();
  command.option("--stretches", arguments->stretches, "LOW,HIGH", "rows of these stretches only");
  command.group("Fit");
  command
      .option("--law", arguments->laws, "TEXT",
              "neo-hooke, mooney-rivlin, yeoh, gent, ogden-1, ogden-2 or ogden-3 (default: all)")
      .oneValueEach();
  command.option("--residuals", arguments->residuals, "TEXT", "absolute (default) or relative to the measured stress")
      .oneOf({"absolute", "relative"});
  command.option("--poisson-ratio", arguments->poissonRatio, "NUMBER", "of the printed material (default 0.499)");
  arguments->output.declare(command, "CSV file to write: rows, fitted stresses and their standard deviations");
}

} // namespace palp
