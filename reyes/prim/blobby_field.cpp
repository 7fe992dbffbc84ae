#include "reyes/prim/blobby_field.h"

#include "reyes/prim/blobby_ground.h"

namespace tomales {
namespace {

/// Returns the parameter of the segment's point nearest to q: 0 at its beginning, 1 at its end.
double placeOnSegment(const BlobLeaf& leaf, const dvec3& q) {
  const dvec3 along = leaf.to - leaf.from;
  const double length2 = glm::dot(along, along);
  return length2 > 0 ? std::clamp(glm::dot(q - leaf.from, along) / length2, 0.0, 1.0) : 0.0;
}

dvec3 awayFromSegment(const BlobLeaf& leaf, const dvec3& q) {
  return q - (leaf.from + placeOnSegment(leaf, q) * (leaf.to - leaf.from));
}

double fallOff(double distance) {
  const double rest = std::max(0.0, 1 - distance * distance);
  return rest * rest * rest;
}

FieldPoint leafAt(const BlobLeaf& leaf, const dvec3& p) {
  if (leaf.ground) return leaf.ground->at(p);
  const dvec3 away = awayFromSegment(leaf, leaf.axes * p + leaf.origin) / leaf.radius;
  const double rest = 1 - glm::dot(away, away);
  if (rest <= 0) return {};
  return {rest * rest * rest, -6 * rest * rest / leaf.radius * (away * leaf.axes)};
}

FieldRange leafOver(const BlobLeaf& leaf, const Box& box) {
  if (leaf.ground) return leaf.ground->over(box);
  const dvec3 center = 0.5 * (box.lo + box.hi), half = 0.5 * (box.hi - box.lo);
  dvec3 reach(0);
  for (int k = 0; k < 3; ++k) reach += glm::abs(leaf.axes[k]) * half[k];
  const double d = glm::length(awayFromSegment(leaf, leaf.axes * center + leaf.origin)), r = glm::length(reach);
  return {fallOff((d + r) / leaf.radius), fallOff(std::max(0.0, d - r) / leaf.radius)};
}

FieldPoint apply(BlobOp op, std::span<const uint32_t> operands, const std::vector<FieldPoint>& values) {
  FieldPoint out = values[operands[0]];
  for (const uint32_t k : operands.subspan(1)) {
    const FieldPoint& x = values[k];
    switch (op) {
      case BlobOp::Add:
        out = {out.value + x.value, out.gradient + x.gradient};
        break;
      case BlobOp::Multiply:
        out = {out.value * x.value, out.gradient * x.value + x.gradient * out.value};
        break;
      case BlobOp::Maximum:
        if (x.value > out.value) out = x;
        break;
      case BlobOp::Minimum:
        if (x.value < out.value) out = x;
        break;
      case BlobOp::Subtract:
        out = {out.value - x.value, out.gradient - x.gradient};
        break;
      case BlobOp::Divide:
        if (x.value == 0) return {};
        out = {out.value / x.value, (out.gradient - out.value / x.value * x.gradient) / x.value};
        break;
      default:
        break;
    }
  }
  return op == BlobOp::Negate ? FieldPoint{-out.value, -out.gradient} : out;
}

FieldRange applyToRanges(BlobOp op, std::span<const uint32_t> operands, const std::vector<FieldRange>& ranges) {
  FieldRange out = ranges[operands[0]];
  for (const uint32_t k : operands.subspan(1)) {
    const FieldRange& x = ranges[k];
    switch (op) {
      case BlobOp::Add:
        out = sum(out, x);
        break;
      case BlobOp::Multiply:
        out = product(out, x);
        break;
      case BlobOp::Maximum:
        out = {std::max(out.lo, x.lo), std::max(out.hi, x.hi)};
        break;
      case BlobOp::Minimum:
        out = {std::min(out.lo, x.lo), std::min(out.hi, x.hi)};
        break;
      case BlobOp::Subtract:
        out = {out.lo - x.hi, out.hi - x.lo};
        break;
      case BlobOp::Divide:
        if (x.lo <= 0 && x.hi >= 0) return {-HUGE_VAL, HUGE_VAL};
        out = product(out, {1 / x.hi, 1 / x.lo});
        break;
      default:
        break;
    }
  }
  return op == BlobOp::Negate ? FieldRange{-out.hi, -out.lo} : out;
}

}  // namespace

FieldRange sum(const FieldRange& a, const FieldRange& b) { return {a.lo + b.lo, a.hi + b.hi}; }

FieldRange product(const FieldRange& a, const FieldRange& b) {
  const auto [lo, hi] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
  return {lo, hi};
}

double BlobLeaf::feature() const {
  if (ground) return ground->feature();
  const glm::dmat3 rows = glm::transpose(axes);
  double steepest = 0;
  for (int k = 0; k < 3; ++k) steepest = std::max({steepest, glm::length(axes[k]), glm::length(rows[k])});
  return radius / steepest;
}

void BlobField::addOperation(BlobOp op, std::span<const uint32_t> operands) {
  code_.push_back({op, static_cast<uint32_t>(operands_.size()), static_cast<uint32_t>(operands.size()), 0});
  operands_.insert(operands_.end(), operands.begin(), operands.end());
}

const std::vector<FieldPoint>& BlobField::run(const dvec3& p) const {
  thread_local std::vector<FieldPoint> values;
  values.clear();
  for (const Instruction& i : code_)
    values.push_back(i.op == BlobOp::Constant ? FieldPoint{i.constant, dvec3(0)}
                     : i.op == BlobOp::Leaf   ? leafAt((*leaves_)[i.first], p)
                                              : apply(i.op, operandsOf(i), values));
  return values;
}

FieldPoint BlobField::at(const dvec3& p) const { return run(p).back(); }

std::vector<FieldRange> BlobField::rangesOver(const Box& box) const {
  std::vector<FieldRange> ranges;
  ranges.reserve(code_.size());
  for (const Instruction& i : code_)
    ranges.push_back(i.op == BlobOp::Constant ? FieldRange{i.constant, i.constant}
                     : i.op == BlobOp::Leaf   ? leafOver((*leaves_)[i.first], box)
                                              : applyToRanges(i.op, operandsOf(i), ranges));
  return ranges;
}

/// Returns the operands without terms that are 0 and without those that another one exceeds all over the box. at()
/// still returns the same bits.
std::vector<uint32_t> BlobField::neededOperands(const Instruction& i, const std::vector<FieldRange>& ranges) const {
  const std::span<const uint32_t> all = operandsOf(i);
  std::vector<uint32_t> needed;
  const FieldRange whole = applyToRanges(i.op, all, ranges);
  for (const uint32_t k : all) {
    const FieldRange& x = ranges[k];
    const bool idle = (i.op == BlobOp::Add && x.lo == 0 && x.hi == 0) || (i.op == BlobOp::Maximum && x.hi < whole.lo) ||
                      (i.op == BlobOp::Minimum && x.lo > whole.hi);
    if (!idle) needed.push_back(k);
  }
  return needed;
}

// Goes from the last instruction to the first without recursion, because chains of operations could exhaust the stack.
BlobField BlobField::within(const Box& box) const {
  const std::vector<FieldRange> ranges = rangesOver(box);
  const auto isConstant = [&](size_t index) { return ranges[index].lo == ranges[index].hi; };
  std::vector<std::vector<uint32_t>> operands(code_.size());
  std::vector<char> needed(code_.size(), 0);
  needed.back() = 1;
  for (size_t index = code_.size(); index-- > 0;) {
    if (!needed[index] || isConstant(index) || code_[index].op == BlobOp::Leaf) continue;
    operands[index] = neededOperands(code_[index], ranges);
    for (const uint32_t k : operands[index]) needed[k] = 1;
  }
  BlobField out(*this);
  out.code_.clear();
  out.operands_.clear();
  std::vector<uint32_t> copied(code_.size());
  for (size_t index = 0; index < code_.size(); ++index) {
    if (!needed[index]) continue;
    copied[index] = static_cast<uint32_t>(out.code_.size());
    for (uint32_t& k : operands[index]) k = copied[k];
    if (isConstant(index))
      out.addConstant(ranges[index].lo);
    else if (code_[index].op == BlobOp::Leaf)
      out.addLeaf(code_[index].first);
    else
      out.addOperation(code_[index].op, operands[index]);
  }
  out.code_.shrink_to_fit();
  out.operands_.shrink_to_fit();
  return out;
}

std::vector<double> BlobField::leafWeights(const dvec3& p) const {
  const std::vector<FieldPoint>& values = run(p);
  std::vector<double> weights(leaves_->size(), 0.0);
  std::vector<char> counts(code_.size(), 0);  // does the field depend on it?
  counts.back() = 1;
  for (size_t index = code_.size(); index-- > 0;) {
    const Instruction& i = code_[index];
    if (!counts[index] || i.op == BlobOp::Constant) continue;
    if (i.op == BlobOp::Leaf) {
      weights[i.first] = (*leaves_)[i.first].ground ? 0.0 : values[index].value;
      continue;
    }
    const bool chooses = i.op == BlobOp::Maximum || i.op == BlobOp::Minimum;
    for (const uint32_t k : operandsOf(i))
      if (!chooses || values[k].value == values[index].value) counts[k] = 1;
  }
  return weights;
}

size_t BlobField::leavesUsed() const {
  return static_cast<size_t>(
      std::count_if(code_.begin(), code_.end(), [](const Instruction& i) { return i.op == BlobOp::Leaf; }));
}

dvec3 BlobField::carried(const dvec3& p, const BlobField& other) const {
  const std::vector<double> weights = leafWeights(p);
  dvec3 sum(0);
  double total = 0;
  for (size_t k = 0; k < weights.size(); ++k) {
    if (!(weights[k] > 0)) continue;
    const BlobLeaf &a = (*leaves_)[k], &b = (*other.leaves_)[k];
    const double t = placeOnSegment(a, a.axes * p + a.origin);
    const dvec3 away = a.axes * p + a.origin - (a.from + t * (a.to - a.from));
    const dvec3 there = b.from + t * (b.to - b.from) + b.radius / a.radius * away;
    sum += weights[k] * (glm::inverse(b.axes) * (there - b.origin));
    total += weights[k];
  }
  return total > 0 ? sum / total : p;
}

double BlobField::feature() const {
  double least = HUGE_VAL;
  for (const Instruction& i : code_)
    if (i.op == BlobOp::Leaf) least = std::min(least, (*leaves_)[i.first].feature());
  return least;
}

}  // namespace tomales
