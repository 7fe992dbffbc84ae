// Tests which files #include reads, and which it must not read.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "front_test_tools.h"

namespace tomales::compiler {
namespace {

namespace fs = std::filesystem;

class Includes : public testing::Test {
 protected:
  void SetUp() override {
    root_ =
        fs::path(testing::TempDir()) / ("includes_" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(root_);
    for (const char* folder : {"own", "own/deep", "headers", "secret"}) fs::create_directories(root_ / folder);
    options_.includeFolders = {(root_ / "headers").string()};
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& path, const std::string& text) {
    std::ofstream(root_ / path, std::ios::binary) << text;
  }
  /// What own/a.sl becomes with that text, and the first message.
  std::string read(const std::string& text) {
    write("own/a.sl", text);
    sources_ = {};
    messages_ = {};
    const auto tokens = preprocess((root_ / "own/a.sl").string(), options_, sources_, messages_);
    return spelled(tokens) + (messages_.all().empty() ? "" : " !" + messages_.all()[0].text);
  }
  std::string withoutRoot(std::string text) const {
    for (size_t at; (at = text.find(root_.string())) != std::string::npos;) text.erase(at, root_.string().size() + 1);
    return text;
  }

  fs::path root_;
  PreprocessOptions options_;
  Sources sources_;
  Messages messages_;
};

TEST_F(Includes, InQuotesLookBesideTheFileThenInTheFoldersThenAtOurOwn) {
  EXPECT_NE(read("#include \"normals.h\"\n1").find("shadingnormal"), std::string::npos);
  write("headers/normals.h", "headers");
  EXPECT_EQ(read("#include \"normals.h\"\n1"), "headers 1");
  write("own/normals.h", "own");
  EXPECT_EQ(read("#include \"normals.h\"\n1"), "own 1");
}

TEST_F(Includes, OfAnotherFolderMayBeOurOwn) {
  EXPECT_NE(read("#include \"../include/normals.h\"\n1").find("shadingnormal"), std::string::npos);
  write("own/deep/normals.h", "own");
  EXPECT_EQ(read("#include \"deep/normals.h\"\n1"), "own 1");
}

TEST_F(Includes, InAnglesLookInTheFoldersAlone) {
  write("own/x.h", "own");
  EXPECT_EQ(read("#include <x.h>\n"),
            " !cannot include 'x.h': there is no such file beside the file or in the folders for headers");
  write("headers/x.h", "headers");
  EXPECT_EQ(read("#include <x.h>\n1"), "headers 1");
}

TEST_F(Includes, LookBesideTheIncludingFile) {
  write("own/deep/one.h", "#include \"two.h\"\none");
  write("own/deep/two.h", "two");
  EXPECT_EQ(read("#include \"deep/one.h\"\n1"), "two one 1");
  EXPECT_EQ(read("#include \"deep\\one.h\"\n1"), "two one 1") << "of DOS";
}

TEST_F(Includes, MayBeNamedByAMacro) {
  write("headers/x.h", "x");
  EXPECT_EQ(read("#define FILE \"x.h\"\n#include FILE\n1"), "x 1");
  EXPECT_EQ(read("#define FILE <x.h>\n#include FILE\n1"), "x 1");
}

TEST_F(Includes, ReadNothingOutsideOfTheFolders) {
  write("secret/x.h", "secret");
  const std::string refused = "it is outside of the folders from which files may be included";
  EXPECT_EQ(read("#include \"../secret/x.h\"\n"), " !cannot include '../secret/x.h': " + refused);
  const std::string absolute = (root_ / "secret/x.h").string();
  EXPECT_NE(read("#include \"" + absolute + "\"\n").find(refused), std::string::npos);
  fs::create_symlink(root_ / "secret/x.h", root_ / "own/link.h");
  EXPECT_EQ(read("#include \"link.h\"\n"), " !cannot include 'link.h': " + refused);
  fs::create_directory_symlink(root_ / "secret", root_ / "headers/linked");
  EXPECT_EQ(read("#include <linked/x.h>\n"), " !cannot include 'linked/x.h': " + refused);
  fs::create_directories(root_ / "headers2");
  write("headers2/x.h", "secret");
  EXPECT_NE(read("#include \"../headers2/x.h\"\n").find(refused), std::string::npos)
      << "a folder whose name begins alike";
  write("headers2/normals.h", "secret");
  EXPECT_NE(read("#include \"../headers2/normals.h\"\n").find(refused), std::string::npos)
      << "the renderer's own header is another one";
}

TEST_F(Includes, LookForHeadersWhereCollectionsOfShadersKeepThem) {
  for (const char* folder : {"include", "own/include"}) fs::create_directories(root_ / folder);
  write("include/x.h", "#include \"../include/y.h\"\nbeside");
  write("include/y.h", "y");
  EXPECT_EQ(read("#include \"x.h\"\n1"), "y beside 1");
  EXPECT_EQ(read("#include \"../include/x.h\"\n1"), "y beside 1");
  write("x.h", "above");
  EXPECT_EQ(read("#include <x.h>\n1"), "above 1");
  write("own/include/x.h", "below");
  EXPECT_EQ(read("#include \"x.h\"\n1"), "below 1");
  write("headers/x.h", "headers");
  EXPECT_EQ(read("#include \"x.h\"\n1"), "headers 1");
  EXPECT_EQ(read("#include \"../x.h\"\n1"), "above 1") << "where it says";
  write("include/normals.h", "theirs");
  EXPECT_EQ(read("#include \"../include/normals.h\"\n1"), "theirs 1");
  fs::create_symlink(root_ / "include/y.h", root_ / "include/link.h");
  EXPECT_NE(read("#include \"../include/link.h\"\n").find("!cannot include"), std::string::npos) << "a link";
}

TEST_F(Includes, LookForNothingElseThere) {
  const std::string refused = "': there is no such file beside the file or in the folders for headers";
  write("notes", "secret");
  write("notes.txt", "secret");
  write("secret/x.h", "secret");
  fs::create_symlink(root_ / "secret/x.h", root_ / "link.h");
  for (const std::string name : {"notes", "notes.txt", "secret/x.h", "link.h"})
    EXPECT_EQ(read("#include \"" + name + "\"\n"), " !cannot include '" + name + refused);
  const std::string outside = "': it is outside of the folders from which files may be included";
  for (const std::string name : {"../notes", "../notes.txt", "../secret/x.h", "../link.h"})
    EXPECT_EQ(read("#include \"" + name + "\"\n"), " !cannot include '" + name + outside);
  fs::create_directory_symlink(root_ / "secret", root_ / "own/include");
  EXPECT_EQ(read("#include \"x.h\"\n"), " !cannot include 'x.h" + refused) << "a link of a folder";
}

TEST_F(Includes, MayGoUpWithinAPermittedFolder) {
  write("headers/x.h", "x");
  EXPECT_EQ(read("#include \"../headers/x.h\"\n1"), "x 1");
  EXPECT_EQ(read("#include \"deep/../../headers/x.h\"\n1"), "x 1");
}

TEST_F(Includes, ReadPlainFilesAlone) {
  EXPECT_EQ(read("#include \"deep\"\n"), " !cannot include 'deep': it is not a plain file");
}

TEST_F(Includes, OfTheFileItselfEnd) {
  EXPECT_EQ(read("#include \"a.sl\"\nx"), " !files include each other more than 64 deep");
  write("own/b.h", "#include \"b.h\"\n#include \"b.h\"\n");
  EXPECT_EQ(read("#include \"b.h\"\nx"), " !files include each other more than 64 deep");
  EXPECT_LT(messages_.rendered(sources_).size(), 2000u);
}

TEST_F(Includes, AreGuardedByIfndef) {
  write("headers/x.h", "#ifndef X\n#define X\nx\n#endif\n");
  EXPECT_EQ(read("#include \"x.h\"\n#include <x.h>\n1"), "x 1");
}

TEST_F(Includes, EndTheirOwnConditionsAndLines) {
  write("headers/x.h", "#if 1\nx");
  EXPECT_EQ(read("#include \"x.h\"\n1\n#else\n"), "x 1 !this condition is not closed: there is no '#endif' after it");
  write("headers/y.h", "y /* z");
  EXPECT_EQ(read("#include \"y.h\" junk\n1"), "y 1 !this comment is not closed: there is no '*/' after it");
}

TEST_F(Includes, AreNamedInMessages) {
  write("headers/x.h", "#include \"y.h\"\n");
  write("headers/y.h", "\n #error here\n");
  read("\n#include \"x.h\"\n");
  EXPECT_EQ(withoutRoot(messages_.rendered(sources_)),
            "headers/y.h:2:2: error: #error here\n"
            " #error here\n"
            " ^\n"
            "  included from headers/x.h:1\n"
            "  included from own/a.sl:2\n");
}

TEST_F(Includes, AMissingShaderIsAnError) {
  const auto tokens = preprocess((root_ / "own/none.sl").string(), options_, sources_, messages_);
  EXPECT_EQ(tokens.size(), 1u);
  EXPECT_EQ(withoutRoot(messages_.rendered(sources_)),
            "own/none.sl: error: the shader cannot be read: there is no such file\n");
}

TEST(Bounds, EndWhatGrowsWithoutEnd) {
  std::string laughs = "#define l0 x\n", empty = "#define l0\n";
  for (int i = 1; i < 12; ++i) {
    const std::string ten = fmt::format("#define l{} l{} l{} l{} l{} l{}\n", i, i - 1, i - 1, i - 1, i - 1, i - 1);
    laughs += ten;
    empty += ten;
  }
  EXPECT_EQ(preprocessedText(laughs + "l11"), " !more than 50000 uses of macros");
  EXPECT_EQ(preprocessedText(empty + "l11"), " !more than 50000 uses of macros");
  std::string nested = "x", doubled = "x", quotes = "\"\"";
  for (int i = 0; i < 150; ++i) {
    nested = "f(" + nested + ")";
    doubled = "g(" + doubled + ")";
    quotes = "t(" + quotes + ")";
  }
  EXPECT_EQ(preprocessedText("#define g(x) x x\n" + doubled), " !macros make more than 500000 words");
  EXPECT_EQ(preprocessedText("#define f(x) x\n" + nested), "x");
  EXPECT_EQ(preprocessedText("#define f(x) x\nf(" + std::string(300, 'f') + ")"), std::string(300, 'f'));
  EXPECT_EQ(preprocessedText("#define s(x) #x\n#define t(x) s(x)\n" + quotes),
            " !macros make more than 16 MiB of text");
  std::string paste = "#define p(x) x";
  for (int i = 0; i < 5000; ++i) paste += "##x";
  EXPECT_EQ(preprocessedText(paste + "\np(" + std::string(100, 'a') + ")"), " !macros make more than 16 MiB of text");
}

TEST(Bounds, NestedArgumentsOfMacrosEnd) {
  std::string nested = "1";
  for (int i = 0; i < 300; ++i) nested = "f(" + nested + ")";
  EXPECT_EQ(preprocessedText("#define f(x) x\n" + nested),
            " !more than 200 macros are nested in each other's arguments");
}

}  // namespace
}  // namespace tomales::compiler
