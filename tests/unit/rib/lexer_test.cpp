#include "reyes/rib/lexer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tomales::rib {
namespace {

using Kind = Token::Kind;

std::vector<Token> tokens(const std::string& text) {
  const auto stream = ByteStream::fromMemory(text);
  std::vector<Token> out;
  for (Lexer lexer(*stream, "scene.rib"); lexer.peek().kind != Kind::End; lexer.advance()) out.push_back(lexer.peek());
  return out;
}

TEST(Lexer, EndsCommentsAndCountsLinesWhereUnixDosAndTheOldMacintoshEndThem) {
  for (const char* const end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char* const line :
         {"##RenderMan RIB", "Color # red", "[1 2", "\"in", "two\"", "3 4]", "Sphere \"a\\", "b\""})
      text += std::string(line) + end;
    const auto list = tokens(text);
    ASSERT_FALSE(list.empty()) << text;
    EXPECT_EQ(list.front().text, "Color") << text;
    EXPECT_EQ(list.front().line, 2) << text;
    EXPECT_EQ(list.back().text, "ab") << text;
    EXPECT_EQ(list.back().line, 7) << text;
  }
}

TEST(Lexer, CountsTheLinesOfNumbersThatItSkipsOrTakesAsTheFileEndsThem) {
  for (const char* const end : {"\n", "\r\n", "\r"}) {
    const std::string text = std::string("1") + end + "2" + end + end + "3" + end + "Color";
    const auto stream = ByteStream::fromMemory(text);
    Lexer skips(*stream, "scene.rib");
    skips.advancePastNumbers();
    EXPECT_EQ(skips.peek().line, 5) << text;
    const auto again = ByteStream::fromMemory(text);
    Lexer takes(*again, "scene.rib");
    std::vector<float> numbers;
    takes.takeNumbers(numbers);
    EXPECT_EQ(numbers.size(), 3u) << text;
    EXPECT_EQ(takes.peek().line, 5) << text;
  }
}

TEST(Lexer, ReadsNumbersInEveryWriting) {
  const std::string text = "1 -2 +3 .5 -.5 4. 1e3 1E-3 +1.5e+2 007";
  const double expected[] = {1, -2, 3, .5, -.5, 4, 1000, .001, 150, 7};
  const auto list = tokens(text);
  ASSERT_EQ(list.size(), std::size(expected));
  for (size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i].kind, Kind::Number) << i;
    EXPECT_DOUBLE_EQ(list[i].number.wide, expected[i]) << i;
  }
}

TEST(Lexer, TakesNanInfAndOverflowAsNumbers) {
  const auto list = tokens("nan -nan inf -inf Infinity 1e999 -1e999 1e-999");
  ASSERT_EQ(list.size(), 8u);
  for (const Token& t : list) EXPECT_EQ(t.kind, Kind::Number);
  EXPECT_TRUE(std::isnan(list[0].number.wide) && std::isnan(list[1].number.wide));
  for (const size_t i : {2, 4, 5}) EXPECT_EQ(list[i].number.wide, HUGE_VAL) << i;
  for (const size_t i : {3, 6}) EXPECT_EQ(list[i].number.wide, -HUGE_VAL) << i;
  EXPECT_EQ(list[7].number.wide, 0);
}

TEST(Lexer, UnderstandsStringEscapes) {
  const auto list = tokens(R"("a\"b" "\\" "x\ny" "\101\60" "" "q\z")");
  ASSERT_EQ(list.size(), 6u);
  const char* expected[] = {"a\"b", "\\", "x\ny", "A0", "", "qz"};
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(list[i].text, expected[i]);
  EXPECT_EQ(tokens(R"("\7\41x")")[0].text, "\a!x") << "of one and of two digits";
}

TEST(Lexer, SkipsCommentsAndCountsLines) {
  const auto list = tokens("##RenderMan RIB-Structure 1.0\nColor # [ \"\n1 \"a\nb\" 2\r\n]");
  ASSERT_EQ(list.size(), 5u);
  const int lines[] = {2, 3, 3, 4, 5};
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(list[i].line, lines[i]) << i;
  EXPECT_EQ(list[0].text, "Color");
  EXPECT_EQ(list[4].kind, Kind::Close);
}

