#include "io/samples/Hdf5Samples.h"

#include "io/samples/Hdf5.h"
#include "io/samples/Hdf5Child.h"
#include "io/samples/ShuffledDeflate.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr Eigen::Index kChunksAtOnce = 8;            ///< of all arrays, so that every core has some
constexpr std::uint64_t kMostPacked = 1100;          ///< deflate packs 1032 bytes into one at best
constexpr std::size_t kLargestChunk_bytes = 1 << 26; ///< larger ones of other programs are left to the library

/// One dataset of the file.
struct Field {
  std::string name;
  Hdf5Number number = Hdf5Number::Double;
  std::vector<std::uint64_t> shape;             ///< samples first
  Eigen::MatrixXd SampleSet::*values = nullptr; ///< null: the areas

  [[nodiscard]] std::size_t rowBytes() const {
    std::size_t bytes = width(number);
    for (std::size_t i = 1; i < shape.size(); ++i) bytes *= shape[i];
    return bytes;
  }
  /// Where the numbers of a sample begin.
  [[nodiscard]] unsigned char* at(SampleSet& set, Eigen::Index sample) const {
    return values == nullptr ? reinterpret_cast<unsigned char*>(set.area.data() + sample)
                             : reinterpret_cast<unsigned char*>((set.*values).col(sample).data());
  }
};

std::vector<Field> fieldsOf(const SampleSet& head, Eigen::Index samples) {
  const auto count = static_cast<std::uint64_t>(samples);
  std::vector<Field> fields{{kAreaArray, Hdf5Number::Int32, {count}, nullptr}};
  for (const SampleArray& array : sampleArrays(head)) {
    fields.push_back({array.name, Hdf5Number::Double, {count}, array.values});
    fields.back().shape.insert(fields.back().shape.end(), array.shape.begin(), array.shape.end());
  }
  return fields;
}

std::string shapeText(const std::vector<std::uint64_t>& shape) {
  std::string text;
  for (const std::uint64_t size : shape) text += (text.empty() ? "" : " x ") + std::to_string(size);
  return text;
}

/// A value that is not finite gives NaN when it is multiplied by 0. Eigen's allFinite takes three times as long.
bool isFinite(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  return (values.array() * 0).sum() == 0;
}

class Hdf5Samples : public SampleReader {
public:
  Hdf5Samples(const fs::path& path, const std::stop_token& stop) : path_(path), file_(path, stop) {
    head_ = headFrom(path, file_.attributes(), file_.texts(kColumnsArray));
    const std::vector<std::uint64_t> shape = file_.layout(kAreaArray, Hdf5Number::Int32).shape;
    if (shape[0] > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
      file_.refuse("samples: " + gotExpected(std::to_string(shape[0]), "up to 2147483647"));
    size_ = static_cast<Eigen::Index>(shape[0]);
    fields_ = fieldsOf(head_, size_);
    for (const Field& field : fields_) {
      Hdf5Layout& layout = layouts_.emplace_back(file_.layout(field.name, field.number));
      if (layout.shape != field.shape)
        file_.refuse(
            "dataset " + field.name + ": " +
            gotExpected(shapeText(layout.shape) + " numbers", shapeText(field.shape) + " by the head and the areas"));
      if (layout.chunkRows > kLargestChunk_bytes / field.rowBytes() || layout.chunks.empty() ||
          layout.chunks.size() < (layout.shape[0] + layout.chunkRows - 1) / layout.chunkRows)
        layout.shuffledDeflate = false;
      if (layout.shape[0] > (kMostPacked * file_.fileBytes()) / field.rowBytes())
        file_.refuse("is damaged: dataset " + field.name + " of " + shapeText(layout.shape) +
                     " numbers is more than a file of " + std::to_string(file_.fileBytes()) + " bytes can contain");
    }
  }

  [[nodiscard]] const SampleSet& head() const override { return head_; }
  [[nodiscard]] std::optional<Eigen::Index> size() const override { return size_; }

  Eigen::Index read(SampleSet& set, Eigen::Index first, Eigen::Index count, const std::stop_token& stop) override {
    count = std::min(count, size_ - next_);
    struct Piece {
      std::size_t field;
      Eigen::Index row, rows; ///< of the file
    };
    std::vector<Piece> pieces;
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      const auto most = static_cast<Eigen::Index>(std::max<std::uint64_t>(1, layouts_[f].chunkRows));
      const Eigen::Index atOnce = layouts_[f].chunkRows > 0 ? most : samplesAtOnce(head_);
      for (Eigen::Index row = next_; row < next_ + count;) {
        const Eigen::Index end = std::min(next_ + count, (row / atOnce + 1) * atOnce);
        pieces.push_back({f, row, end - row});
        row = end;
      }
    }
    std::atomic<bool> finite{true};
    std::atomic<std::size_t> taken{0};
    const auto threads = static_cast<std::size_t>(threadCount(0));
    inParallel(std::min(threads, pieces.size()), 0, [&](std::size_t) {
      Scratch scratch;
      for (std::size_t p = taken++; p < pieces.size(); p = taken++) {
        throwIfStopped(stop);
        const auto [f, row, rows] = pieces[p];
        readPiece(f, row, rows, set, first + row - next_, scratch);
        const auto values = fields_[f].values;
        if (values != nullptr && !isFinite((set.*values).middleCols(first + row - next_, rows))) finite = false;
      }
    });
    requireSamples(path_, set, first, count, next_ - first, finite);
    next_ += count;
    return count;
  }

private:
  /// Of one thread: a chunk as it is stored, and one of which not all rows are wanted.
  struct Scratch {
    std::vector<unsigned char> packed, numbers;
    ShuffledInflate inflate;
  };

