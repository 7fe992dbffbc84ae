// Noun: a solid of RISpec 3.2 section 5.9 (SolidBegin ... SolidEnd): an expression over primitives, each of which is
// whatever closed surface the geometry of one SolidBegin "primitive" block makes. And the state of a walk along a line
// through it: which surfaces that the line crosses are surfaces of the whole.
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
  /// Adds a block inside block `parent`, the outermost one (block 0) inside -1, and returns its number. The first
  /// operand of a difference is what the others are taken away from.
  int add(SolidOperation operation, int parent);

  int blockCount() const { return static_cast<int>(blocks_.size()); }
  SolidOperation operation(int block) const { return at(block).operation; }
  int parent(int block) const { return at(block).parent; }
  int depth(int block) const {
    return block < 0 ? 0 : 1 + depth(at(block).parent);
  }  ///< Blocks around this one and itself.
  /// Does the solid lie on the other side of this primitive's surface: do an odd number of differences take it away?
  bool subtracted(int block) const;

 private:
  friend class SolidWalk;
  struct Block {
    SolidOperation operation;
    int parent;
    bool takenAway;  ///< A further operand of a difference.
    int operands = 0;
  };
  const Block& at(int block) const { return blocks_[static_cast<size_t>(block)]; }
  std::vector<Block> blocks_;
};

/// Where a line crosses the surface of a primitive.
struct SolidCrossing {
  int block;     ///< A primitive of the solid.
  bool leaving;  ///< The line goes to the side of the surface's own normal.
  float t;       ///< Anything that grows along the line.
  float reach;   ///< How far off the same point of the surface may be found again, where two pieces of it overlap.
  float slack;   ///< How far t may be off.
};

/// A crossing at which the line enters or leaves the solid.
struct SolidBoundary {
  uint32_t crossing;
  bool entering;
};

/// Walks lines that end outside of everything, as all do that are followed far enough: whether they begin inside of a
/// primitive then follows from the number of its crossings, so the eye may stand in one.
class SolidWalk {
 public:
  explicit SolidWalk(const Solid& solid);

  /// The boundaries of the solid among `crossings`, which are sorted by t. Crossings of one primitive in the same sense
  /// within each other's reach are one; crossings within their slack of each other happen at once, so that what is
  /// flush leaves nothing between.
  void boundaries(std::span<const SolidCrossing> crossings, std::vector<SolidBoundary>& out);

 private:
  void toggle(int block);
  void findDistinct(std::span<const SolidCrossing> crossings);

  const Solid* solid_;
  std::vector<uint8_t> inside_;  ///< A block; all 0 between walks.
  std::vector<int> satisfied_;   ///< A block: operands that are where its operation wants them.
  std::vector<uint32_t> distinct_;
};

}  // namespace tomales
