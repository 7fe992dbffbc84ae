// The clones of a kernel for different processors give the same bits. The program picks one of them when it starts; the
// others are found by their names in its own symbol table.
#include <dlfcn.h>
#include <elf.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

#include "kernel_run.h"

namespace tomales::compiler {
namespace {

/// What this program's symbol table names, by name: addresses in memory.
std::map<std::string, uintptr_t> symbolsOfThisProgram() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  Elf64_Ehdr head;
  std::memcpy(&head, bytes.data(), sizeof head);
  std::vector<Elf64_Shdr> sections(head.e_shnum);
  std::memcpy(sections.data(), bytes.data() + head.e_shoff, sections.size() * sizeof(Elf64_Shdr));
  Dl_info here;
  dladdr(reinterpret_cast<void*>(&symbolsOfThisProgram), &here);
  const uintptr_t base = head.e_type == ET_DYN ? reinterpret_cast<uintptr_t>(here.dli_fbase) : 0;
  std::map<std::string, uintptr_t> found;
  for (const Elf64_Shdr& section : sections) {
    if (section.sh_type != SHT_SYMTAB) continue;
    const char* names = bytes.data() + sections[section.sh_link].sh_offset;
    for (uint64_t at = 0; at < section.sh_size; at += sizeof(Elf64_Sym)) {
      Elf64_Sym symbol;
      std::memcpy(&symbol, bytes.data() + section.sh_offset + at, sizeof symbol);
      found[names + symbol.st_name] = base + symbol.st_value;
    }
  }
  return found;
}

/// Null where there is no such clone.
Kernel cloneOf(const Entry& entry, const std::string& processor) {
  static const std::map<std::string, uintptr_t> symbols = symbolsOfThisProgram();
  const std::string start = "_ZN7tomales8compiler7kernels" + std::to_string(entry.name.size()) + entry.name + "E",
                    end = "." + processor;
  for (auto s = symbols.lower_bound(start); s != symbols.end() && s->first.compare(0, start.size(), start) == 0; ++s)
    if (s->first.size() > end.size() && s->first.compare(s->first.size() - end.size(), end.size(), end) == 0)
      return reinterpret_cast<Kernel>(s->second);
  return nullptr;
}

void expectSameBits(const std::string& processor) {
  constexpr int kBlocks = 64;
  int compared = 0;
  for (const Entry& entry : entries()) {
    const Kernel one = cloneOf(entry, "default"), other = cloneOf(entry, processor);
    if (!one || !other) continue;
    ++compared;
    Numbers numbers(static_cast<uint32_t>(entry.op) + 100);
    std::vector<Values> in;
    std::vector<Lanes> lanes;
    for (char letter : entry.takes) {
      in.emplace_back(floatsOf(letter), kBlocks, true);
      for (float& x : in.back().data) x = numbers.any();
    }
    for (Values& v : in) lanes.push_back(v.lanes());
    Values a(entry.floatsOut(), kBlocks, true), b = a;
    one(kBlocks, a.lanes(), lanes.data());
    other(kBlocks, b.lanes(), lanes.data());
    for (size_t i = 0; i < a.data.size(); ++i) {
      if (a.data[i] != a.data[i] && b.data[i] != b.data[i]) continue;
      ASSERT_EQ(std::memcmp(&a.data[i], &b.data[i], sizeof(float)), 0)
          << entry.name << ": " << a.data[i] << " and " << b.data[i];
    }
  }
  if (compared == 0) GTEST_SKIP() << "this build has no clones";
  EXPECT_GE(compared, static_cast<int>(entries().size()) - 1);  // wnoise looks a table up, point by point
}

TEST(Processors, OfAvx2GiveTheBitsOfTheOldestOnes) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2";
  expectSameBits("avx2");
}
TEST(Processors, OfAvx512GiveTheBitsOfTheOldestOnes) {
  if (!__builtin_cpu_supports("avx512f")) GTEST_SKIP() << "this processor has no AVX-512";
  expectSameBits("avx512f");
}

}  // namespace
}  // namespace tomales::compiler
