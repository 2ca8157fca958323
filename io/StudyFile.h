#pragma once

#include "io/Decoder.h"
#include "model/SensorDesign.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palp {

/// What a study works out of each design.
enum class StudyQuantity {
  Bound,        ///< Cramer-Rao bound of the force, all row-wires, by area
  Decoders,     ///< errors of decoders on samples of their own
  Displacement, ///< largest displacement under the largest load on area 0
  Error         ///< estimated error of the mesh in that solve
};
inline constexpr NamedEnum kStudyQuantities("quantity",
                                            std::array{std::pair{StudyQuantity::Bound, "bound"},
                                                       std::pair{StudyQuantity::Decoders, "decoders"},
                                                       std::pair{StudyQuantity::Displacement, "displacement"},
                                                       std::pair{StudyQuantity::Error, "error"}});

/// A number of the design that varies: over a list of values or over a range.
struct StudyAxis {
  std::string key;                 ///< its place in the design's file, with dots: "material.c10_MPa", "block_mm.2"
  std::vector<std::string> values; ///< as JSON; empty: a range
  double from = 0, to = 0;
  int count = 0; ///< values of the range in a full factorial, both ends among them
  bool logarithmic = false;
};

/// Designs spanned by some keys of one design, and what to compute of each (resources/docs/formats.md, Studies).
struct StudyPlan {
  std::string design; ///< the one that is varied, as JSON
  std::vector<StudyAxis> axes;
  int hypercube = 0; ///< points of a Latin hypercube; 0: every combination
  std::uint64_t seed = 1;
  std::vector<StudyQuantity> quantities;
  std::vector<DecoderKind> decoders;
  double noise = 1e-4; ///< of each resistance
  int perArea = 20;    ///< samples of training, and as many of testing
  std::optional<double> meshSize_mm;
  std::optional<std::array<int, 3>> mapped;
  std::vector<std::vector<std::size_t>> strata; ///< of the hypercube: of each axis in which stratum each point lies

  [[nodiscard]] std::size_t designs() const;
  [[nodiscard]] bool computes(StudyQuantity quantity) const;
  /// Values of the axes of design i, as JSON: from the plan and i alone.
  [[nodiscard]] std::vector<std::string> values(std::size_t i) const;
  /// Design i. Throws Error where its file would be refused.
  [[nodiscard]] SensorDesign at(std::size_t i) const;
};

/// Reads a study's file strictly. Throws Error with file, key, value and what is allowed.
StudyPlan loadStudy(const std::filesystem::path& path);
/// The same of its text; errors name it by `name`, and files of designs are looked for in `folder`.
StudyPlan parseStudy(const std::string& json, const std::string& name, const std::filesystem::path& folder = {});

/// The keys of numbers in a design's file, as StudyAxis::key names them, in the file's order of names.
std::vector<std::string> studyKeys(const SensorDesign& design);
/// The number of the design under such a key. Throws Error where there is none.
double studyNumber(const SensorDesign& design, const std::string& key);

/// An axis from the words of its values: a range "3..6 x 4", with " log" behind it for equal factors ("x 4" is not
/// needed in a Latin hypercube), or a list of JSON values "3, 4.5, 6". Throws Error with the key and what is allowed.
StudyAxis studyAxis(const std::string& key, const std::string& words);
/// The other way.
std::string studyWords(const StudyAxis& axis);

/// The complete plan as the text of such a file, its design within; with the program that begins it where there is one.
std::string toJson(const StudyPlan& plan, const std::string& program = {});

} // namespace palp
