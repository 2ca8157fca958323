#include "app/cli/ShardOption.h"

#include "app/cli/Options.h"

namespace palp {

SampleRange shardOption(const std::string& text, std::size_t total) {
  if (text.empty()) return {0, total};
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) throw badValue("--shard", text, "I/N, for example 1/4");
  const int count = wholeNumber("--shard (N)", text.substr(slash + 1), 1, 1'000'000);
  return shard(total, wholeNumber("--shard (I)", text.substr(0, slash), 1, count), count);
}

} // namespace palp
