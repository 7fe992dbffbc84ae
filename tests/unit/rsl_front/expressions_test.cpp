// Tests which operator takes which operands (RISpec 3.2 appendix B).
#include <gtest/gtest.h>

#include "front_test_tools.h"

namespace tomales::compiler {
namespace {

void expectTrees(std::initializer_list<Case> cases) {
  for (const Case& c : cases) EXPECT_EQ(expressionOf(c.text), c.expected) << c.text;
}

// Tightest first. Every operator against every other, in both orders.
constexpr std::string_view kLevels[][4] = {{"."},        {"*", "/"}, {"^"}, {"+", "-"}, {"<", "<=", ">", ">="},
                                           {"==", "!="}, {"&&"},     {"||"}};

TEST(Precedence, OfEveryPairOfBinaryOperatorsIsThatOfTheSpecification) {
  int pairs = 0;
  for (size_t i = 0; i < std::size(kLevels); ++i)
    for (size_t j = 0; j < std::size(kLevels); ++j)
      for (const std::string_view a : kLevels[i])
        for (const std::string_view b : kLevels[j]) {
          if (a.empty() || b.empty()) continue;
          const std::string left = fmt::format("({1} ({0} x y) z)", a, b),
                            right = fmt::format("({0} x ({1} y z))", a, b);
          EXPECT_EQ(expressionOf(fmt::format("x {} y {} z", a, b)), i <= j ? left : right);
          ++pairs;
        }
  EXPECT_EQ(pairs, 14 * 14);
}

TEST(Precedence, OfUnaryOperatorsIsAboveAllBinaryOnes) {
  expectTrees({{"-a . b", "(. (- a) b)"},
               {"-a * b", "(* (- a) b)"},
               {"a - -b", "(- a (- b))"},
               {"a--b", "(- a (- b))"},
               {"!a && b", "(&& (! a) b)"},
               {"!(a && b)", "(! (&& a b))"},
               {"- - +a", "(- (- (+ a)))"},
               {"-a[1]", "(- ([ a 1))"}});
}

TEST(Precedence, OfTwoSignsThatTouchIsThatOfOneOperator) {
  expectTrees({{"x = ++a", "(= x (+= a 1))"},
               {"++a[1]", "(+= ([ a 1) 1)"},
               {"a - --b", "(- a (-= b 1))"},
               {"a---b", "(- a (- (- b)))"},
               {"--f(b)", "(- (- (f b)))"},
               {"--float b", "(- (- (float b)))"},
               {"--2", "(- (- 2))"}});
}

TEST(Precedence, OfCastsIsAsTightAsOfUnaryOperators) {
  expectTrees({{"color noise(P) * 2", "(* (color (noise P)) 2)"},
               {"float noise(P) . b", "(. (float (noise P)) b)"},
               {"color -a + b", "(+ (color (- a)) b)"},
               {"-float a", "(- (float a))"},
               {"vector \"world\" v * 2", "(* (vector \"world\" v) 2)"},
               {"x = color float a", "(= x (color (float a)))"},
               {"x = color a[1]", "(= x (color ([ a 1)))"},
               {"(float a) + 1", "(+ (float a) 1)"}});
}

TEST(Precedence, OfTheConditionalIsAboveAssignmentAlone) {
  expectTrees({{"a = b || c ? d : e", "(= a (? (|| b c) d e))"},
               {"a ? b : c ? d : e", "(? a b (? c d e))"},
               {"a ? b ? c : d : e", "(? a (? b c d) e)"},
               {"x = a == 1 ? b + 1 : c * 2", "(= x (? (== a 1) (+ b 1) (* c 2)))"}});
}

TEST(Precedence, AssignmentsGroupToTheRight) {
  expectTrees({{"a = b = c", "(= a (= b c))"},
               {"a += b -= c", "(+= a (-= b c))"},
               {"a *= b /= c", "(*= a (/= b c))"},
               {"a[i] = b", "(= ([ a i) b)"},
               {"a ^= b", "(^= a b)"},
               {"(a = b) > c", "(> (= a b) c)"}});
}

TEST(Expressions, HaveAllPrimaries) {
  expectTrees({{"1.5", "1.5"},
               {"\"a\"", "\"a\""},
               {"PI", "PI"},
               {"f()", "(f)"},
               {"f(a, b + 1)", "(f a (+ b 1))"},
               {"f(a = 1)", "(f (= a 1))"},
               {"(a)", "a"},
               {"(1, 2, 3)", "(tuple 1 2 3)"},
               {"(1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16)", "(tuple 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16)"},
               {"a = {1, 2, 3,}", "(= a (tuple 1 2 3))"},
               {"a = {{1, 2}, {3}}", "(= a (tuple (tuple 1 2) (tuple 3)))"},
               {"a[i + 1]", "([ a (+ i 1))"},
               {"a[1][2]", "([ ([ a 1) 2)"},
               {"f(a)[1]", "([ (f a) 1)"},
               {"texture(\"x\"[2], s, t)", "(texture ([ \"x\" 2) s t)"},
               {"texture(name[ch])", "(texture ([ name ch))"}});
}

TEST(Expressions, HaveAllCasts) {
  expectTrees({{"color \"hsv\" (0, .5, 1)", "(color \"hsv\" (tuple 0 0.5 1))"},
               {"point \"shader\" (0, 0, 0)", "(point \"shader\" (tuple 0 0 0))"},
               {"vector \"world\" v", "(vector \"world\" v)"},
               {"normal (0, 0, 1)", "(normal (tuple 0 0 1))"},
               {"matrix \"shader\" 1", "(matrix \"shader\" 1)"},
               {"color \"\" a", "(color \"\" a)"},
               {"point \"a\" \"b\" p", "(point \"ab\" p)"},
               {"float texture(\"x\")", "(float (texture \"x\"))"},
               {"float \"x\"", "(float \"x\")"},
               {"string \"x\"", "(string \"x\")"},
               {"color \"x\" [0]", "(color ([ \"x\" 0))"}});
}

TEST(Expressions, NumbersBesidePointsAreNoDotProducts) {
  expectTrees({{"a.b", "(. a b)"}, {"a . .5", "(. a 0.5)"}, {"1.5 . a", "(. 1.5 a)"}, {"1. . a", "(. 1 a)"}});
}

TEST(Expressions, MayHaveCommas) { expectTrees({{"a = 1, b = 2", "(, (= a 1) (= b 2))"}}); }

TEST(Expressions, NamesAreAllThatTheLanguageDoesNotReserve) {
  for (const char* name : {"int", "double", "class", "struct", "new", "this", "do", "switch", "static", "light",
                           "surface", "volume", "output1", "public", "_x", "illuminance"})
    EXPECT_EQ(expressionOf(fmt::format("{} + 1", name)), fmt::format("(+ {} 1)", name));
}

TEST(Expressions, MayBeAsDeepAsTheBoundAndNotDeeper) {
  const auto brackets = [](int n) { return std::string(n, '(') + "1" + std::string(n, ')'); };
  EXPECT_EQ(expressionOf(brackets(kMostNesting - 3)), "1");
  EXPECT_NE(expressionOf(brackets(kMostNesting + 1)).find("nested more than 400 levels deep"), std::string::npos);
  const auto sum = [](int n) {
    std::string out = "a";
    for (int i = 1; i < n; ++i) out += " + a";
    return out;
  };
  EXPECT_EQ(expressionOf(sum(kMostHeight)).substr(0, 3), "(+ ");
  EXPECT_NE(expressionOf(sum(kMostHeight + 1)).find("more than 1000 levels of operators"), std::string::npos);
  EXPECT_NE(expressionOf(sum(100'000)).find("more than 1000 levels of operators"), std::string::npos);
}

}  // namespace
}  // namespace tomales::compiler
