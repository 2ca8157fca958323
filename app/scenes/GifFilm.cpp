#include "app/scenes/GifFilm.h"

#include "model/base/Error.h"

#include <gif_lib.h>

#include <algorithm>
#include <limits>

namespace palp {

namespace {

constexpr int kBits = 5; ///< of a channel, in which colours differ
constexpr std::size_t kBins = std::size_t{1} << (3 * kBits);
constexpr std::size_t kColors = 256;
constexpr int kLongest_px = 65535; ///< that the format can say

std::size_t binOf(const std::uint8_t* rgb) {
  return static_cast<std::size_t>(rgb[0] >> 3) << (2 * kBits) | static_cast<std::size_t>(rgb[1] >> 3) << kBits |
         static_cast<std::size_t>(rgb[2] >> 3);
}

/// The pixels of a bin: how many there are, and the sum of their colours.
struct Bin {
  std::uint64_t count = 0;
  std::array<std::uint64_t, 3> sum{};

  [[nodiscard]] double mean(std::size_t channel) const {
    return static_cast<double>(sum[channel]) / static_cast<double>(count);
  }
};

/// Bins of similar colours, that become one colour of the palette.
struct Box {
  std::vector<const Bin*> bins;
  std::size_t longest = 0; ///< channel
  double error = 0;        ///< pixels times the square of the longest side

  explicit Box(std::vector<const Bin*> of) : bins(std::move(of)) {
    double side = 0;
    std::uint64_t count = 0;
    for (const Bin* bin : bins) count += bin->count;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax_element(bins.begin(), bins.end(),
                                                   [c](const Bin* a, const Bin* b) { return a->mean(c) < b->mean(c); });
      if ((*high)->mean(c) - (*low)->mean(c) <= side) continue;
      side = (*high)->mean(c) - (*low)->mean(c);
      longest = c;
    }
    error = bins.size() > 1 ? static_cast<double>(count) * side * side : 0;
  }

  /// The half with the larger values of the longest side leaves.
  Box split() {
    std::sort(bins.begin(), bins.end(), [c = longest](const Bin* a, const Bin* b) { return a->mean(c) < b->mean(c); });
    std::uint64_t all = 0, lower = 0;
    for (const Bin* bin : bins) all += bin->count;
    auto middle = bins.begin();
    while (middle != bins.end() - 1 && (middle == bins.begin() || 2 * lower < all)) lower += (*middle++)->count;
    Box upper({middle, bins.end()});
    *this = Box({bins.begin(), middle});
    return upper;
  }

  [[nodiscard]] std::array<std::uint8_t, 3> color() const {
    Bin all;
    for (const Bin* bin : bins) {
      all.count += bin->count;
      for (std::size_t c = 0; c < 3; ++c) all.sum[c] += bin->sum[c];
    }
    std::array<std::uint8_t, 3> mean{};
    for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>(all.mean(c) + 0.5);
    return mean;
  }
};

int append(GifFileType* file, const GifByteType* bytes, int count) {
  static_cast<std::string*>(file->UserData)
      ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
  return count;
}

} // namespace

struct GifFilm::Encoder {
  GifFileType* file = nullptr;

  Encoder() = default;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() {
    int ignored = 0;
    if (file != nullptr) EGifCloseFile(file, &ignored);
  }
};

