#include "io/board/Tare.h"

#include "io/board/ByteOrder.h"

#include <cmath>
#include <cstring>

namespace palp {

namespace {

constexpr std::size_t kHead = 16; // bytes before the resistances

} // namespace

std::vector<std::uint8_t> encode(const Tare& tare) {
  const auto count = static_cast<std::size_t>(tare.rest_ohm.size());
  std::vector<std::uint8_t> bytes(kHead + count * sizeof(double));
  const std::span<std::uint8_t> all(bytes);
  putLittleEndian<2>(all, 0, static_cast<std::uint32_t>(tare.rest_ohm.rows()));
  putLittleEndian<2>(all, 2, static_cast<std::uint32_t>(tare.rest_ohm.cols()));
  putLittleEndian<4>(all, 4, static_cast<std::uint32_t>(tare.frames));
  std::memcpy(bytes.data() + 8, &tare.noise, sizeof(double));
  std::memcpy(bytes.data() + kHead, tare.rest_ohm.data(), count * sizeof(double));
  return bytes;
}

std::optional<Tare> decodeTare(std::span<const std::uint8_t> bytes, int rowWires, int columnWires) {
  const auto count = static_cast<std::size_t>(rowWires) * static_cast<std::size_t>(columnWires);
  if (bytes.size() != kHead + count * sizeof(double)) return {};
  if (littleEndian<2>(bytes, 0) != static_cast<std::uint32_t>(rowWires) ||
      littleEndian<2>(bytes, 2) != static_cast<std::uint32_t>(columnWires))
    return {};
  Tare tare;
  const auto frames = littleEndian<4>(bytes, 4);
  if (frames < 1 || frames > 1'000'000) return {};
  tare.frames = static_cast<int>(frames);
  std::memcpy(&tare.noise, bytes.data() + 8, sizeof(double));
  tare.rest_ohm.resize(rowWires, columnWires);
  std::memcpy(tare.rest_ohm.data(), bytes.data() + kHead, count * sizeof(double));
  const bool good = std::isfinite(tare.noise) && tare.noise >= 0 && tare.rest_ohm.allFinite();
  return good ? std::optional(std::move(tare)) : std::nullopt;
}

} // namespace palp