  /// Rows within one chunk.
  void readPiece(std::size_t f, Eigen::Index row, Eigen::Index rows, SampleSet& set, Eigen::Index column,
                 Scratch& scratch) const {
    const Field& field = fields_[f];
    if (!layouts_[f].shuffledDeflate) {
      const auto start = static_cast<std::uint64_t>(row), number = static_cast<std::uint64_t>(rows);
      const std::size_t numbers = number * (field.rowBytes() / width(field.number));
      if (field.values == nullptr)
        file_.readRows(field.name, start, number, std::span(set.area.data() + column, numbers));
      else
        file_.readRows(field.name, start, number, std::span((set.*field.values).col(column).data(), numbers));
      return;
    }
    const auto chunkRows = static_cast<Eigen::Index>(layouts_[f].chunkRows);
    const Eigen::Index chunk = row / chunkRows * chunkRows;
    const auto packed =
        file_.readChunk(layouts_[f].chunks[static_cast<std::size_t>(chunk / chunkRows)], scratch.packed);
    const std::size_t chunkBytes = field.rowBytes() * layouts_[f].chunkRows;
    const bool whole = rows == chunkRows;
    if (!whole) scratch.numbers.resize(chunkBytes);
    unsigned char* const to = field.at(set, column);
    if (!scratch.inflate.inflate(packed, width(field.number),
                                 whole ? std::span(to, chunkBytes) : std::span(scratch.numbers)))
      file_.refuse("dataset " + field.name + ", samples from " + std::to_string(chunk) + " on: the file is damaged");
    if (!whole)
      std::memcpy(to, scratch.numbers.data() + static_cast<std::size_t>(row - chunk) * field.rowBytes(),
                  static_cast<std::size_t>(rows) * field.rowBytes());
  }

  fs::path path_;
  Hdf5Child file_;
  SampleSet head_;
  Eigen::Index size_ = 0, next_ = 0;
  std::vector<Field> fields_;
  std::vector<Hdf5Layout> layouts_;
};

} // namespace

std::unique_ptr<SampleReader> openHdf5Samples(const fs::path& path, const std::stop_token& stop) {
  return std::make_unique<Hdf5Samples>(path, stop);
}

void writeHdf5Samples(const fs::path& path, const SampleRows& rows, const std::stop_token& stop) {
  Hdf5File file(path, Hdf5File::Open::ForWriting);
  const Eigen::Index chunk = samplesAtOnce(rows.head);
  for (const auto& [key, value] : headValues(rows.head)) file.setAttribute("", key, value);
  file.addTexts(kColumnsArray, columnNames(rows.head));
  file.addTexts(kNamesArray, arrayNames(rows.head));
  const std::vector<Field> fields = fieldsOf(rows.head, rows.count);
  for (const Field& field : fields)
    file.addDataset(field.name, field.number, field.shape, static_cast<std::uint64_t>(chunk));
  for (const SampleArray& array : sampleArrays(rows.head)) file.setAttribute(array.name, "unit", array.unit);
  for (Eigen::Index first = 0; first < rows.count; first += kChunksAtOnce * chunk) {
    throwIfStopped(stop);
    SampleSet block = rows.block(first, std::min(kChunksAtOnce * chunk, rows.count - first));
    const Eigen::Index samples = block.size(), chunks = (samples + chunk - 1) / chunk;
    resizeSamples(block, chunks * chunk);
    if (chunks * chunk > samples) { // the rest of a chunk is zeros
      block.area.tail(chunks * chunk - samples).setZero();
      for (const SampleArray& array : sampleArrays(block))
        (block.*array.values).rightCols(chunks * chunk - samples).setZero();
    }
    std::vector<std::vector<unsigned char>> packed(fields.size() * static_cast<std::size_t>(chunks));
    inParallel(packed.size(), 0, [&](std::size_t p) {
      const Field& field = fields[p % fields.size()];
      const auto place = static_cast<Eigen::Index>(p / fields.size()) * chunk;
      packed[p] = shuffledDeflate({field.at(block, place), field.rowBytes() * static_cast<std::size_t>(chunk)},
                                  width(field.number));
    });
    for (std::size_t p = 0; p < packed.size(); ++p)
      file.writeChunk(fields[p % fields.size()].name,
                      static_cast<std::uint64_t>(first + static_cast<Eigen::Index>(p / fields.size()) * chunk),
                      packed[p]);
  }
  file.close();
}

} // namespace palp
