// Cells and links that show how many pieces there are at most, in HDF5: the group `proof` of a list of pieces
// (pieces_file.h).
#pragma once

#include <string>

#include "corank/core/pieces.h"
#include "corank/result/hdf5_file.h"

namespace corank::result {

/// n: all variables, `dimension` of them free. Layout: doc/certificates.md. Throw ResultFileError.
void write_piece_proof(Hdf5Writer& file, const std::string& group, const PieceProof& proof, std::size_t n,
                       std::size_t dimension);
PieceProof read_piece_proof(Hdf5Reader& file, const std::string& group, std::size_t n, std::size_t dimension);

}  // namespace corank::result
