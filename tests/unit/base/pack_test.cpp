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

}  // namespace
}  // namespace tomales
