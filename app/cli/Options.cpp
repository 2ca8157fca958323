#include "app/cli/Options.h"

#include "app/cli/IndenterOption.h"
#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "io/LoadFile.h"
#include "model/DesignError.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <charconv>
#include <cmath>

namespace palp {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// "WHERE:FX,FY,FZ" in two.
std::pair<std::string, Eigen::Vector3d> forceAt(const std::string& option, const std::string& value,
                                                const std::string& form) {
  const std::size_t colon = value.find(':');
  if (colon == std::string::npos) throw badValue(option, value, form);
  const std::vector<double> force = numbers(option, value.substr(colon + 1), 3);
  return {value.substr(0, colon), Eigen::Vector3d(force[0], force[1], force[2])};
}

} // namespace

UsageError badValue(const std::string& option, const std::string& value, const std::string& expected) {
  return UsageError(option + ": " + gotExpected(quotedText(value), expected));
}

double number(const std::string& option, const std::string& value) {
  double result = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), result);
  if (error != std::errc{} || end != value.data() + value.size() || !std::isfinite(result))
    throw badValue(option, value, value.empty() ? "a number" : "a finite number");
  return result;
}

std::vector<double> numbers(const std::string& option, const std::string& value, std::size_t count) {
  const std::vector<std::string> parts = split(value, ',');
  if (parts.size() != count)
    throw badValue(option, value, std::to_string(count) + " numbers separated by commas, without spaces");
  std::vector<double> result;
  for (const std::string& part : parts) result.push_back(number(option, part));
  return result;
}

int wholeNumber(const std::string& option, const std::string& value, int low, int high) {
  int result = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), result);
  if (error != std::errc{} || end != value.data() + value.size() || result < low || result > high)
    throw badValue(option, value, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return result;
}

SensorDesign designOption(const std::string& fileOrPreset) {
  SensorDesign design = fileOrPreset == "paper" ? paperDesign() : loadDesign(fileOrPreset);
  if (const auto problems = check(design); !problems.empty())
    throw DesignError(fileOrPreset + ": " + problems[0].key + ": " + problems[0].sentence);
  return design;
}

SensorDesign pairsDesignOption(const std::string& fileOrPreset, const std::string& command) {
  SensorDesign design = designOption(fileOrPreset);
  requirePairs(design, fileOrPreset + ": " + command);
  return design;
}

void LoadOptions::declare(Command command) {
  command.group("Loads");
  command.option("--load", loads, "AREA:FX,FY,FZ", "force [N] on a load area; may be repeated").oneValueEach();
  command.option("--patch", patches, "X,Y,RADIUS:FX,FY,FZ", "force on a disc of the top face [mm, N]; may be repeated")
      .oneValueEach();
}

void LoadOptions::declareIndenters(Command command) {
  command
      .option("--indenter", indenters, "SHAPE:SIZES@X,Y:CONTROL[:mu=MU]",
              "rigid indenter [mm, N]; CONTROL is press=FX,FY,FZ or depth=D[,SX,SY]; shapes sphere:R, pin:R, "
              "flat:R,RIM, cylinder-x:R, cylinder-y:R, plane; may be repeated")
      .oneValueEach();
}

void LoadOptions::declarePath(Command command) {
  command.option(
      "--loads", pathFile, "FILE",
      "JSON file with a load path of indenters, a list of steps { \"indenters\": [...] }; each step continues "
      "the previous one and has a result; --load and --patch act in all steps");
}

AreaLoad areaLoadOption(const std::string& option, const std::string& value, const SensorDesign& design) {
  const auto [area, force] = forceAt(option, value, "AREA:FX,FY,FZ, for example 0:1,0,-6");
  return {wholeNumber(option + " (area)", area, 0, design.areas.count() - 1), force};
}

std::pair<Eigen::Vector2d, Eigen::Vector3d> placedForceOption(const std::string& option, const std::string& value) {
  const auto [place, force] = forceAt(option, value, "@X,Y:FX,FY,FZ, for example @15,7.5:0,0,-3");
  const std::vector<double> xy = numbers(option + " (position)", place, 2);
  return {{xy[0], xy[1]}, force};
}

LoadCase LoadOptions::forces(const SensorDesign& design) const {
  LoadCase load;
  for (const std::string& value : loads) load.areas.push_back(areaLoadOption("--load", value, design));
  for (const std::string& value : patches) {
    const auto [disc, force] = forceAt("--patch", value, "X,Y,RADIUS:FX,FY,FZ, for example 15,15,2:0,0,-3");
    const std::vector<double> xyr = numbers("--patch", disc, 3);
    load.patches.push_back({{xyr[0], xyr[1]}, xyr[2], force});
  }
  return load;
}

