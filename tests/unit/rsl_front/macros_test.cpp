// Each rule of ISO C90 6.8.3 and 6.8.1 by itself; expected texts follow from the standard.
#include <gtest/gtest.h>

#include "front_test_tools.h"

namespace tomales::compiler {
namespace {

void expectTexts(std::initializer_list<Case> cases) {
  for (const Case& c : cases) EXPECT_EQ(preprocessedText(c.text), c.expected) << c.text;
}

TEST(Macros, ObjectLikeOnesAreReplacedAndRescanned) {
  expectTexts({{"#define a 1\na b a", "1 b 1"},
               {"#define a b\n#define b c\na", "c"},
               {"#define a\nx a y", "x y"},
               {"#define a (b)\na", "( b )"},
               {"# define a 1\n  #  undef a\na", "a"},
               {"#define a 1\n#define b a\n#undef a\n#define a 2\nb", "2"},
               {"#define a 1 // two\na /* three */ a", "1 1"}});
}

TEST(Macros, FunctionLikeOnesNeedABracketWithoutBlankInTheDefinition) {
  expectTexts({{"#define f(x) [x]\nf(1) f (2) f\n(3)", "[ 1 ] [ 2 ] [ 3 ]"},
               {"#define f(x) [x]\nf + f", "f + f"},
               {"#define f (x)\nf(1)", "( x ) ( 1 )"},
               {"#define f() 1\nf() f( )", "1 1"},
               {"#define f(x,y) y x\nf(a, b)", "b a"},
               {"#define f(x) x\nf((a,b)) f(g(a,b))", "( a , b ) g ( a , b )"},
               {"#define f(x) x\nf", "f"}});
}

TEST(Macros, ArgumentsMayBeEmptyAndSpanLines) {
  expectTexts({{"#define f(x) [x]\nf()", "[ ]"},
               {"#define f(x,y) [x|y]\nf(,) f(a,) f(,b)", "[ | ] [ a | ] [ | b ]"},
               {"#define f(x,y) x y\nf(a\n,\nb)", "a b"}});
}

TEST(Macros, ArgumentsAreReplacedBeforeTheyAreInserted) {
  expectTexts({{"#define f(x) x x\n#define a b\nf(a)", "b b"},
               {"#define f(x) [x]\nf(f(f(1)))", "[ [ [ 1 ] ] ]"},
               {"#define g f\n#define f(x) [x]\ng(1)", "[ 1 ]"},
               {"#define f(x) x+g\n#define g(x) x-f\nf(1)(2)", "1 + 2 - f"}});
}

TEST(Macros, NeverReplaceThemselves) {
  expectTexts({{"#define a a\na", "a"},
               {"#define a b\n#define b a\na b", "a b"},
               {"#define f(x) f(x + 1)\nf(2)", "f ( 2 + 1 )"},
               {"#define f(x) x f\nf(f)(1)", "f f ( 1 )"},
               {"#define a b(a\n#define b(x) [x]\na )", "[ a ]"},
               {"#define sqrt(x) sqrt(abs(x))\nsqrt(sqrt(2))", "sqrt ( abs ( sqrt ( abs ( 2 ) ) ) )"}});
}

TEST(Macros, HashMakesAStringOfTheArgumentAsWritten) {
  expectTexts({{"#define s(x) #x\n#define a 1\ns(a)", "\"a\""},
               {"#define s(x) # x\ns(  a   +\n b )", "\"a + b\""},
               {"#define s(x) #x\ns(\"a\\n\")", "\"\"a\\n\"\""},
               {"#define s(x) #x\n#define t(x) s(x)\n#define a 1\nt(a)", "\"1\""},
               {"#define s(x) #x\ns()", "\"\""},
               {"#define s # x\ns", "# x"}});
}

TEST(Macros, DoubleHashPastesWhatIsWritten) {
  expectTexts({{"#define p(x,y) x##y\np(a,b) p(1,2) p(+,=) p(.,5)", "ab 12 += .5"},
               {"#define p(x,y) x ## y\n#define a z\n#define ab c\np(a,b)", "c"},
               {"#define p(x,y) x##y\np(,b) p(a,) [p(,)]", "b a [ ]"},
               {"#define p(x,y,z) x##y##z\np(a,b,c) p(a,,c)", "abc ac"},
               {"#define p(x) pre_##x##_post\np(mid)", "pre_mid_post"},
               {"#define p(x,y) x##y\np(a b,c d)", "a bc d"},
               {"#define a x##y\na", "xy"}});
}

TEST(Macros, TheStandardsExamplesComeOutAsItSays) {
  expectTexts({{"#define x 3\n#define f(a) f(x * (a))\n#undef x\n#define x 2\n#define g f\n#define z z[0]\n"
                "#define h g(~\n#define m(a) a(w)\n#define w 0,1\n#define t(a) a\n"
                "f(y+1) + f(f(z)) % t(t(g)(0) + t)(1);\ng(x+(3,4)-w) | h 5) & m\n(f)^m(m);",
                "f ( 2 * ( y + 1 ) ) + f ( 2 * ( f ( 2 * ( z [ 0 ] ) ) ) ) % f ( 2 * ( 0 ) ) + t ( 1 ) ; "
                "f ( 2 * ( 2 + ( 3 , 4 ) - 0 , 1 ) ) | f ( 2 * ( ~ 5 ) ) & f ( 2 * ( 0 , 1 ) ) ^ m ( 0 , 1 ) ;"},
               {"#define glue(a, b) a ## b\n#define xglue(a, b) glue(a, b)\n#define HIGHLOW \"hello\"\n"
                "#define LOW LOW \", world\"\nglue(HIGH, LOW);xglue(HIGH, LOW)",
                "\"hello\" ; \"hello, world\""},
               {"#define hash_hash # ## #\n#define mkstr(a) # a\n#define in_between(a) mkstr(a)\n"
                "#define join(c, d) in_between(c hash_hash d)\njoin(x, y)",
                "\"x ## y\""}});
}

TEST(Macros, VariadicOnesTakeTheRest) {
  expectTexts({{"#define f(...) [__VA_ARGS__]\nf(1, 2) f()", "[ 1 , 2 ] [ ]"},
               {"#define f(a, ...) a:__VA_ARGS__\nf(1, 2, (3, 4)) f(1)", "1 : 2 , ( 3 , 4 ) 1 :"},
               {"#define f(rest...) [rest]\nf(1, 2)", "[ 1 , 2 ]"}});
}

TEST(Macros, NamesInStringsAndCommentsAreLeftAlone) {
  expectTexts(
      {{"#define a 1\n\"a\" /* a */ 'a' b", "\"a\" b !''a'' is not of the language: strings stand in double quotes"},
       {"#define a \"b\"\na \"c\"", "\"bc\""}});
}

TEST(Macros, LineAndFileAreThoseOfTheUse) {
  expectTexts({{"\n__LINE__ __FILE__", "2 \"a.sl\""},
               {"#define l __LINE__\n\n\nl", "4"},
               {"#line 70 \"other.sl\"\n__LINE__", "2"}});
}

TEST(Macros, ThoseOfTheCommandLineAndOurOwnAreDefined) {
  PreprocessOptions options;
  options.definitions = {{"A", "1+1"}, {"B", ""}, {"F(x)", "[x]"}};
  EXPECT_EQ(preprocessedText("A B F(2) TOMALES", options), "1 + 1 [ 2 ] 1");
}

TEST(Macros, AnewDefinitionWarnsUnlessItIsTheSame) {
  expectTexts({{"#define a 1\n#define a  1 /* same */\na", "1"},
               {"#define a 1\n#define a 2\na", "2 !macro 'a' is defined anew"},
               {"#define f(x) x\n#define f(y) y\nf(1)", "1 !macro 'f' is defined anew"}});
  EXPECT_FALSE(Front("#define a 1\n#define a 2\n").messages.hasErrors());
}

TEST(Conditions, ChooseOneBranch) {
  expectTexts({{"#if 1\na\n#else\nb\n#endif\nc", "a c"},
               {"#if 0\na\n#else\nb\n#endif\nc", "b c"},
               {"#if 0\na\n#elif 1\nb\n#elif 1\nc\n#else\nd\n#endif", "b"},
               {"#ifdef a\nx\n#endif\n#ifndef a\ny\n#endif", "y"},
               {"#define a\n#ifdef a\nx\n#endif\n#ifndef a\ny\n#endif", "x"},
               {"#if 0\n#if 1\na\n#else\nb\n#endif\n#elif 1\nc\n#endif", "c"},
               {"#if 1\n#if 0\na\n#else\nb\n#endif\n#else\nc\n#endif", "b"},
               {"#if 1\na\n#elif 1/0\nb\n#endif", "a"}});
}

TEST(Conditions, SkipWhatIsNoLanguage) {
  expectTexts({{"#if 0\ndon't \"worry\n#error no\n#include \"no\"\n#nonsense\n@\n#endif\na", "a"},
               {"#if 0\n/* #endif */\na\n#endif\nb", "b"},
               {"#if 0\n# if junk junk\n# endif\n#endif\na", "a"}});
}

TEST(Conditions, ReadEveryIntegerOperatorOfC) {
  struct Expression {
    const char* text;
    bool holds;
  };
  const Expression all[] = {{"1 + 2 * 3 == 7", true},
                            {"(1 + 2) * 3 == 9", true},
                            {"10 - 4 - 3 == 3", true},
                            {"7 / 2 == 3 && 7 % 4 == 3", true},
                            {"-7 / 2 == -3", true},
                            {"1 << 4 == 16 && 256 >> 4 == 16", true},
                            {"(6 & 3) == 2 && (6 | 3) == 7 && (6 ^ 3) == 5", true},
                            {"6 & 3 == 3", false},
                            {"~0 == -1", true},
                            {"!1", false},
                            {"1 < 2 && 2 <= 2 && 3 > 2 && 2 >= 2 && 1 != 2", true},
                            {"1 ? 0 : 1", false},
                            {"0 ? 0 : 1 ? 1 : 0", true},
                            {"0 && 1/0", false},
                            {"1 || 1/0", true},
                            {"1 ? 2 : 1 % 0", true},
                            {"0x1F == 31 && 010 == 8 && 5u == 5L", true},
                            {"'a' == 97", true},
                            {"undefined", false},
                            {"undefined == 0", true},
                            {"defined TOMALES && defined(TOMALES)", true},
                            {"!defined BMRT && !(defined(AQSIS) || defined(PRMAN))", true},
                            {"TOMALES + 1 == 2", true},
                            {"-9223372036854775807 - 1 < 0", true},
                            {"(-9223372036854775807 - 1) / -1 < 0", true},
                            {"1 << 64 == 0", true}};
  for (const Expression& e : all)
    EXPECT_EQ(preprocessedText(fmt::format("#if {}\nyes\n#else\nno\n#endif", e.text)), e.holds ? "yes" : "no")
        << e.text;
}

TEST(Directives, ThatMeanNothingToShadersAreAccepted) {
  expectTexts({{"#pragma nolint\n#pragma nolint 2\n#pragma annotate \"x\"\na", "a"},
               {"#\n#ident \"x\"\n# 33 \"x.sl\"\na", "a"},
               {"#ifdef a\n#endif a\n#ifdef b\n#else b\n#endif /* b */\nc", "c"}});
}

TEST(Directives, ErrorAndWarningSayTheirText) {
  EXPECT_EQ(messagesOf(Front("a\n  #error do not  use this\n#warning old")),
            "2:3: #error do not  use this\n3:1: warning: #warning old");
}

}  // namespace
}  // namespace tomales::compiler
