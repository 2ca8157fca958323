#pragma once

#include "app/cli/Cli.h"
#include "model/LoadCase.h"
#include "model/SensorDesign.h"
#include "solver/SensorMesh.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace palp {

/// "--option: got 'value', expected ...", to be thrown.
UsageError badValue(const std::string& option, const std::string& value, const std::string& expected);
/// A finite number, or UsageError.
double number(const std::string& option, const std::string& value);
/// Numbers between commas, exactly `count` of them.
std::vector<double> numbers(const std::string& option, const std::string& value, std::size_t count);
/// A whole number in [low, high].
int wholeNumber(const std::string& option, const std::string& value, int low, int high);

/// The design that commands take: a file, or the preset's name `paper`.
SensorDesign designOption(const std::string& fileOrPreset);
/// The same for a command that works by Eq. (1) alone: refuses the field law before any work is done.
SensorDesign pairsDesignOption(const std::string& fileOrPreset, const std::string& command);

/// --load AREA:FX,FY,FZ, --patch X,Y,RADIUS:FX,FY,FZ and, where the command has them, --indenter (IndenterOption.h),
/// as often as wanted.
struct LoadOptions {
  std::vector<std::string> loads;
  std::vector<std::string> patches;
  std::vector<std::string> indenters;
  std::filesystem::path pathFile; ///< --loads: a path of indenters (io/LoadFile.h)
  void declare(Command command);
  void declareIndenters(Command command);
  void declarePath(Command command);
  /// All loads together; UsageError names what is wrong with which.
  [[nodiscard]] LoadCase loadCase(const SensorDesign& design) const;
  /// The steps of --loads, in each the forces of --load and --patch; UsageError or Error names what is wrong.
  [[nodiscard]] std::vector<LoadCase> loadPath(const SensorDesign& design) const;

private:
  /// Of --load and --patch.
  [[nodiscard]] LoadCase forces(const SensorDesign& design) const;
};

/// AREA:FX,FY,FZ as a force on an area that the design has. Throws UsageError.
AreaLoad areaLoadOption(const std::string& option, const std::string& value, const SensorDesign& design);
/// X,Y:FX,FY,FZ [mm, N].
std::pair<Eigen::Vector2d, Eigen::Vector3d> placedForceOption(const std::string& option, const std::string& value);

/// --mesh-size MM, --mapped NxNxN (and --accuracy REL where the command has loads to judge it by).
struct MeshChoice {
  std::string meshSize;
  std::string mapped;
  std::string accuracy;
  void declare(Command command, bool withAccuracy);
  [[nodiscard]] MeshOptions options() const;
  [[nodiscard]] std::optional<double> relativeAccuracy() const;
  /// The same options as on the command line, with a blank before each.
  [[nodiscard]] std::string asCommand() const;
};

/// UsageError where the name means standard output or standard error, which no command writes files to.
void requireNoStream(const std::string& option, const std::filesystem::path& path);

/// A written file: refuses to overwrite without force, and what cannot be written, before any work is done.
struct OutputFile {
  std::filesystem::path path;
  bool force = false;
  Option declare(Command command, const std::string& what);
  void requireWritable() const;
};

/// A report's folder, made where it is missing; one that is not empty is taken with force only. One that was made and
/// stays empty, because the report was refused or cancelled, goes with the object.
class OutputFolder {
public:
  OutputFolder(const std::filesystem::path& folder, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

private:
  std::filesystem::path made_; ///< empty where it was there before
};

} // namespace palp