LoadCase LoadOptions::loadCase(const SensorDesign& design) const {
  LoadCase load = forces(design);
  for (const std::string& value : indenters) load.indenters.push_back(indenterOption(value));
  if (load.areas.empty() && load.patches.empty() && load.indenters.empty())
    throw UsageError("no load given; expected one --load, --patch or --indenter or more, for example --load 0:1,0,-6");
  if (const auto wrong = whyInvalid(load, design)) throw UsageError(*wrong);
  return load;
}

std::vector<LoadCase> LoadOptions::loadPath(const SensorDesign& design) const {
  if (!indenters.empty()) throw UsageError("--indenter: not together with --loads, whose file has the indenters");
  if (pathFile.string().find(':') != std::string::npos && !std::filesystem::exists(pathFile))
    throw badValue("--loads", pathFile.string(), "an existing file; a force on an area is given by --load");
  std::vector<LoadCase> path = palp::loadPath(pathFile);
  const LoadCase held = forces(design);
  for (LoadCase& step : path) {
    step.areas = held.areas;
    step.patches = held.patches;
  }
  if (const auto wrong = whyInvalid(path, design)) throw UsageError(pathFile.string() + ": " + *wrong);
  return path;
}

void MeshChoice::declare(Command command, bool withAccuracy) {
  command.group("Mesh");
  Option size = command.option("--mesh-size", meshSize, "NUMBER", "size of the tetrahedra in the bulk [mm]");
  Option grid = command.option("--mapped", mapped, "NxNxN", "mapped hexahedra instead; the paper's mesh is 10x10x5");
  size.excludes(grid);
  if (!withAccuracy) return;
  command
      .option("--accuracy", accuracy, "NUMBER",
              "choose the mesh for this relative L2 error of the electrode displacements")
      .excludes(size)
      .excludes(grid);
}

MeshOptions MeshChoice::options() const {
  MeshOptions options;
  if (!meshSize.empty()) options.meshSize_mm = number("--mesh-size", meshSize);
  if (!mapped.empty()) {
    const std::vector<std::string> parts = split(mapped, 'x');
    if (parts.size() != 3) throw badValue("--mapped", mapped, "NxNxN, for example 10x10x5");
    options.mapped.emplace();
    for (std::size_t i = 0; i < 3; ++i) (*options.mapped)[i] = wholeNumber("--mapped", parts[i], 1, 1000);
  }
  return options;
}

std::optional<double> MeshChoice::relativeAccuracy() const {
  if (accuracy.empty()) return {};
  const double wanted = number("--accuracy", accuracy);
  if (!(wanted >= 1e-4 && wanted <= 0.5))
    throw badValue("--accuracy", accuracy, "0.0001 to 0.5 (relative: 0.01 is 1 %)");
  return wanted;
}

std::string MeshChoice::asCommand() const {
  std::string command;
  if (!meshSize.empty()) command += " --mesh-size " + meshSize;
  if (!mapped.empty()) command += " --mapped " + mapped;
  if (!accuracy.empty()) command += " --accuracy " + accuracy;
  return command;
}

Option OutputFile::declare(Command command, const std::string& what) {
  command.group("Output");
  command.flag("--force", force, "overwrite existing files");
  return command.option("-o,--output", path, "FILE", what);
}

void requireNoStream(const std::string& option, const std::filesystem::path& path) {
  for (const char* stream :
       {"-", "/dev/stdout", "/dev/stderr", "/dev/fd/1", "/dev/fd/2", "/proc/self/fd/1", "/proc/self/fd/2", "/dev/tty"})
    if (path == stream)
      throw UsageError(
          option + ": '" + path.string() +
          "' is a standard stream, which the command uses for its messages; give a file name (./- for a file named -)");
}

void OutputFile::requireWritable() const {
  if (path.empty()) return;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder))
    throw UsageError("--output: folder '" + folder.string() + "' does not exist");
  if (std::filesystem::is_directory(path))
    throw UsageError("--output: '" + path.string() + "' is a folder, not a file");
  requireNoStream("--output", path);
  if (!force && std::filesystem::is_regular_file(path))
    throw UsageError("--output: '" + path.string() + "' exists; give --force to overwrite it");
  palp::requireWritable(path, force);
}

OutputFolder::OutputFolder(const std::filesystem::path& folder, bool force) {
  requireNoStream("--output", folder);
  removeLeftovers(folder);
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw UsageError("--output: " + gotExpected("the file " + quotedText(folder.string()), "a folder"));
  if (std::filesystem::is_directory(folder) && !std::filesystem::is_empty(folder) && !force)
    throw UsageError("--output: folder '" + folder.string() + "' is not empty; give --force to write into it");
  std::error_code failed;
  if (std::filesystem::create_directories(folder, failed)) made_ = folder;
  if (failed) throw UsageError("--output: '" + folder.string() + "' cannot be created: " + failed.message());
  palp::requireWritable(folder / "report.html", true);
}

OutputFolder::~OutputFolder() {
  std::error_code notEmpty;
  if (!made_.empty()) std::filesystem::remove(made_, notEmpty);
}

} // namespace palp
