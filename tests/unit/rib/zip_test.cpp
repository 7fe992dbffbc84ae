// Archives that are members of zip files.

#include <filesystem>
#include <fstream>

#include "reyes/rib/stream.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

std::string bytes(uint32_t n, int size) {
  std::string out;
  for (int i = 0; i < size; ++i) out += static_cast<char>(i < 4 ? n >> 8 * i : 0);
  return out;
}

uint32_t number(const std::string& text, size_t at) {
  uint32_t out = 0;
  for (size_t i = 4; i-- > 0;) out = out << 8 | static_cast<unsigned char>(text[at + i]);
  return out;
}

/// Two members in front of a comment: "stored.rib" as it is, "in/packed.rib" deflated.
std::string zipOf(const std::string& text, bool damaged = false) {
  const std::string gz = rib::gzip(text), packed = gz.substr(10, gz.size() - 18);
  const uint32_t crc = number(gz, gz.size() - 8) + damaged;
  std::string out, directory;
  const auto add = [&](const std::string& name, uint32_t method, const std::string& data) {
    const std::string common =
        bytes(0, 2) + bytes(method, 2) + bytes(0, 4) + bytes(crc, 4) + bytes(static_cast<uint32_t>(data.size()), 4) +
        bytes(static_cast<uint32_t>(text.size()), 4) + bytes(static_cast<uint32_t>(name.size()), 2) + bytes(0, 2);
    directory +=
        "PK\x01\x02" + bytes(20, 4) + common + bytes(0, 10) + bytes(static_cast<uint32_t>(out.size()), 4) + name;
    out += "PK\x03\x04" + bytes(20, 2) + common + name + data;
  };
  add("stored.rib", 0, text);
  add("in/packed.rib", 8, packed);
  const auto start = static_cast<uint32_t>(out.size());
  const std::string comment = "comment";
  return out + directory + "PK\x05\x06" + bytes(0, 4) + bytes(2, 2) + bytes(2, 2) +
         bytes(static_cast<uint32_t>(directory.size()), 4) + bytes(start, 4) +
         bytes(static_cast<uint32_t>(comment.size()), 2) + comment;
}

/// A zip file at this path.
std::string written(const std::string& content) {
  const std::string path = testing::TempDir() + "tomales_models.zip";
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

const std::string kBalls = "Sphere 1 -1 1 360\nSphere 2 -2 2 360\n";

TEST(ZipMember, IsReadAsAnArchiveStoredOrDeflated) {
  for (const char* member : {"!stored.rib", "!in/packed.rib"}) {
    const Reading r(inWorld("ReadArchive \"" + written(zipOf(kBalls)) + member + "\""));
    EXPECT_EQ(r.scene().objects.size(), 2u) << member;
    EXPECT_TRUE(r.log.entries().empty()) << r.codes();
  }
}

TEST(ZipMember, IsFoundBelowAFolderAboveTheReadingFile) {
  // Exporters name files relative to the folder of a project, and write scenes into folders within that.
  const std::string project = testing::TempDir() + "tomales_project/";
  std::filesystem::create_directories(project + "rib/0001");
  std::filesystem::create_directories(project + "rib/job");
  std::filesystem::copy_file(written(zipOf(kBalls)), project + "rib/job/models.zip",
                             std::filesystem::copy_options::overwrite_existing);
  const Reading r(inWorld("ReadArchive \"rib/job/models.zip!in/packed.rib\""), {project + "rib/0001"});
  EXPECT_EQ(r.scene().objects.size(), 2u);
  EXPECT_EQ(r.codes(), "rib-elsewhere@2 ");
}

TEST(ZipMember, IsMissingWhereThereIsNone) {
  const Reading r(inWorld("ReadArchive \"" + written(zipOf(kBalls)) + "!other.rib\""));
  EXPECT_EQ(r.log.count("rib-missing-archive"), 1);
}

TEST(ZipMember, IsReportedWhereItIsDamaged) {
  const Reading r(inWorld("ReadArchive \"" + written(zipOf(kBalls, true)) + "!in/packed.rib\""));
  EXPECT_EQ(r.log.count("rib-gzip"), 1);
}

TEST(ZipMember, OfAZipFileThatIsCutOffAnywhereEndsWell) {
  const std::string whole = zipOf(kBalls);
  for (size_t n = 0; n < whole.size(); ++n) {
    const auto stream = rib::ByteStream::open(written(whole.substr(0, n)) + "!in/packed.rib");
    while (stream && stream->get() != rib::ByteStream::kEnd) {
    }
  }
  std::string noise = whole;
  for (size_t n = 0; n < whole.size(); ++n) {
    noise[n] = static_cast<char>(~noise[n]);
    const auto stream = rib::ByteStream::open(written(noise) + "!in/packed.rib");
    while (stream && stream->get() != rib::ByteStream::kEnd) {
    }
    noise[n] = whole[n];
  }
}

}  // namespace
}  // namespace tomales
