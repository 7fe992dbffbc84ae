#include "reyes/solid.h"

namespace tomales {

int Solid::add(SolidOperation operation, int parent) {
  bool takenAway = false;
  if (parent >= 0) {
    Block& outer = blocks_[static_cast<size_t>(parent)];
    takenAway = outer.operation == SolidOperation::Difference && outer.operands > 0;
    ++outer.operands;
  }
  blocks_.push_back({operation, parent, takenAway});
  return blockCount() - 1;
}

bool Solid::subtracted(int block) const {
  bool subtracted = false;
  for (int b = block; b >= 0; b = at(b).parent) subtracted ^= at(b).takenAway;
  return subtracted;
}

SolidWalk::SolidWalk(const Solid& solid)
    : solid_(&solid), inside_(solid.blocks_.size(), 0), satisfied_(solid.blocks_.size(), 0) {
  for (const Solid::Block& b : solid.blocks_)
    // In a difference the line has to be outside of this operand.
    if (b.takenAway) ++satisfied_[static_cast<size_t>(b.parent)];
}

void SolidWalk::toggle(int block) {
  for (int b = block;;) {
    const bool now = inside_[static_cast<size_t>(b)] ^= 1;
    const Solid::Block& own = solid_->at(b);
    if (own.parent < 0) return;
    const Solid::Block& outer = solid_->at(own.parent);
    int& satisfied = satisfied_[static_cast<size_t>(own.parent)];
    satisfied += now != own.takenAway ? 1 : -1;
    const bool wanted = outer.operation == SolidOperation::Union ? satisfied > 0 : satisfied == outer.operands;
    if (wanted == (inside_[static_cast<size_t>(own.parent)] != 0)) return;
    b = own.parent;
  }
}

void SolidWalk::findDistinct(std::span<const SolidCrossing> crossings) {
  distinct_.clear();
  float widest = 0;
  for (uint32_t i = 0; i < crossings.size(); ++i) {
    const SolidCrossing& c = crossings[i];
    widest = std::max(widest, c.reach);
    bool known = false;
    for (auto k = distinct_.rbegin(); k != distinct_.rend() && !known; ++k) {
      const SolidCrossing& before = crossings[*k];
      if (c.t - before.t > c.reach + widest) break;
      known = before.block == c.block && before.leaving == c.leaving && c.t - before.t <= c.reach + before.reach;
    }
    if (!known) distinct_.push_back(i);
  }
}

void SolidWalk::boundaries(std::span<const SolidCrossing> crossings, std::vector<SolidBoundary>& out) {
  out.clear();
  findDistinct(crossings);
  for (const uint32_t i : distinct_) toggle(crossings[i].block);
  for (size_t first = 0, last = 0; first < distinct_.size(); first = last) {
    const bool before = inside_[0] != 0;
    uint32_t changes = 0;
    do {
      const bool was = inside_[0] != 0;
      toggle(crossings[distinct_[last]].block);
      if ((inside_[0] != 0) != was) changes = distinct_[last];
      ++last;
    } while (last < distinct_.size() && crossings[distinct_[last]].t - crossings[distinct_[last - 1]].t <=
                                            crossings[distinct_[last]].slack + crossings[distinct_[last - 1]].slack);
    if ((inside_[0] != 0) != before) out.push_back({changes, !before});
  }
}

}  // namespace tomales
