#include "io/samples/FillBeside.h"

#include "model/base/Error.h"

namespace palp {

void fillBeside(const AtomicFile& target, const std::filesystem::path& path,
                const std::function<void(const std::filesystem::path&)>& write) {
  const std::string beside = target.beside().string();
  try {
    write(target.beside());
  } catch (const Error& error) {
    std::string words = error.what();
    const std::size_t at = words.find(beside);
    if (at == std::string::npos) throw;
    throw Error(words.replace(at, beside.size(), path.string()));
  }
}

} // namespace palp
