// Private to Blobby: the function whose level set is the Blobby. It combines leaves, which fall off with distance, by
// arithmetic. Space: object space. Everything is in double precision, so that a root along a line is exact to a float's
// last bit.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

using glm::dvec3;

/// The surface is where the field has this value; it is larger inside. A single ellipsoid of radius 1 shows at radius
/// 1/2.
constexpr double kBlobSurface = 0.421875;

struct Box {
  dvec3 lo, hi;
};

class BlobGround;

/// A leaf's value is (1 - d^2)^3 for d < 1, and 0 beyond. In leaf space, d is the distance from a segment (a point if
/// its ends are equal) divided by `radius`. A leaf may be a ground instead (blobby_ground.h), which has no values to
/// blend and moves nothing.
struct BlobLeaf {
  glm::dmat3 axes;  ///< Transforms from object space to leaf space, with `origin`.
  dvec3 origin;
  dvec3 from, to;
  double radius;
  std::shared_ptr<const BlobGround> ground{};

  double feature() const;  ///< Least distance over which its value falls from 1 to 0.
};

enum class BlobOp : uint8_t { Constant, Leaf, Add, Multiply, Maximum, Minimum, Divide, Subtract, Negate, Identity };

struct FieldPoint {
  double value = 0;
  dvec3 gradient{0};
};
struct FieldRange {
  double lo, hi;
};
FieldRange sum(const FieldRange& a, const FieldRange& b);
FieldRange product(const FieldRange& a, const FieldRange& b);

/// A program: every instruction uses the results of earlier ones, and the last result is the field.
class BlobField {
 public:
  explicit BlobField(std::vector<BlobLeaf> leaves)
      : leaves_(std::make_shared<const std::vector<BlobLeaf>>(std::move(leaves))) {}

  void addConstant(double value) { code_.push_back({BlobOp::Constant, 0, 0, value}); }
  void addLeaf(uint32_t leaf) { code_.push_back({BlobOp::Leaf, leaf, 0, 0}); }
  void addOperation(BlobOp op, std::span<const uint32_t> operands);

  /// Returns the number of leaves that the program uses, which within() may have reduced.
  size_t leavesUsed() const;
  size_t leafCount() const { return leaves_->size(); }
  FieldPoint at(const dvec3& p) const;
  FieldRange over(const Box& box) const { return rangesOver(box).back(); }

  /// Returns a program with the same values inside of the box, without the instructions that are not needed there.
  BlobField within(const Box& box) const;

  /// Returns the value of each leaf at p, or 0 if the field does not depend on the leaf there.
  std::vector<double> leafWeights(const dvec3& p) const;

  /// Returns where p moves if the leaves become those of `other`: by the mean of their motions, weighted by
  /// leafWeights(). Pre: `other` has the same number of leaves.
  dvec3 carried(const dvec3& p, const BlobField& other) const;

  /// Returns the least feature() of the leaves that the program uses; infinite if it uses none.
  double feature() const;

 private:
  struct Instruction {
    BlobOp op;
    uint32_t first, count;  ///< Range in operands_; for a leaf `first` is the leaf's index.
    double constant;
  };

  std::span<const uint32_t> operandsOf(const Instruction& i) const { return {operands_.data() + i.first, i.count}; }
  const std::vector<FieldPoint>& run(const dvec3& p) const;
  std::vector<FieldRange> rangesOver(const Box& box) const;
  std::vector<uint32_t> neededOperands(const Instruction& i, const std::vector<FieldRange>& ranges) const;

  std::shared_ptr<const std::vector<BlobLeaf>> leaves_;
  std::vector<Instruction> code_;
  std::vector<uint32_t> operands_;
};

}  // namespace tomales
