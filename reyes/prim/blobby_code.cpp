#include "reyes/prim/blobby_code.h"

#include <fmt/format.h>

#include <optional>

#include "reyes/prim/blobby_ground.h"

namespace tomales {
namespace {

enum Code { kDivide = 4, kSubtract = 5, kIdentity = 7, kConstant = 1000, kEllipsoid, kSegment, kPlane, kPlugin };

class CodeReader {
 public:
  CodeReader(const std::vector<int>& code, const std::vector<float>& floats, const GroundReader& grounds,
             Problems& problems)
      : code_(code), floats_(floats), grounds_(grounds), problems_(problems) {}

  BlobProgram read() {
    struct Step {
      BlobOp op;
      double constant;
      uint32_t leaf;
      std::vector<uint32_t> operands;
    };
    std::vector<Step> steps;
    while (at_ < code_.size()) {
      const int code = next();
      if (code >= 0 && code <= kIdentity) {
        static constexpr BlobOp kOps[] = {BlobOp::Add,    BlobOp::Multiply, BlobOp::Maximum, BlobOp::Minimum,
                                          BlobOp::Divide, BlobOp::Subtract, BlobOp::Negate,  BlobOp::Identity};
        steps.push_back({kOps[code], 0, 0, operands(code, steps.size())});
      } else if (code == kConstant) {
        steps.push_back({BlobOp::Constant, take(1)[0], 0, {}});
        addLeaf(nullptr);
      } else if (code >= kEllipsoid && code <= kPlugin) {
        const std::optional<BlobLeaf> leaf = code == kEllipsoid ? ellipsoid()
                                             : code == kSegment ? segment()
                                             : code == kPlane   ? plane()
                                                                : plugin();
        steps.push_back({leaf ? BlobOp::Leaf : BlobOp::Constant, 0, static_cast<uint32_t>(leaves_.size()), {}});
        addLeaf(leaf ? &*leaf : nullptr);
      } else {
        throw PrimError(fmt::format("there is no operation or leaf {}", code));
      }
    }
    if (steps.empty()) throw PrimError("it has no operations and no leaves");
    if (box_.empty()) throw PrimError("it has no leaf of any size");
    const size_t leaves = leaves_.size();
    BlobField field(std::move(leaves_));
    for (const Step& s : steps) {
      if (s.op == BlobOp::Constant) field.addConstant(s.constant);
      if (s.op == BlobOp::Leaf) field.addLeaf(s.leaf);
      if (!s.operands.empty()) field.addOperation(s.op, s.operands);
    }
    return {std::move(field), {box_.lo, box_.hi}, leaves};
  }

 private:
  int next() {
    if (at_ == code_.size()) throw PrimError("its list of codes ends in the middle of an operation");
    return code_[at_++];
  }

  /// Returns `count` floats from the index that the next code gives.
  const float* take(size_t count) {
    const int first = next();
    if (first < 0 || static_cast<size_t>(first) + count > floats_.size())
      throw PrimError(
          fmt::format("a leaf takes {} floats from number {}, and {} are given", count, first, floats_.size()));
    return &floats_[static_cast<size_t>(first)];
  }

  std::vector<uint32_t> operands(int code, size_t earlier) {
    const int count = code < kDivide ? next() : code <= kSubtract ? 2 : 1;
    if (count < 1) throw PrimError(fmt::format("operation {} has {} operands", code, count));
    std::vector<uint32_t> out;
    for (int k = 0; k < count; ++k) {
      const int operand = next();
      if (operand < 0 || static_cast<size_t>(operand) >= earlier)
        throw PrimError(fmt::format("operation {} uses result {}, and {} are known there", code, operand, earlier));
      out.push_back(static_cast<uint32_t>(operand));
    }
    return out;
  }

  std::optional<BlobLeaf> ellipsoid() { return leafOf(take(16), dvec3(0), dvec3(0), 1); }

  std::optional<BlobLeaf> segment() {
    const float* f = take(23);
    return leafOf(f + 7, {f[0], f[1], f[2]}, {f[3], f[4], f[5]}, f[6]);
  }

  std::optional<BlobLeaf> leafOf(const float* sixteen, const dvec3& from, const dvec3& to, double radius) {
    const float* m = sixteen;
    const glm::dmat3 axes(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
    const dvec3 center(m[12], m[13], m[14]);
    const glm::dmat3 inverse = glm::inverse(axes);
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(glm::length(inverse[k])) || !(radius > 0)) {
        problems_.push_back(fmt::format("leaf {} has no size; it counts as 0", leaves_.size()));
        return {};
      }
    const glm::dmat3 rows = glm::transpose(axes);
    const dvec3 extent = radius * dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    for (const dvec3& end : {from, to}) {
      const dvec3 p = axes * end + center;
      box_.extend(vec3(p - extent));
      box_.extend(vec3(p + extent));
    }
    return BlobLeaf{inverse, -(inverse * center), from, to, radius};
  }

  std::optional<BlobLeaf> plane() {
    const int string = next();
    const float* f = take(4);
    std::optional<GroundPicture> picture = grounds_ ? grounds_(string) : std::nullopt;
    if (!picture || !(f[0] > 0)) return {};
    BlobLeaf leaf = nothing();
    leaf.ground = std::make_shared<BlobGround>(std::move(*picture), Repulsion{f[0], f[1], f[2], f[3]});
    return leaf;
  }

  /// Reads a plugin leaf: its name, then a count and a first index for its floats, and the same for its strings.
  std::optional<BlobLeaf> plugin() {
    problems_.push_back(
        fmt::format("leaf {} is code from a plugin, for which there is no interface; it counts as 0", leaves_.size()));
    for (int k = 0; k < 5; ++k) next();
    return {};
  }

  static BlobLeaf nothing() { return {glm::dmat3(1), dvec3(0), dvec3(0), dvec3(0), 1}; }
  void addLeaf(const BlobLeaf* leaf) { leaves_.push_back(leaf ? *leaf : nothing()); }

  const std::vector<int>& code_;
  const std::vector<float>& floats_;
  const GroundReader& grounds_;
  Problems& problems_;
  size_t at_ = 0;
  std::vector<BlobLeaf> leaves_;
  Bound3 box_;
};

}  // namespace

BlobProgram readBlobProgram(const std::vector<int>& code, const std::vector<float>& floats, const GroundReader& grounds,
                            Problems& problems) {
  return CodeReader(code, floats, grounds, problems).read();
}

}  // namespace tomales
