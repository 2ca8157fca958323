#pragma once

// Private to io.

#include <cstddef>
#include <span>
#include <vector>

namespace palp {

/// Numbers of `width` bytes as HDF5's filters shuffle and deflate store them: first bytes of all, then second bytes
/// ..., as one stream of zlib (RFC 1950), which every reader of HDF5 can inflate. Bytes that look like noise, as the
/// low ones of a mantissa, are stored in it as they are: to compress them takes most of the time and gains nothing.
std::vector<unsigned char> shuffledDeflate(std::span<const unsigned char> numbers, std::size_t width);

/// The way back; false where the stream is damaged or does not give as many bytes as `numbers` holds.
bool inflateShuffled(std::span<const unsigned char> packed, std::size_t width, std::span<unsigned char> numbers);

} // namespace palp
