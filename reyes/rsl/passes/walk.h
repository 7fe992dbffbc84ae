// Visits the instructions of code, and the registers that they read and write.
#pragma once
#include "reyes/rsl/code.h"

namespace tomales::compiler {

/// Calls `visit` for each instruction, outer ones before those within.
template <class Blocks, class Visit>
void forEach(Blocks& block, const Visit& visit) {
  for (auto& i : block) {
    visit(i);
    for (auto& inner : i.blocks) forEach(inner, visit);
  }
}

/// Calls `visit` for each register that the instruction itself reads, without those of its blocks.
template <class Visit>
void forEachRead(const Instruction& i, const Visit& visit) {
  for (const int32_t r : i.in)
    if (r >= 0) visit(r);
  for (const Setting& s : i.settings) {
    if (s.name >= 0) visit(s.name);
    if (s.value >= 0 && !s.fills) visit(s.value);
  }
}

/// Calls `visit` for each register that the instruction itself writes, wholly or in part.
template <class Visit>
void forEachWrite(const Instruction& i, const Visit& visit) {
  for (const int32_t r : i.out)
    if (r >= 0) visit(r);
  for (const Setting& s : i.settings)
    if (s.value >= 0 && s.fills) visit(s.value);
}

/// Returns how many instructions write each register.
inline std::vector<int> writeCounts(const Code& code) {
  std::vector<int> out(code.registers.size(), 0);
  forEach(code.body, [&](const Instruction& i) { forEachWrite(i, [&](int32_t r) { ++out[static_cast<size_t>(r)]; }); });
  return out;
}

/// Replaces the registers that an instruction reads, by a table from register to register.
inline void replaceReads(Instruction& i, const std::vector<int32_t>& by) {
  const auto change = [&](int32_t& r) {
    while (r >= 0 && by[static_cast<size_t>(r)] != r) r = by[static_cast<size_t>(r)];
  };
  for (int32_t& r : i.in) change(r);
  for (Setting& s : i.settings) {
    change(s.name);
    if (!s.fills) change(s.value);
  }
}

}  // namespace tomales::compiler
