#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace palp {

/// What a board was seen to read at rest. It belongs to the board and its sensor, not to a network.
struct Tare {
  Eigen::MatrixXd rest_ohm; ///< row-wires x column-wires
  double noise = 0;         ///< relative, of one reading
  int frames = 0;           ///< that were averaged
};

/// As bytes of a recording: u16 row-wires, u16 column-wires, u32 frames, f64 noise, f64 each resistance [ohm],
/// column by column; little-endian.
std::vector<std::uint8_t> encode(const Tare& tare);
/// None where the bytes are not a tare of a board of this size.
std::optional<Tare> decodeTare(std::span<const std::uint8_t> bytes, int rowWires, int columnWires);

} // namespace palp
