#include "io/samples/ShuffledDeflate.h"

#include <libdeflate.h> // inflates three times as fast as zlib; zlib alone changes its level within a stream
#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace palp {

namespace {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

constexpr std::size_t kLooked = 8192;      ///< bytes of a plane that are looked at
constexpr double kNoise_bits = 7;          ///< entropy of a byte above which deflate is not worth its time
constexpr std::size_t kRoomToSwitch = 256; ///< bytes of the stream that a change of level may take

/// Whether the bytes look random: their entropy (order zero) is near that of noise.
bool isNoise(std::span<const unsigned char> plane) {
  std::array<int, 256> counts{};
  const std::size_t step = std::max<std::size_t>(1, plane.size() / kLooked);
  int looked = 0;
  for (std::size_t i = 0; i < plane.size(); i += step, ++looked) ++counts[plane[i]];
  double bits = 0;
  for (const int count : counts)
    if (count > 0) bits -= count * std::log2(static_cast<double>(count) / looked);
  return bits > kNoise_bits * looked;
}

std::vector<unsigned char> shuffled(std::span<const unsigned char> numbers, std::size_t width) {
  std::vector<unsigned char> planes(numbers.size());
  const std::size_t count = numbers.size() / width;
  for (std::size_t plane = 0; plane < width; ++plane)
    for (std::size_t i = 0; i < count; ++i) planes[plane * count + i] = numbers[i * width + plane];
  return planes;
}

template <class Word>
void unshuffle(const unsigned char* planes, std::size_t count, std::size_t first, unsigned char* numbers) {
  for (std::size_t i = first; i < count; ++i) {
    Word word = 0;
    for (std::size_t plane = 0; plane < sizeof(Word); ++plane)
      word |= static_cast<Word>(static_cast<Word>(planes[plane * count + i]) << (8 * plane));
    std::memcpy(numbers + i * sizeof(Word), &word, sizeof(Word));
  }
}

// 16 bytes of any processor's vector unit (an extension of GCC's and Clang's).
using SixteenBytes = unsigned char __attribute__((vector_size(16)));
using EightPairs = std::uint16_t __attribute__((vector_size(16)));
using FourFours = std::uint32_t __attribute__((vector_size(16)));

/// Those of a and b in turn, of the lower halves and of the upper ones.
EightPairs lower(SixteenBytes a, SixteenBytes b) {
  return (EightPairs)__builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}
EightPairs upper(SixteenBytes a, SixteenBytes b) {
  return (EightPairs)__builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
}
FourFours lower(EightPairs a, EightPairs b) {
  return (FourFours)__builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
}
FourFours upper(EightPairs a, EightPairs b) {
  return (FourFours)__builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
}

/// 16 numbers of 8 bytes together: bytes to pairs, pairs to fours, fours to numbers. A fifth of the time of one by one.
void unshuffleDoubles(const unsigned char* planes, std::size_t count, unsigned char* numbers) {
  constexpr std::size_t kAtOnce = sizeof(SixteenBytes), kWidth = sizeof(double);
  std::size_t i = 0;
  for (; i + kAtOnce <= count; i += kAtOnce) {
    SixteenBytes plane[kWidth];
    for (std::size_t p = 0; p < kWidth; ++p) std::memcpy(&plane[p], planes + p * count + i, kAtOnce);
    EightPairs pairs[2][kWidth / 2]; // [half of the numbers][two of the planes]
    for (std::size_t p = 0; p < kWidth / 2; ++p) {
      pairs[0][p] = lower(plane[2 * p], plane[2 * p + 1]);
      pairs[1][p] = upper(plane[2 * p], plane[2 * p + 1]);
    }
    unsigned char* to = numbers + i * kWidth;
    for (const auto& half : pairs) {
      const FourFours fours[2][2] = {{lower(half[0], half[1]), lower(half[2], half[3])},
                                     {upper(half[0], half[1]), upper(half[2], half[3])}};
      for (const auto& [low, high] : fours) {
        const FourFours two[2] = {__builtin_shufflevector(low, high, 0, 4, 1, 5),
                                  __builtin_shufflevector(low, high, 2, 6, 3, 7)};
        std::memcpy(to, two, sizeof two);
        to += sizeof two;
      }
    }
  }
  unshuffle<std::uint64_t>(planes, count, i, numbers);
}

} // namespace

std::vector<unsigned char> shuffledDeflate(std::span<const unsigned char> numbers, std::size_t width) {
  std::vector<unsigned char> planes = shuffled(numbers, width);
  z_stream stream{};
  if (deflateInit(&stream, Z_BEST_SPEED) != Z_OK) throw std::bad_alloc();
  std::vector<unsigned char> packed(deflateBound(&stream, numbers.size()) + width * kRoomToSwitch);
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  const std::size_t count = numbers.size() / width;
  int result = Z_OK;
  for (std::size_t plane = 0; plane < width; ++plane) {
    const std::span<unsigned char> bytes(planes.data() + plane * count, count);
    result = deflateParams(&stream, isNoise(bytes) ? Z_NO_COMPRESSION : Z_BEST_SPEED, Z_DEFAULT_STRATEGY);
    stream.next_in = bytes.data();
    stream.avail_in = static_cast<uInt>(bytes.size());
    if (result == Z_OK) result = deflate(&stream, plane + 1 < width ? Z_NO_FLUSH : Z_FINISH);
    if (result != Z_OK) break;
  }
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::logic_error("zlib had too little room for a chunk of samples");
  return packed;
}

ShuffledInflate::ShuffledInflate() : inflater_(libdeflate_alloc_decompressor()) {
  if (inflater_ == nullptr) throw std::bad_alloc();
}

ShuffledInflate::~ShuffledInflate() {
  libdeflate_free_decompressor(inflater_);
}

bool ShuffledInflate::inflate(std::span<const unsigned char> packed, std::size_t width,
                              std::span<unsigned char> numbers) {
  if (planes_.size() < numbers.size()) planes_.resize(numbers.size());
  if (libdeflate_zlib_decompress(inflater_, packed.data(), packed.size(), planes_.data(), numbers.size(), nullptr) !=
      LIBDEFLATE_SUCCESS)
    return false; // with the check sum, too
  const std::size_t count = numbers.size() / width;
  if (width == sizeof(double))
    unshuffleDoubles(planes_.data(), count, numbers.data());
  else
    unshuffle<std::uint32_t>(planes_.data(), count, 0, numbers.data());
  return true;
}

} // namespace palp
