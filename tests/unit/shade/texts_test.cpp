// The bound on the patterns of match(). The C library expands what repeats, so that a short pattern can take gigabytes.
#include <gtest/gtest.h>

#include "reyes/shader/text.h"

namespace {

TEST(Patterns, ThatRepeatWhatRepeatsAreHuge) {
  for (const char* pattern : {
           "(((a{255}){255}){255})",
           "((((a{1,255}){1,255}){1,255}){1,255})",
           R"((\)(\)a{255}){255}){255})",  // escaped brackets close no group
           "([)]([)]a{255}){255}){255}",   // nor do those in a class
           "a{255}*{255}+{255}",
           "[{](((aaaaaaaaaa){32}){32}){32}",
       })
    EXPECT_TRUE(rsl::isHugePattern(pattern)) << pattern;
}

TEST(Patterns, ThatAuthorsWriteAreNotHuge) {
  for (const char* pattern : {
           "",
           "^[a-z]{1,64}_[a-z]{1,64}_[0-9]{1,4}$",
           "^(wood|oak){1,3}[.](tif|tx){1}$",
           "^(([a-z]+_){2,8}[0-9]{4}){1,4}$",
           "{{{",
           "a{b}{c}",
       })
    EXPECT_FALSE(rsl::isHugePattern(pattern)) << pattern;
}

TEST(Patterns, OfThousandsOfCharactersAreHuge) { EXPECT_TRUE(rsl::isHugePattern(std::string(5000, 'a'))); }

}  // namespace
