// Binary RIB byte by byte, and what the writer makes of requests.
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "places.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

using namespace std::string_literals;

struct Recorder : RiSink {
  std::vector<Request> list;
  void request(const Request& r) override { list.push_back(r); }
};

std::vector<Request> parsed(const std::string& text) {
  Log log(Log::Verbosity::Quiet);
  Recorder out;
  parseRibText(text, "test.rib", out, log);
  return out.list;
}

std::string written(const std::vector<Request>& list, bool binary, bool gzip) {
  std::string out;
  auto writer = makeRibWriter({binary, gzip, [&](std::string_view t) { out += t; }});
  for (const Request& r : list) writer->request(r);
  writer.reset();
  return out;
}

bool same(const std::vector<float>& a, const std::vector<float>& b) {
  const auto bits = [](float x, float y) {
    return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y) || (std::isnan(x) && std::isnan(y));
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), bits);
}

void expectSame(const std::vector<Request>& a, const std::vector<Request>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(a[i].name + " at " + a[i].where.text());
    ASSERT_EQ(a[i].name, b[i].name);
    ASSERT_EQ(a[i].args.size(), b[i].args.size());
    for (size_t k = 0; k < a[i].args.size(); ++k) {
      EXPECT_EQ(a[i].args[k].kind, b[i].args[k].kind);
      EXPECT_TRUE(same(a[i].args[k].numbers, b[i].args[k].numbers));
      EXPECT_EQ(a[i].args[k].strings, b[i].args[k].strings);
      EXPECT_EQ(a[i].args[k].integers, b[i].args[k].integers);
    }
    EXPECT_EQ(a[i].references, b[i].references);
    ASSERT_EQ(a[i].params.size(), b[i].params.size());
    for (size_t k = 0; k < a[i].params.size(); ++k) {
      Param x = a[i].params[k], y = b[i].params[k];
      EXPECT_TRUE(same(x.floats, y.floats)) << x.name;
      x.floats.clear();
      y.floats.clear();
      EXPECT_EQ(x, y) << x.name << " " << y.name;
    }
  }
}

void expectRoundTrip(const std::string& text) {
  const std::vector<Request> once = parsed(text);
  ASSERT_FALSE(once.empty());
  for (const bool binary : {false, true})
    for (const bool gzip : {false, true}) expectSame(once, parsed(written(once, binary, gzip)));
}

TEST(BinaryRib, ReadsIntegersAndFixedPoint) {
  const Requests r(
      "Hyperboloid \x80\x05 \x80\xff \x81\xff\x00 \x82\x01\x00\x00 \x83\x80\x00\x00\x00 \x85\x01\x80 \x84\xc0"s);
  ASSERT_EQ(r.list.size(), 1u);
  EXPECT_EQ(r.list[0].args[0].numbers, (std::vector<float>{5, -1, -256, 65536, -2147483648.0f, 1.5f, -.25f}));
}

