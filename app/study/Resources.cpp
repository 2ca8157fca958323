#include "app/study/Resources.h"

#include "model/base/Error.h"

namespace palp {

namespace fs = std::filesystem;

fs::path resource(const std::string& name) {
  std::error_code none;
  const fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path(), above = folder.parent_path();
  std::string looked;
  for (const fs::path& place : {above / "share" / "palp", above.parent_path() / "resources",
                                fs::path(PALP_RESOURCES_DIR), fs::path("/usr/share/palp")}) {
    if (fs::exists(place / name, none)) return place / name;
    looked += (looked.empty() ? "" : ", ") + place.string();
  }
  throw Error(name + ": this file of palp's own is missing; looked in " + looked);
}

} // namespace palp
