// Private to Blobby: parses the arrays of a Blobby request into its field.
#pragma once
#include "reyes/prim/blobby_field.h"
#include "reyes/prim_factories.h"

namespace tomales {

struct BlobProgram {
  BlobField field;
  Box box;           ///< Outside of it the field is constant.
  size_t leafCount;  ///< Number of leaves for which primitive variables have values, in the order of the leaves.
};

/// Codes (PRMan): leaves 1000 constant, 1001 ellipsoid, 1002 segment; operations 0 add, 1 multiply, 2 maximum, 3
/// minimum (a count and operands), 4 divide, 5 subtract (two operands), 6 negate, 7 identity (one). Operands are
/// numbers of earlier codes. 1003 is a ground that repels; it has a string, the name of its depth picture, and four
/// floats (blobby_ground.h). Leaves that cannot be made count as 0 everywhere: 1003 without its picture and, with a
/// sentence in `problems`, leaves without size and 1004, which is a plugin's. Throws PrimError if the arrays do not fit
/// each other.
BlobProgram readBlobProgram(const std::vector<int>& code, const std::vector<float>& floats, const GroundReader& grounds,
                            Problems& problems);

}  // namespace tomales