TEST(BinaryRib, ReadsFloatsDoublesAndArrays) {
  const Requests r(
      "Color \xa4\x3f\x80\x00\x00\xa5\x3f\xe0\x00\x00\x00\x00\x00\x00 0 Polygon \"P\" "
      "\xc8\x03\x3f\x80\x00\x00\x40\x00\x00\x00\x40\x40\x00\x00 "
      "Color \xc8\x03\x3f\x80\x00\x00\x40\x00\x00\x00\x40\x40\x00\x00"s);
  ASSERT_EQ(r.list.size(), 3u);
  EXPECT_EQ(r.list[0].args[0].numbers, (std::vector<float>{1, .5f, 0}));
  EXPECT_EQ(r.list[1].params.at(0).floats, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(r.list[2].args[0].numbers, (std::vector<float>{1, 2, 3}));
}

TEST(BinaryRib, DefinesAndRedefinesRequestsAndStrings) {
  const Requests r(
      "\xcc\x07\x97Surface\xa6\x07\x95matte \xcc\x07\"Identity\"\xa6\x07 \xcd\x01\xa0\x03one\xa6\x07 Surface \xcf\x01"s);
  ASSERT_EQ(r.list.size(), 4u);
  EXPECT_EQ(r.list[0].args[0].strings[0], "matte");
  EXPECT_EQ(r.list[1].name, "Identity");
  EXPECT_EQ(r.list[3].args[0].strings[0], "one");
  EXPECT_TRUE(r.log.entries().empty());
}

TEST(BinaryRib, MalformedInputIsLocatedAndReadingGoesOn) {
  for (const std::string& bad : {"\xa6\x09"s, "\xcf\x09"s, "\xcc\x01 5"s, "\xa7"s, "\xfe"s}) {
    const Requests r("Identity\nSurface " + bad + "\nColor 1 1 1");
    EXPECT_EQ(r.list.size(), 2u);
    ASSERT_FALSE(r.log.entries().empty());
    EXPECT_EQ(r.log.entries()[0].where.line, 2);
  }
  for (const std::string& cut :
       {"\xa4\x3f"s, "\xcb\xff\xff\xff\xff\x01\x02"s, "\xa3\xff\xff\xff\xff xyz"s, "\x83\x01"s}) {
    const Requests r("Identity\nPolygon \"P\" " + cut);
    EXPECT_EQ(r.list.size(), 1u);
    EXPECT_EQ(r.log.entries().at(0).where.line, 2);
  }
}

TEST(BinaryRib, CodesThatAreNotDefinedAreNamed) {
  for (const auto& [bad, named] : {std::pair("\xa6\x09"s, "the request code 9, which is not defined"),
                                   {"Surface \xcf\x0a"s, "the string code 10, which is not defined"},
                                   {"Surface \xd0\x01\x02"s, "the string code 258, which is not defined"}}) {
    const Requests r("Identity\n" + bad + "\nColor 1 1 1");
    EXPECT_EQ(r.list.size(), 2u) << named;
    ASSERT_FALSE(r.log.entries().empty()) << named;
    EXPECT_NE(r.log.entries()[0].message.find(named), std::string::npos) << r.log.entries()[0].message;
  }
}

TEST(BinaryRib, RandomBytesNeitherCrashNorHang) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string text = "WorldBegin Sphere 1 -1 1 360 ";
    for (int k = 0; k < 400; ++k) text += static_cast<char>(random() % 3 ? 0200 + random() % 128 : random() % 128);
    const Reading r(text);
    EXPECT_TRUE(r.good);
  }
}

TEST(ByteStream, StopsAtGzipBombs) {
  const std::string bomb = rib::gzip("Identity\n" + std::string(100 << 20, ' ') + "Identity\n");
  const auto stream = rib::ByteStream::fromMemory(bomb);
  size_t bytes = 0;
  for (; stream->peek() != rib::ByteStream::kEnd; stream->skipTo(stream->end()))
    bytes += static_cast<size_t>(stream->end() - stream->begin());
  EXPECT_TRUE(stream->damaged());
  EXPECT_LT(bytes, rib::ByteStream::kHarmless_bytes + (1 << 20));
}

TEST(ByteStream, StopsAtNothingThatIsHarmlessOrSwellsLess) {
  const auto isBomb = [](const std::string& packed) {
    const auto stream = rib::ByteStream::fromMemory(packed);
    while (stream->peek() != rib::ByteStream::kEnd) stream->skipTo(stream->end());
    return stream->damaged();
  };
  // A name in its header makes the file larger, up to the wanted size.
  const auto packed = [](size_t unpackedSize, size_t size) {
    std::string out = rib::gzip(std::string(unpackedSize, ' '));
    if (size <= out.size()) return out;
    out[3] = 8;
    return out.insert(10, std::string(size - out.size() - 1, 'n') + '\0');
  };
  using rib::ByteStream;
  EXPECT_FALSE(isBomb(packed(ByteStream::kHarmless_bytes, 0)));
  EXPECT_TRUE(isBomb(packed(ByteStream::kHarmless_bytes + 1, 0)));
  constexpr size_t kSize = size_t{6} << 16;
  EXPECT_FALSE(isBomb(packed(ByteStream::kLargestRatio * kSize, kSize)));
  EXPECT_TRUE(isBomb(packed(ByteStream::kLargestRatio * kSize, kSize - 1)));
}

