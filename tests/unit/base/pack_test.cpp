#include "reyes/base/pack.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

namespace tomales {
namespace {

TEST(Pack, WritesNothingToWhatItPacks) {
  struct Page {
    void* at = mmap(nullptr, 1, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);  // zeroes
    ~Page() { munmap(at, 1); }
  } page;
  ASSERT_NE(page.at, MAP_FAILED);
  const bool& no = *static_cast<const bool*>(page.at);
  EXPECT_EQ(pack(no).size(), 1u);
  EXPECT_EQ(contentSum(no), contentSum(false));
}

TEST(Pack, ForgedNumbersOfElementsEndWithTheBytes) {
  const std::vector<std::string> two{"ab", "c"};
  Bytes bytes = pack(two);
  EXPECT_EQ(Unpacker{bytes}.get<std::vector<std::string>>(), two);
  bytes.resize(1000);  // The elements that follow are empty texts.
  const uint64_t forged = 900;
  std::memcpy(bytes.data(), &forged, sizeof forged);
  std::vector<std::string> read;
  Unpacker unpacker{bytes};
  field(unpacker, read);
  EXPECT_TRUE(unpacker.damaged);
  EXPECT_LT(read.size(), 200u);
}

}  // namespace
}  // namespace tomales
