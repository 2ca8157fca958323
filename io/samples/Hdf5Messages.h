#pragma once

// Private to io: what palp and palp-hdf5, the process that reads HDF5 files for it, say to each other through a socket
// of one machine. Each request is answered by one Hdf5Reply and its bytes.

#include "io/samples/Hdf5.h"

#include <cstdint>

namespace palp {

enum class Hdf5Question : std::uint32_t {
  Attributes, ///< name, value, name, value ..., each ended by a zero
  Texts,      ///< of a dataset, each ended by a zero
  Layout,  ///< whole numbers of 64 bits: rows of a chunk, shuffled and deflated or not, dimensions, shape, offset and
           ///< bytes of each chunk
  Rows,    ///< the numbers, `count` rows from `row` on
  Datasets ///< of numbers, in all groups: path, sizes separated by blanks, each ended by a zero
};

/// Shorter than a page, so that it is sent in one piece.
struct Hdf5Request {
  Hdf5Question question = Hdf5Question::Attributes;
  Hdf5Number number = Hdf5Number::Double;
  std::uint64_t row = 0, count = 0;
  std::uint64_t bytes = 0; ///< of the answer, where they are known
  char name[240] = {};     ///< of the dataset
};

struct Hdf5Reply {
  std::uint64_t refused = 0; ///< 1: what follows is the sentence of a refusal
  std::uint64_t bytes = 0;   ///< that follow
};

} // namespace palp