GifFilm::GifFilm(const std::vector<Picture>& typical)
    : width_(typical.at(0).width), height_(typical.at(0).height), indices_(kBins, -1),
      encoder_(std::make_unique<Encoder>()) {
  if (width_ > kLongest_px || height_ > kLongest_px) throw Error("a GIF has at most 65535 pixels each way");
  choosePalette(typical);
  int why = 0;
  encoder_->file = EGifOpen(&content_, append, &why);
  if (encoder_->file == nullptr) throw Error(std::string("the GIF cannot be made: ") + GifErrorString(why));
  EGifSetGifVersion(encoder_->file, true);
  std::vector<GifColorType> colors(kColors);
  for (std::size_t k = 0; k < palette_.size(); ++k) colors[k] = {palette_[k][0], palette_[k][1], palette_[k][2]};
  ColorMapObject* map = GifMakeMapObject(static_cast<int>(kColors), colors.data());
  check(map != nullptr && EGifPutScreenDesc(encoder_->file, width_, height_, 8, 0, map) == GIF_OK);
  GifFreeMapObject(map);
  constexpr std::array<GifByteType, 3> kForEver{1, 0, 0};
  check(EGifPutExtensionLeader(encoder_->file, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
        EGifPutExtensionBlock(encoder_->file, 11, "NETSCAPE2.0") == GIF_OK &&
        EGifPutExtensionBlock(encoder_->file, 3, kForEver.data()) == GIF_OK &&
        EGifPutExtensionTrailer(encoder_->file) == GIF_OK);
}

GifFilm::~GifFilm() = default;

void GifFilm::check(bool good) const {
  if (good) return;
  const char* why = GifErrorString(encoder_->file->Error);
  throw Error(std::string("the GIF cannot be made: ") + (why != nullptr ? why : "no memory"));
}

void GifFilm::choosePalette(const std::vector<Picture>& typical) {
  std::vector<Bin> bins(kBins);
  for (const Picture& picture : typical)
    for (std::size_t at = 0; at + 2 < picture.rgb.size(); at += 3) {
      Bin& bin = bins[binOf(picture.rgb.data() + at)];
      ++bin.count;
      for (std::size_t c = 0; c < 3; ++c) bin.sum[c] += picture.rgb[at + c];
    }
  std::vector<const Bin*> used;
  for (const Bin& bin : bins)
    if (bin.count > 0) used.push_back(&bin);
  std::vector<Box> boxes{Box(std::move(used))};
  while (boxes.size() < kColors) {
    const auto worst =
        std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.error < b.error; });
    if (!(worst->error > 0)) break;
    Box upper = worst->split();
    boxes.push_back(std::move(upper));
  }
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    palette_.push_back(boxes[k].color());
    for (const Bin* bin : boxes[k].bins) indices_[static_cast<std::size_t>(bin - bins.data())] = static_cast<int>(k);
  }
}

std::uint8_t GifFilm::indexOf(const std::uint8_t* rgb) {
  int& index = indices_[binOf(rgb)];
  if (index < 0) { // in none of the typical pictures: the nearest colour
    int least = std::numeric_limits<int>::max();
    for (std::size_t k = 0; k < palette_.size(); ++k) {
      int away = 0;
      for (std::size_t c = 0; c < 3; ++c) away += (palette_[k][c] - rgb[c]) * (palette_[k][c] - rgb[c]);
      if (away >= least) continue;
      least = away;
      index = static_cast<int>(k);
    }
  }
  return static_cast<std::uint8_t>(index);
}

void GifFilm::add(const Picture& picture, int hundredths) {
  if (picture.width != width_ || picture.height != height_) throw Error("the pictures of a film are of one size");
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  std::vector<std::uint8_t> now(width * height);
  for (std::size_t pixel = 0; pixel < now.size(); ++pixel) now[pixel] = indexOf(picture.rgb.data() + 3 * pixel);
  // What stays as it was is left out: only the rectangle around the rest is written, at least one pixel.
  std::size_t left = 0, right = width - 1, top = 0, bottom = height - 1;
  if (!before_.empty()) {
    left = width - 1, right = 0, top = height - 1, bottom = 0;
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        if (now[y * width + x] == before_[y * width + x]) continue;
        left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
      }
    if (left > right) left = right = top = bottom = 0;
  }
  GraphicsControlBlock control{};
  control.DisposalMode = DISPOSE_DO_NOT;
  control.DelayTime = hundredths;
  control.TransparentColor = NO_TRANSPARENT_COLOR;
  std::array<GifByteType, 4> bytes{};
  EGifGCBToExtension(&control, bytes.data());
  const int columns = static_cast<int>(right - left + 1), rows = static_cast<int>(bottom - top + 1);
  check(EGifPutExtension(encoder_->file, GRAPHICS_EXT_FUNC_CODE, 4, bytes.data()) == GIF_OK &&
        EGifPutImageDesc(encoder_->file, static_cast<int>(left), static_cast<int>(top), columns, rows, false,
                         nullptr) == GIF_OK);
  before_ = now;
  for (std::size_t y = top; y <= bottom; ++y)
    check(EGifPutLine(encoder_->file, now.data() + y * width + left, columns) == GIF_OK);
}

std::string GifFilm::finish() {
  int why = 0;
  GifFileType* file = encoder_->file;
  encoder_->file = nullptr;
  if (EGifCloseFile(file, &why) != GIF_OK) throw Error(std::string("the GIF cannot be made: ") + GifErrorString(why));
  return std::move(content_);
}

} // namespace palp
