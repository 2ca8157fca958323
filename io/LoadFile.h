#pragma once

#include "model/LoadCase.h"

#include <filesystem>
#include <vector>

namespace palp {

class JsonPlace;

/// An indenter as files hold it: `shape`, `radius_mm`, `rim_mm`, `place_mm`, `friction` and either `force_N` or
/// `depth_mm` and `shift_mm`. Radius (of a plane), rim, friction and shift may be absent: they are 0. Throws Error;
/// whether it can press is for whyInvalid to say.
Indenter readIndenter(const JsonPlace& place);

/// A path of loads (formats.md): a list of steps, each `{ "indenters": [ ... ] }`. Throws Error that names file, key
/// and value.
std::vector<LoadCase> loadPath(const std::filesystem::path& file);
/// The same of a file's content.
std::vector<LoadCase> parseLoadPath(const std::string& content, const std::string& file);

} // namespace palp
