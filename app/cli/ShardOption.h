#pragma once

#include "app/study/touch/SampleGenerator.h"

#include <string>

namespace palp {

/// --shard I/N, shards counted from 1, as a part of `total`; all of it where the text is empty. Throws UsageError.
SampleRange shardOption(const std::string& text, std::size_t total);

} // namespace palp
