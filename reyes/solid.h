// Noun: a solid of RISpec 3.2 section 5.9 (SolidBegin ... SolidEnd): an expression over primitives, each of which is
// the closed surface of the geometry in one SolidBegin "primitive" block. SolidWalk is the state of a walk along a line
// through it, which finds the crossings that are surfaces of the whole.
// Threads: a Solid is immutable once built; each SolidWalk belongs to one thread.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace tomales {

enum class SolidOperation : uint8_t { Primitive, Union, Intersection, Difference };

class Solid {
 public:
  /// Adds a block inside block `parent` (-1 for the outermost, block 0) and returns its number. The further operands of
  /// a difference are subtracted from the first.
  int add(SolidOperation operation, int parent);

  int blockCount() const { return static_cast<int>(blocks_.size()); }
  SolidOperation operation(int block) const { return at(block).operation; }
  int parent(int block) const { return at(block).parent; }
  /// Returns the number of blocks around this one, and itself.
  int depth(int block) const { return block < 0 ? 0 : 1 + depth(at(block).parent); }
  /// Tells whether the solid lies on the other side of this primitive's surface, because an odd number of differences
  /// subtracts it.
  bool subtracted(int block) const;

 private:
  friend class SolidWalk;
  struct Block {
    SolidOperation operation;
    int parent;
    bool takenAway;  ///< True if it is a further operand of a difference, and so subtracted.
    int operands = 0;
  };
  const Block& at(int block) const { return blocks_[static_cast<size_t>(block)]; }
  std::vector<Block> blocks_;
};

/// A crossing of a line with the surface of a primitive.
struct SolidCrossing {
  int block;     ///< A primitive block of the solid.
  bool leaving;  ///< The line goes to the side that the normals of the primitive point to, all to the same.
  float t;       ///< Any parameter that grows along the line.
  /// Distance in t within which the same point of the surface may be found again, where two pieces of it overlap.
  float reach;
  float slack;  ///< Error bound of t.
};

/// A crossing at which the line enters or leaves the solid.
struct SolidBoundary {
  uint32_t crossing;
  bool entering;
};

/// Walks along lines that end outside of everything, as all lines do that are followed far enough. The number of a
/// primitive's crossings tells whether a line begins inside of it, so the eye may be inside of one.
class SolidWalk {
 public:
  explicit SolidWalk(const Solid& solid);

  /// Finds the boundaries of the solid among `crossings`, which are sorted by t. Crossings of one primitive in the same
  /// sense within each other's reach are one; crossings within their slack of each other happen at once, so that
  /// nothing remains between flush surfaces.
  void boundaries(std::span<const SolidCrossing> crossings, std::vector<SolidBoundary>& out);

 private:
  void toggle(int block);
  void findDistinct(std::span<const SolidCrossing> crossings);

  const Solid* solid_;
  std::vector<uint8_t> inside_;  ///< Indexed by block; all 0 between walks.
  std::vector<int> satisfied_;   ///< Indexed by block: number of operands that are where its operation wants them.
  std::vector<uint32_t> distinct_;
};

}  // namespace tomales
