// Words of the language, and the places that they have.
#include <gtest/gtest.h>

#include "front_test_tools.h"

namespace tomales::compiler {
namespace {

std::vector<float> numbersOf(const std::string& text) {
  std::vector<float> out;
  for (const Token& t : Front(text).tokens)
    if (t.kind == TokenKind::Number) out.push_back(t.number);
  return out;
}

std::string stringOf(const std::string& text) {
  const Front front(text);
  return front.tokens.at(0).kind == TokenKind::String ? front.tokens[0].text : "no string";
}

TEST(Words, NumbersAreThoseOfC) {
  EXPECT_EQ(numbersOf("1 1. .25 1.5 1e3 1e-3 1.E+2 .5f 2F 0x1f 010"),
            (std::vector<float>{1, 1, .25f, 1.5f, 1000, .001f, 100, .5f, 2, 31, 10}));
  EXPECT_EQ(numbersOf("1e-60"), std::vector<float>{0});
}

TEST(Words, ANumberBeyondAFloatIsTheLargestAndWarns) {
  const Front front("1e60");
  EXPECT_EQ(front.tokens[0].number, std::numeric_limits<float>::max());
  EXPECT_EQ(messagesOf(front), "1:1: warning: '1e60' is more than a float can be: the largest, 3.40282347e38, is used");
}

TEST(Words, OperatorsAreTheLongestThatFit) {
  EXPECT_EQ(preprocessedText("a+=b-=c*=d/=e==f!=g<=h>=i&&j||k?l:m!n"),
            "a += b -= c *= d /= e == f != g <= h >= i && j || k ? l : m ! n");
  EXPECT_EQ(preprocessedText("a.b 1.5 a.5 V^W"), "a . b 1.5 a .5 V ^ W");
  EXPECT_EQ(preprocessedText("a--b+++c"), "a - - b + + + c") << "RSL has neither -- nor ++";
}

TEST(Words, StringsHaveTheEscapesOfC) {
  EXPECT_EQ(stringOf(R"("a\n\t\"\\b")"), "a\n\t\"\\b");
  EXPECT_EQ(stringOf(R"("\101\60\0612")"), "A012");
  EXPECT_EQ(stringOf(R"("%f\q")"), "%fq");
  EXPECT_EQ(stringOf("\"one \" \"two\"\n\"three\""), "one twothree");
  EXPECT_EQ(stringOf("\"a\\\nb\""), "ab");
}

TEST(Words, AllEndsOfLinesAreOne) {
  for (const char* text : {"a\nb\n\nc", "a\r\nb\r\n\r\nc", "a\rb\r\rc"}) {
    const Front front(text);
    EXPECT_EQ(spelled(front.tokens), "a b c");
    EXPECT_EQ(front.tokens[2].place.line, 4);
  }
  EXPECT_EQ(preprocessedText("#define a 1\r\na\r\n"), "1");
  EXPECT_EQ(preprocessedText("#define a \\\r\n1\r\na"), "1");
  EXPECT_EQ(preprocessedText("#define a 1\ra"), "1");
}

TEST(Words, ContinuedLinesAreOne) {
  EXPECT_EQ(preprocessedText("ab\\\ncd"), "abcd");
  EXPECT_EQ(preprocessedText("#define a 1 + \\  \n 2\na"), "1 + 2") << "blanks after the backslash";
  EXPECT_EQ(preprocessedText("+\\\n= /\\\n* x *\\\n/ 1"), "+= 1");
  EXPECT_EQ(preprocessedText("// a \\\nb\nc"), "c");
}

TEST(Words, CommentsAreBlanks) {
  EXPECT_EQ(preprocessedText("a/**/b/*/*/c//d\ne"), "a b c e");
  EXPECT_EQ(preprocessedText("/* \xe9\xff \x01 */ a // \xe9"), "a") << "any bytes";
  EXPECT_EQ(preprocessedText("#define a /* two\nlines */ 1\na"), "1");
}

TEST(Words, AFileMayLackItsLastEndOfLineOrBeEmpty) {
  EXPECT_EQ(preprocessedText("#define a 1\n#ifdef a\na\n#endif"), "1");
  EXPECT_EQ(preprocessedText("a // b"), "a");
  EXPECT_EQ(preprocessedText(""), "");
  EXPECT_EQ(Front("").tokens.size(), 1u);
  EXPECT_EQ(preprocessedText("\xEF\xBB\xBF"
                             "a"),
            "a")
      << "a byte order mark";
  EXPECT_EQ(preprocessedText("a\n\x1a"), "a") << "the end of a file of DOS";
}

TEST(Places, AreThoseInTheFile) {
  const Front front("a\n\tbc  d\\\ne /* x\n*/ f");
  const auto at = [&](size_t i) {
    return fmt::format("{}:{}", front.tokens[i].place.line, front.tokens[i].place.column);
  };
  EXPECT_EQ(at(0), "1:1");
  EXPECT_EQ(at(1), "2:2");
  EXPECT_EQ(at(2), "2:6");
  EXPECT_EQ(at(3), "4:4");
  EXPECT_EQ(at(4), "4:5") << "the end";
}

TEST(Places, OfAMacrosTextAreInItsDefinitionAndArgumentsStayWhereTheyAre) {
  const Front front("#define f(x) x + y\n#define g f(2)\n  f(1) g");
  ASSERT_EQ(spelled(front.tokens), "1 + y 2 + y");
  EXPECT_EQ(front.sources.text(front.tokens[0].place), "a.sl:3:5");
  EXPECT_EQ(front.sources.text(front.tokens[2].place), "a.sl:1:18");
  EXPECT_EQ(front.sources.text(front.sources.outermost(front.tokens[2].place)), "a.sl:3:3");
  EXPECT_EQ(front.sources.text(front.tokens[3].place), "a.sl:2:13");
  EXPECT_EQ(front.sources.text(front.sources.outermost(front.tokens[5].place)), "a.sl:3:8");
  EXPECT_EQ(front.sources.expansion(front.tokens[5].place.expansion).macro, "f");
}

TEST(Places, AreDumpedWithKindAndText) {
  const Front front("a 1.5 \"s\" +=");
  EXPECT_EQ(
      dump(front.tokens, front.sources),
      "a.sl:1:1 name 'a'\na.sl:1:3 number '1.5'\na.sl:1:7 string 's'\na.sl:1:11 punctuator '+='\na.sl:1:13 end \n");
}

TEST(Messages, ShowTheLineWithACaretThatFits) {
  Front front("surface x() {\n\tCi = \t(1, 2);\n}");
  front.parsed();
  EXPECT_EQ(front.messages.rendered(front.sources),
            "a.sl:2:8: error: 2 values in brackets; a triple has 3, and a matrix 16\n"
            "\tCi = \t(1, 2);\n"
            "\t     \t^\n");
}

TEST(Messages, UnderlineTheWord) {
  Front front("surfce x() { }");
  front.parsed();
  EXPECT_EQ(front.messages.rendered(front.sources),
            "a.sl:1:1: error: expected a shader or a function before 'surfce'; did you mean 'surface'?\n"
            "surfce x() { }\n"
            "^~~~~~\n");
}

TEST(Messages, NameTheMacrosThatTheTextComesFrom) {
  Front front("#define two(x) x 7\n#define one two(1)\nsurface x() {\n  a = one;\n}");
  front.parsed();
  EXPECT_EQ(front.messages.rendered(front.sources),
            "a.sl:1:18: error: expected ';' before '7'\n"
            "#define two(x) x 7\n"
            "                 ^\n"
            "a.sl:2:13: note: in expansion of macro 'two'\n"
            "#define one two(1)\n"
            "            ^~~\n"
            "a.sl:4:7: note: in expansion of macro 'one'\n"
            "  a = one;\n"
            "      ^~~\n");
}

TEST(Messages, OfLongLinesShowAPart) {
  Front front("surface x() { " + std::string(5000, ' ') + "a = ; " + std::string(5000, ' ') + " }");
  front.parsed();
  const std::string text = front.messages.rendered(front.sources);
  EXPECT_NE(text.find("a.sl:1:5019: error: expected an expression before ';'"), std::string::npos);
  EXPECT_LT(text.size(), 600u);
}

TEST(Messages, PassNoControlBytesToATerminal) {
  Front front("\x1b[31m surface");
  const std::string text = front.parsed().messages.rendered(front.sources);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(Messages, BeyondTheMostAreCounted) {
  Messages messages;
  for (int i = 0; i < 30; ++i) {
    messages.error({.line = i}, "e");
    messages.note({.line = i}, "n");
  }
  EXPECT_EQ(messages.errorCount(), 30);
  EXPECT_EQ(messages.all().size(), 40u);
  EXPECT_NE(messages.rendered(Sources{}).find("10 more errors are not shown"), std::string::npos);
}

TEST(Messages, AreToldOnceWithTheirNotes) {
  Messages messages;
  for (int i = 0; i < 2; ++i) {
    messages.error({.line = 1}, "e");
    messages.note({.line = 2}, "n");
    messages.missing({.line = 3}, "m");
  }
  EXPECT_EQ(messages.errorCount(), 1);
  EXPECT_EQ(messages.missingCount(), 1);
  EXPECT_EQ(messages.all().size(), 3u);
}

TEST(NearNames, AreTheNearestFirst) {
  const std::vector<std::string> known{"surface", "light", "float", "displacement", "noise", "pnoise"};
  EXPECT_EQ(nearNames("surfce", known), std::vector<std::string>{"surface"});
  EXPECT_EQ(nearNames("flaot", known), std::vector<std::string>{"float"}) << "two letters changed places";
  EXPECT_EQ(nearNames("nois", known, 2), (std::vector<std::string>{"noise"}));
  EXPECT_EQ(nearNames("noises", known, 2), (std::vector<std::string>{"noise", "pnoise"}));
  EXPECT_TRUE(nearNames("wood", known).empty());
  EXPECT_TRUE(nearNames("a", {"b"}).empty());
  EXPECT_TRUE(nearNames(std::string(100, 'a'), {std::string(99, 'a')}).empty());
}

}  // namespace
}  // namespace tomales::compiler
