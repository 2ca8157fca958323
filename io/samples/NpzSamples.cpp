#include "io/samples/NpzSamples.h"

#include "io/samples/Npz.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <algorithm>
#include <limits>

namespace palp {

namespace fs = std::filesystem;

namespace {

template <class Number> std::span<const unsigned char> bytesOf(const Number* numbers, Eigen::Index count) {
  return {reinterpret_cast<const unsigned char*>(numbers), static_cast<std::size_t>(count) * sizeof(Number)};
}

std::string sizesText(const std::vector<std::uint64_t>& shape) {
  std::string text;
  for (const std::uint64_t size : shape) text += (text.empty() ? "" : " x ") + std::to_string(size);
  return text.empty() ? "one number" : text;
}

class NpzSamples : public SampleReader {
public:
  explicit NpzSamples(const fs::path& path) : path_(path) {
    std::map<std::string, std::string> values;
    const std::map<std::string, NpyHead> all = npzArrays(path);
    for (const auto& [name, what] : all)
      if (what.shape.empty()) values.emplace(name, NpzArray(path, name).texts().at(0));
    head_ = headFrom(path, values, NpzArray(path, kColumnsArray).texts());
    area_ = std::make_unique<NpzArray>(path, kAreaArray);
    const std::vector<std::uint64_t>& shape = area_->head().shape;
    if (shape.size() != 1 || shape[0] > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
      area_->refuse(gotExpected(sizesText(shape), "one whole number per sample"));
    size_ = static_cast<Eigen::Index>(shape[0]);
    for (const SampleArray& array : sampleArrays(head_)) {
      auto& numbers = arrays_.emplace_back(std::make_unique<NpzArray>(path, array.name), array.values).first;
      std::vector<std::uint64_t> wanted{shape[0]};
      wanted.insert(wanted.end(), array.shape.begin(), array.shape.end());
      if (numbers->head().shape != wanted || numbers->head().isText())
        numbers->refuse("got " + sizesText(numbers->head().shape) + ", expected, by the head and the areas, " +
                        sizesText(wanted) + " numbers");
    }
  }

  [[nodiscard]] const SampleSet& head() const override { return head_; }
  [[nodiscard]] std::optional<Eigen::Index> size() const override { return size_; }

  Eigen::Index read(SampleSet& set, Eigen::Index first, Eigen::Index count, const std::stop_token& stop) override {
    count = std::min(count, size_ - next_);
    const Eigen::Index atOnce = samplesAtOnce(head_);
    for (Eigen::Index done = 0; done < count; done += atOnce) {
      throwIfStopped(stop);
      const Eigen::Index part = std::min(atOnce, count - done), column = first + done;
      area_->read(std::span<std::int32_t>(set.area.data() + column, static_cast<std::size_t>(part)));
      for (const auto& [numbers, values] : arrays_) {
        Eigen::MatrixXd& matrix = set.*values;
        numbers->read({matrix.col(column).data(), static_cast<std::size_t>(matrix.rows() * part)});
      }
      requireSamples(path_, set, column, part, next_ - column);
      next_ += part;
    }
    return count;
  }

private:
  fs::path path_;
  SampleSet head_;
  Eigen::Index size_ = 0, next_ = 0;
  std::unique_ptr<NpzArray> area_;
  std::vector<std::pair<std::unique_ptr<NpzArray>, Eigen::MatrixXd SampleSet::*>> arrays_;
};

} // namespace

std::unique_ptr<SampleReader> openNpzSamples(const fs::path& path) {
  return std::make_unique<NpzSamples>(path);
}

void writeNpzSamples(const fs::path& path, const SampleRows& rows, const std::stop_token& stop) {
  NpzWriter file(path);
  const auto count = static_cast<std::uint64_t>(rows.count);
  for (const auto& [key, value] : headValues(rows.head)) file.scalar(key, value);
  file.texts(kColumnsArray, columnNames(rows.head));
  file.texts(kNamesArray, arrayNames(rows.head));
  const Eigen::Index atOnce = samplesAtOnce(rows.head);
  const auto forBlocks = [&](const auto& work) {
    for (Eigen::Index first = 0; first < rows.count; first += atOnce) {
      throwIfStopped(stop);
      work(rows.block(first, std::min(atOnce, rows.count - first)));
    }
    file.end();
  };
  file.begin(kAreaArray, "<i4", {count});
  forBlocks([&](const SampleSet& block) { file.write(bytesOf(block.area.data(), block.area.size())); });
  for (const SampleArray& array : sampleArrays(rows.head)) {
    std::vector<std::uint64_t> shape{count};
    shape.insert(shape.end(), array.shape.begin(), array.shape.end());
    file.begin(array.name, "<f8", shape);
    forBlocks([&](const SampleSet& block) {
      const Eigen::MatrixXd& values = block.*array.values;
      file.write(bytesOf(values.data(), values.size()));
    });
  }
  file.close();
}

} // namespace palp