TEST(Number, ScansLikeStrtofAndStrtodToTheLastBit) {
  std::mt19937_64 random(3);
  const auto check = [](const std::string& text) {
    rib::ScannedNumber n{};
    EXPECT_EQ(rib::scanNumber(text.data(), text.data() + text.size(), n), text.data() + text.size()) << text;
    EXPECT_EQ(std::bit_cast<uint32_t>(n.narrow), std::bit_cast<uint32_t>(std::strtof(text.c_str(), nullptr))) << text;
    EXPECT_EQ(std::bit_cast<uint64_t>(n.wide), std::bit_cast<uint64_t>(std::strtod(text.c_str(), nullptr))) << text;
  };
  char text[64];
  for (int i = 0; i < 200000; ++i) {
    const auto bits = static_cast<uint32_t>(random());
    const float f = std::bit_cast<float>(bits);
    if (!std::isfinite(f)) continue;
    std::snprintf(text, sizeof text, i % 2 ? "%.*g" : "%.*e", static_cast<int>(random() % 19 + 1),
                  static_cast<double>(f));
    check(text);
    std::snprintf(text, sizeof text, "%.*f", static_cast<int>(random() % 12), static_cast<double>(bits) * 1e-6 - 2000);
    check(text);
  }
  // Half-way between two floats, and a hair beside it.
  for (const char* t :
       {"16777217", "16777217.000000001", "16777216.999999999", "1.00000017881393432617187499",
        "1.00000017881393432617187500", "1.17549435e-38", "1e-45", "3.4028236e38", "1e400", "-0", "0.0"})
    check(t);
}

TEST(Writer, RoundTripsEveryKindOfArgument) {
  expectRoundTrip(
      "version 3.03 Declare \"my name\" \"uniform float[2]\" Declare \"w\" \"vertex hpoint\"\n"
      "Format 640 480 -1 Color [1 .1 -0] Rotate 30 0 1 0 DepthOfField DepthOfField 22 45 1200\n"
      "Basis \"bezier\" 3 [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16] 1 Clipping .1 inf\n"
      "Surface \"q\\\"uo\\\\te\\n\\001\" \"my name\" [1 2] \"uniform string[2] names\" [\"a\" \"\"] \"int[2] "
      "n\" [1 -2147483647]\n"
      "Attribute \"visibility\" \"camera\" 1 \"string transmission\" \"opaque\" LightSource \"spot\" 3 "
      "\"from\" [1e-30 2 nan]\n"
      "SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"interpolateboundary\"] [0 0] [] [] \"P\" [0 0 0 1 "
      "0 0 1 1 0 0 1 0]\n"
      "SubdivisionMesh \"catmull-clark\" [] [] \"w\" [] Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] "
      "MotionBegin [0 .5]\n"
      "Procedural \"RunProgram\" [\"a\" \"" +
      std::string(300, 'x') + "\"] [-inf inf 0 1 0 1]");
}

TEST(Writer, SaysEachNameOnceInBinary) {
  std::string text;
  for (int i = 0; i < 300; ++i)
    text += "Attribute \"user\" \"constant float quite_a_long_name\" " + std::to_string(i) + "\n";
  const std::string binary = written(parsed(text), true, false);
  for (const char* name : {"Attribute", "quite_a_long_name"}) EXPECT_EQ(binary.find(name), binary.rfind(name)) << name;
  EXPECT_LT(binary.size(), 300u * 20);
}

// The first 256 names have codes of one byte, and those beyond 65,536 have none.
TEST(Writer, RoundTripsMoreNamesThanThereAreCodes) {
  std::string text;
  for (int i = 0; i < 65600; ++i) {
    const std::string name = std::to_string(i);
    text += "Attribute \"user\" \"constant float n" + name + "\" 1\n";
    if (i < 300 || i > 65500) text += "Attribute \"user\" \"constant float n" + name + "\" 2\n";
  }
  const std::vector<Request> list = parsed(text);
  ASSERT_EQ(list.size(), 65600u + 300 + 99);
  expectSame(parsed(written(list, true, false)), list);
}

// TOMALES_RIB_FOLDER: one more folder, of scenes that are not ours to keep.
TEST(Writer, RoundTripsAllScenesAndTheUglyOnesToo) {
  std::vector<std::string> folders{TOMALES_SOURCE_DIR "/scenes", TOMALES_SOURCE_DIR "/tests/corpus",
                                   TOMALES_SOURCE_DIR "/docs"};
  if (const char* more = std::getenv("TOMALES_RIB_FOLDER")) folders.emplace_back(more);
  int scenes = 0;
  for (const std::string& folder : folders)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.path().string().find(".rib") == std::string::npos) continue;
      SCOPED_TRACE(entry.path().string());
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      if (parsed(text).empty()) continue;  // of the corpus
      expectRoundTrip(text);
      ++scenes;
    }
  EXPECT_GE(scenes, 60);
}

}  // namespace
}  // namespace tomales
