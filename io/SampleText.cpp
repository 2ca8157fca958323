#include "io/SampleText.h"

#include "io/SampleFile.h"
#include "io/SampleHead.h"
#include "io/samples/SampleArrays.h"

#include <algorithm>
#include <sstream>

namespace palp {

std::string samplesText(const SampleSet& set) {
  std::string text = sampleFileHead(set);
  appendSampleLines(text, set, 0, set.size());
  return text;
}

SampleSet parseSamples(const std::string& text, const std::string& name) {
  std::istringstream stream(text);
  SampleLines lines(stream, name);
  SampleSet set = readSampleHead(lines);
  resizeSamples(set, std::count(text.begin(), text.end(), '\n')); // more than there are: the head has lines, too
  std::string line;
  Eigen::Index count = 0;
  for (; lines.next(line); ++count) readSampleLine(lines, line, set, count);
  resizeSamples(set, count);
  return set;
}

} // namespace palp
