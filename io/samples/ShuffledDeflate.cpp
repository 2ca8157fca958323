#include "io/samples/ShuffledDeflate.h"

#include <libdeflate.h> // inflates three times as fast as zlib; zlib alone changes its level within a stream
#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
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

template <class Word> void unshuffle(const unsigned char* planes, std::size_t count, unsigned char* numbers) {
  for (std::size_t i = 0; i < count; ++i) {
    Word word = 0;
    for (std::size_t plane = 0; plane < sizeof(Word); ++plane)
      word |= static_cast<Word>(static_cast<Word>(planes[plane * count + i]) << (8 * plane));
    std::memcpy(numbers + i * sizeof(Word), &word, sizeof(Word));
  }
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

bool inflateShuffled(std::span<const unsigned char> packed, std::size_t width, std::span<unsigned char> numbers) {
  const auto planes = std::make_unique_for_overwrite<unsigned char[]>(numbers.size());
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!inflater) throw std::bad_alloc();
  if (libdeflate_zlib_decompress(inflater.get(), packed.data(), packed.size(), planes.get(), numbers.size(), nullptr) !=
      LIBDEFLATE_SUCCESS)
    return false; // with the check sum, too
  const std::size_t count = numbers.size() / width;
  if (width == sizeof(std::uint64_t))
    unshuffle<std::uint64_t>(planes.get(), count, numbers.data());
  else
    unshuffle<std::uint32_t>(planes.get(), count, numbers.data());
  return true;
}

} // namespace palp