TEST(Lexer, SeparatesBracketsFromNumbersWithoutBlanks) {
  const auto list = tokens("[1 2]\"a\"[-3]");
  ASSERT_EQ(list.size(), 8u);
  EXPECT_EQ(list[2].number.wide, 2);
  EXPECT_EQ(list[4].text, "a");
  EXPECT_EQ(list[6].number.wide, -3);
}

TEST(Lexer, MakesOneTokenOfARunOfJunk) {
  const auto list = tokens(std::string("A \xa7\xc7\x01\x02\xff B", 9));
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[1].kind, Kind::Junk);
  EXPECT_EQ(list[2].text, "B");
}

TEST(Lexer, GivesUpOnStringsWithoutEndAndOnEndlessWords) {
  EXPECT_EQ(tokens("\"abc")[0].kind, Kind::Junk);
  EXPECT_EQ(tokens("\"" + std::string(2 << 20, 'x') + "\"")[0].kind, Kind::Junk);
  const auto list = tokens(std::string(1 << 20, 'x') + " 1");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].kind, Kind::Junk);
  EXPECT_LT(list[0].text.size(), 100u);
}

TEST(Lexer, TakesPlacesFromTheProgramThatWroteTheStream) {
  const std::string text =
      "1\n#line 70 \"a scene.py\"\n2 # line 5 \"no.py\"\n3\n#line x \"no.py\"\n#line 4\n#line 5 \"no.py\n4\n#line 9 "
      "\"b\"";
  const auto stream = ByteStream::fromMemory(text);
  Lexer lexer(*stream, "scene.rib");
  const std::pair<const char*, int> expected[] = {
      {"scene.rib", 1}, {"a scene.py", 70}, {"a scene.py", 71}, {"a scene.py", 75}};
  for (const auto& [file, line] : expected) {
    ASSERT_EQ(lexer.peek().kind, Kind::Number);
    EXPECT_EQ(*lexer.file(), file);
    EXPECT_EQ(lexer.peek().line, line);
    lexer.advance();
  }
  EXPECT_EQ(lexer.peek().kind, Kind::End);
}

TEST(ByteStream, UnpacksGzipAndConcatenatedGzip) {
  std::string text;
  for (int i = 0; i < 50000; ++i) text += std::to_string(i) + " ";
  const auto list = tokens(gzip(text) + gzip("77"));
  ASSERT_EQ(list.size(), 50001u);
  EXPECT_EQ(list[49999].number.wide, 49999);
  EXPECT_EQ(list[50000].number.wide, 77);
}

TEST(ByteStream, TakesAfterGzipNothingButGzip) {
  using namespace std::string_literals;
  const std::string zlib = "\x78\x9c\x33\x37\x07\0\0\xa7\0\x6f"s;  // "77" in the wrapping of zlib
  for (const std::string& rest : {zlib, "77"s}) {
    const std::string packed = gzip("1 ") + rest;
    const auto stream = ByteStream::fromMemory(packed);
    Lexer lexer(*stream, "scene.rib");
    EXPECT_EQ(lexer.peek().number.wide, 1);
    lexer.advance();
    EXPECT_EQ(lexer.peek().kind, Kind::End);
    EXPECT_TRUE(stream->damaged());
  }
}

TEST(ByteStream, ReadsDamagedGzipUpToTheDamage) {
  const std::string whole = gzip("1 2 3 4 5 6 7 8 9 10 11 12"), cut = whole.substr(0, whole.size() - 9);
  const auto stream = ByteStream::fromMemory(cut);
  Lexer lexer(*stream, "scene.rib");
  while (lexer.peek().kind != Kind::End) lexer.advance();
  EXPECT_TRUE(stream->damaged());
  const std::string badHeader = "\x1f\x8bgarbage that is no gzip";
  const auto bad = ByteStream::fromMemory(badHeader);
  EXPECT_EQ(bad->get(), ByteStream::kEnd);
  EXPECT_TRUE(bad->damaged());
}

TEST(ByteStream, RefusesFoldersAndMissingFiles) {
  EXPECT_EQ(ByteStream::open("/"), nullptr);
  EXPECT_EQ(ByteStream::open("/no/such/file.rib"), nullptr);
}

}  // namespace
}  // namespace tomales::rib
