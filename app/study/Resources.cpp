#include "app/study/Resources.h"

#include "model/base/Error.h"

namespace palp {

namespace fs = std::filesystem;

fs::path resource(const std::string& name) {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path installed = program.parent_path().parent_path() / "share" / "palp" / name;
  if (fs::exists(installed, none)) return installed;
  const fs::path inSources = fs::path(PALP_RESOURCES_DIR) / name;
  if (fs::exists(inSources, none)) return inSources;
  throw Error(name + ": does not belong to this installation; looked for " + installed.string() + " and " +
              inSources.string());
}

} // namespace palp
