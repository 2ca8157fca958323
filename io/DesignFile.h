#pragma once

#include "model/SensorDesign.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace palp {

class JsonPlace;

/// The design as the text of its JSON file; numbers read back to the same bits. Depths and positions are written in the
/// short form (one for all wires) if the design has it (resources/docs/formats.md).
std::string toJson(const SensorDesign& design);

/// The design's "material" as one line of JSON.
std::string materialJson(const Material& material);

/// Reads the text of a design file strictly: an unknown key, a missing one, a wrong type or a newer version throws
/// Error with the file's name, the key, the value and what is allowed. Whether the design can be built is for check()
/// to say.
SensorDesign parseDesign(std::string_view json, const std::string& file);
/// The same of a design within another file.
SensorDesign readDesign(const JsonPlace& place);

/// A design that can be built, from a file. Throws Error.
SensorDesign loadDesign(const std::filesystem::path& path);

/// Throws Error if the design cannot be built, or if the file exists and `force` is not given.
void saveDesign(const std::filesystem::path& path, const SensorDesign& design, bool force);

/// FNV-1a (64 bits, hexadecimal) of the design's JSON without white space: the same on any machine.
std::string designFingerprint(const SensorDesign& design);

} // namespace palp
