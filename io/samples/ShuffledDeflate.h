#pragma once

// Private to io.

#include <cstddef>
#include <span>
#include <vector>

struct libdeflate_decompressor;

namespace palp {

/// Numbers of `width` bytes as HDF5's filters shuffle and deflate store them: first bytes of all, then second bytes
/// ..., as one stream of zlib (RFC 1950), which every reader of HDF5 can inflate. Bytes that look like noise, as the
/// low ones of a mantissa, are stored in it as they are: to compress them takes most of the time and gains nothing.
std::vector<unsigned char> shuffledDeflate(std::span<const unsigned char> numbers, std::size_t width);

/// The inverse, with memory that is used again for the next chunk: for one thread.
class ShuffledInflate {
public:
  ShuffledInflate();
  ~ShuffledInflate();
  ShuffledInflate(const ShuffledInflate&) = delete;
  ShuffledInflate& operator=(const ShuffledInflate&) = delete;

  /// False where the stream is damaged or does not give as many bytes as `numbers` holds.
  bool inflate(std::span<const unsigned char> packed, std::size_t width, std::span<unsigned char> numbers);

private:
  libdeflate_decompressor* inflater_;
  std::vector<unsigned char> planes_;
};

} // namespace palp
