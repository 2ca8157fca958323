#pragma once

#include "app/study/cluster/ClusterJob.h"

namespace palp {

/// Quotes a word for the shell, whatever its characters.
std::string shellWord(const std::string& word);

/// palp with the job's arguments, but for output and shard, for the shell.
std::string commandOf(const ClusterJob& job);

/// Of the sample files: ".h5"; nothing for a study.
std::string extensionOf(const ClusterJob& job);

/// Numbers in order as Slurm's --array takes them: "1-4,7".
std::string asRanges(const std::vector<int>& numbers);

} // namespace palp
