// Noun: point clouds as PLY, the format in which programs exchange points. It is streamed: a cloud need not fit in
// memory.
//   x y z, nx ny nz, radius, then the channels: NAME for one float, NAME_0 NAME_1 ... for several
// Files that are read may be ASCII or binary of either byte order, with any scalar types. red green blue become the
// channel "Cs" (bytes as 0..1); other properties become channels, runs of NAME_0 NAME_1 ... one of several floats;
// other elements are skipped. A comment in the header of our own files holds a checksum of the rest of the header and
// of the vertices, which is compared when they are read.
// Threads: each call runs on its caller's thread.
#pragma once
#include "gi/point_file.h"

namespace tomales {

/// Writes binary, little-endian. Throws FileError.
void writePly(const PointFile& cloud, const std::string& path);

struct PlyFigures {
  uint64_t points = 0;
  uint64_t dropped = 0;  ///< Points with a number that is not finite, or a negative radius.
};

/// Converts PLY to .ptc, in the order of the file. `radius`: for points that have none. Normals are normalised. Throws
/// FileError if the file is no PLY, has no x y z or a list among the properties of its vertices, is shorter or longer
/// than it says, has a wrong checksum, or holds lengths of more than 1e18.
PlyFigures convertPly(const std::string& path, const std::string& out, float radius);

}  // namespace tomales
