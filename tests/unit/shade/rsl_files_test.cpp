// Shaders that are found as texts in folders: by which names, what is said of them, and when they are compiled again.
#include <fstream>

#include "reyes/moving_surfaces.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

class RslFiles : public Stage {
 protected:
  RslFiles() {
    static int count = 0;
    folder = test::temporary("rsl_files" + std::to_string(count++));
    fs::create_directories(folder + "/sub");
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder + "/" + name) << text;
    return folder + "/" + name;
  }
  const TmShader* find(const std::string& name, TmKind kind = TM_SURFACE) { return findBy(registry, name, kind); }
  const TmShader* findBy(ShaderRegistry& by, const std::string& name, TmKind kind = TM_SURFACE) const {
    return by.find(name, kind, folder + ":" + folder + "/sub");
  }
  static std::string saidIn(const Log& log) {
    std::string out;
    for (const LogEntry& e : log.entries())
      out += e.code + ": " + (e.where.file ? *e.where.file + ": " : "") +
             (e.where.line ? std::to_string(e.where.line) + ": " : "") + e.message + "\n";
    return out;
  }
  std::string said() const { return saidIn(log); }
  bool says(const std::string& part) const { return said().find(part) != std::string::npos; }
  static std::string nameOf(const TmShader* shader) { return shader ? shader->name : "none"; }

  std::string folder;
};

const std::string kPaint = "surface paint(float a = 1;) { Oi = Os; Ci = a; }";

TEST_F(RslFiles, AreFoundByTheNameOfTheFileWhateverFolderOrEndingIsWritten) {
  write("sub/paint.sl", kPaint);
  for (const char* name : {"paint", "paint.sl", "paint.slo", "paint.sdr"})
    EXPECT_EQ(nameOf(find(name)), "paint") << name;
  EXPECT_EQ(said(), "");
  for (const char* name : {"shaders/paint", "/elsewhere/paint.sl", "../paint"})
    EXPECT_EQ(nameOf(find(name)), "paint") << name;
  EXPECT_EQ(log.entries().size(), 3u);
  EXPECT_TRUE(says("shader-elsewhere: shader \"shaders/paint\" is not there; " + folder + "/sub/paint.sl is taken"));
  EXPECT_EQ(nameOf(find("PAINT")), "paint") << "some systems do not tell capitals apart";
  EXPECT_EQ(nameOf(find("paints")), "none");
  EXPECT_EQ(nameOf(find(".sl")), "none");
}

TEST_F(RslFiles, AreTakenFromWhereTheirNamesSayThatTheyLie) {
  write("paint.sl", "surface paint(float b = 1;) {}");
  const std::string other = folder + "_other";
  fs::create_directories(other);
  std::ofstream(other + "/paint.sl") << kPaint;
  for (const std::string& name : {other + "/paint", "../" + fs::path(other).filename().string() + "/paint.slo"}) {
    const TmShader* const shader = find(name);
    ASSERT_TRUE(shader) << name;
    EXPECT_STREQ(shader->params[0].name, "a") << name;
  }
  EXPECT_EQ(said(), "");
}

TEST_F(RslFiles, InTheSearchPathComeBeforeThoseOfFoldersAboveIt) {
  fs::create_directories(folder + "/lib");
  fs::create_directories(folder + "/sub");
  write("lib/paint.sl", "surface paint(float b = 1;) {}");
  const auto isFound = [&](const char* parameter) {
    Log said;
    ShaderRegistry later(said);
    const TmShader* const shader = later.find("lib/paint", TM_SURFACE, folder + "/sub");
    return shader && shader->params[0].name == std::string(parameter);
  };
  EXPECT_TRUE(isFound("b"));
  write("sub/paint.sl", kPaint);
  EXPECT_TRUE(isFound("a"));
}

TEST_F(RslFiles, OfAnotherMachineAreSoughtByTheEndsOfTheirNames) {
  fs::create_directories(folder + "/looks/wet");
  write("looks/wet/paint.sl", kPaint);
  for (const char* name : {"/home/ann/looks/wet/paint", "C:\\scenes\\looks\\wet\\paint.slo"}) {
    Log said;
    ShaderRegistry later(said);
    EXPECT_EQ(nameOf(findBy(later, name)), "paint") << name;
    EXPECT_NE(saidIn(said).find("shader-elsewhere"), std::string::npos) << name;
  }
  EXPECT_EQ(nameOf(find("/home/ann/wet/paint")), "none");
}

TEST_F(RslFiles, ThatAreNotThereAndHaveAStandardNameBehindTheirFoldersAreBuiltIn) {
  for (const char* name : {"matte.slo", "shaders/matte", "/opt/lib/shaders/matte.slo", "C:\\lib\\matte.slo"}) {
    EXPECT_EQ(nameOf(find(name)), "matte") << name;
    EXPECT_TRUE(says("shader \"" + std::string(name) + "\" is not there; the built-in \"matte\" is taken")) << said();
  }
  EXPECT_EQ(nameOf(find("shaders/disney")), "none") << "another renderer's looks different";
  EXPECT_EQ(nameOf(find("shaders/matte", TM_LIGHT)), "none");
  write("sub/matte.sl", "surface matte(float mine = 1) {}");
  ShaderRegistry later(log);
  EXPECT_STREQ(findBy(later, "shaders/matte")->params[0].name, "mine") << "a file comes first";
}

TEST_F(RslFiles, OfTheFirstFolderComeFirst) {
  write("sub/paint.sl", "surface paint(float b = 1;) {}");
  EXPECT_STREQ(find("paint")->params[0].name, "b");
  write("paint.sl", kPaint);
  ShaderRegistry later(log);
  EXPECT_STREQ(findBy(later, "paint")->params[0].name, "a");
}

TEST_F(RslFiles, MayHaveOtherNamesThanTheirShaders) {
  write("one.sl", "/* surface*/ surface  other() {}");
  write("many.sl", "surface red() {}\nlight green(float g = 1;) { illuminate(point \"shader\" (0, 0, 0)) Cl = g; }");
  EXPECT_EQ(nameOf(find("other")), "other");
  EXPECT_EQ(nameOf(find("one")), "other") << "it is the only one";
  EXPECT_EQ(nameOf(find("green", TM_LIGHT)), "green");
  EXPECT_EQ(said(), "");
  EXPECT_EQ(nameOf(find("many")), "none");
  EXPECT_EQ(nameOf(find("green")), "none");
  EXPECT_TRUE(
      says("shader-text: " + folder + "/many.sl: has no surface \"many\", but surface \"red\", light \"green\""))
      << said();
  EXPECT_TRUE(says("has no surface \"green\""));
  EXPECT_EQ(registry.hintOfMissing("green", TM_SURFACE, folder, ""), "") << "it is not known to the registry";
}

TEST_F(RslFiles, ThatHaveTheShadersNameAndHoldItComeBeforeOthersThatHoldIt) {
  write("another.sl", "surface paint(float b = 1;) {}");
  write("paint.sl", kPaint);
  EXPECT_STREQ(find("paint")->params[0].name, "a");
}

TEST_F(RslFiles, WhoseShaderIsNamedByAMacroAreTakenAtTheirOwnName) {
  write("another.sl", "surface paint(float b = 1;) {}");
  write("paint.sl", "#define skin  paint\nsurface skin(float a = 1;) {}");
  EXPECT_STREQ(find("paint")->params[0].name, "a");
}

TEST_F(RslFiles, AreCompiledAgainWhenTheyOrWhatTheyIncludeChanges) {
  write("part.h", "#define VALUE 1\n");
  const std::string path = write("paint.sl", "#include \"part.h\"\nsurface paint(float a = VALUE;) { Ci = a; }");
  const TmShader* const first = find("paint");
  ASSERT_TRUE(first);
  const auto again = [&] {
    ShaderRegistry later(log);
    return findBy(later, "paint");
  };
  EXPECT_EQ(again(), first);
  EXPECT_EQ(registry.originOf(*first), path);
  EXPECT_EQ(registry.filesOf(*first), (std::vector<std::string>{path, folder + "/part.h"}));
  write("part.h", "#define VALUE 23\n");
  const TmShader* const second = again();
  EXPECT_NE(second, first);
  EXPECT_EQ(again(), second);
  EXPECT_EQ(find("paint"), first) << "a registry keeps its answers";
  write("paint.sl", "surface painted() {}");
  EXPECT_EQ(nameOf(again()), "painted");
  EXPECT_EQ(registry.filesOf(*find("constant")), std::vector<std::string>{});
}

TEST_F(RslFiles, WithErrorsAreToldOnce) {
  const std::string path = write("paint.sl", "surface paint() { Ci = nothing; }");
  EXPECT_EQ(find("paint"), nullptr);
  EXPECT_EQ(find("paint.slo"), nullptr);
  EXPECT_EQ(log.entries().size(), 1u);
  EXPECT_TRUE(says("shader-text: " + path + ": does not compile:\n")) << said();
  EXPECT_TRUE(says("nothing")) << said();
  EXPECT_EQ(registry.hintOfMissing("paint", TM_SURFACE, folder + ":" + folder + "/sub", ""),
            "; its text \"" + path + "\" has errors");
  write("sub/paint.sl", kPaint);
  ShaderRegistry later(log);
  EXPECT_EQ(nameOf(findBy(later, "paint")), "paint") << "that of a later folder stands in for it";
}

TEST_F(RslFiles, CompiledForAnotherRendererAreNamed) {
  const std::string path = write("sub/old.sdr", "x");
  EXPECT_EQ(find("old"), nullptr);
  EXPECT_TRUE(says(path + " is compiled for another renderer; put its .sl beside it")) << said();
}

TEST_F(RslFiles, OfStandardNamesAreUsedIfTheyHaveMoreParametersOrAreAskedFor) {
  const std::string path = write("matte.sl", "surface matte(float Ka = 1, Kd = 1;) { Ci = 0; }");
  std::string why;
  const auto origin = [&](std::optional<bool> fromFiles) {
    Log own(Log::Verbosity::Quiet);
    ShaderRegistry by(own, {}, fromFiles);
    by.addLibrary(tomales_builtin_shaders(), "built-in");
    const std::string out = by.originOf(*findBy(by, "matte"));
    why = saidIn(own);
    return out;
  };
  const auto expectWhy = [&](const std::string& part) { EXPECT_NE(why.find(part), std::string::npos) << why; };
  const std::string ours = "shader-standard: " + path +
                           ": \"matte\" is a shader of RISpec's: the built-in one is used, not this file",
                    theirs = "this file is used, not the built-in one",
                    takesThis = " (--standard-shaders files would take this one)\n",
                    takesThat = " (--standard-shaders built-in would take that)\n";
  EXPECT_EQ(origin({}), "built-in");
  expectWhy(ours + takesThis);
  EXPECT_EQ(origin(false), "built-in");
  expectWhy(ours + takesThis);
  EXPECT_EQ(origin(true), path);
  expectWhy(theirs + takesThat);
  write("matte.sl", "surface matte(float Ka = 1, rust = 1;) { Ci = 0; }");
  EXPECT_EQ(origin({}), path);
  expectWhy(theirs + ", which has no parameter \"rust\"" + takesThat);
  write("matte.sl", "surface matte( { Ci = 0; }");
  EXPECT_EQ(origin({}), "built-in");
  expectWhy(ours + ", which does not compile:\n");
  EXPECT_EQ(why.find("--standard-shaders"), std::string::npos) << "nothing would take what does not compile";
  write("matte.sl", "light matte() {}");
  EXPECT_EQ(origin({}), "built-in");
  expectWhy(ours + ", which has no surface \"matte\", but light \"matte\"");
}

TEST_F(RslFiles, AddedAsTextsComeBeforeAllOthers) {
  write("paint.sl", "surface paint(float b = 1;) {}");
  const auto compiled = [](const std::string& path) { return RslFile::compile(path, {}); };
  EXPECT_TRUE(registry.addText(compiled(write("own.sl", kPaint)), "mine"));
  EXPECT_EQ(registry.originOf(*find("paint")), "mine");
  EXPECT_FALSE(registry.addText(compiled(write("bad.sl", "surface bad( {}")), "yours"));
  EXPECT_TRUE(says("shader-text: yours: does not compile:\n")) << said();
  const std::vector<const TmShader*> all = registry.all();
  EXPECT_NE(std::find(all.begin(), all.end(), find("paint")), all.end());
}

class MovingSurfaces : public RslFiles {
 protected:
  /// The attributes of the one object after surfaces that assign P have become its displacement.
  const Attributes& moved() {
    scene.options.searchPaths["shader"] = folder;
    system();
    displaceByMovingSurfaces(scene, registry, log);
    return *scene.objects[0].attributes;
  }
};

TEST_F(MovingSurfaces, BecomeTheDisplacementOfTheirObject) {
  write("wave.sl", "surface wave(float a = 1;) { P += a * N; Ci = 1; }");
  surface("wave", {number("a", 3)});
  const Attributes& a = moved();
  ASSERT_TRUE(a.displacement);
  EXPECT_EQ(a.displacement->name, "surface:wave");
  EXPECT_EQ(a.displacement->params.at(0).floats, (std::vector<float>{3}));
  EXPECT_TRUE(a.displacementOutputs.empty());
  EXPECT_EQ(scene.groups[0].attributes->displacement, a.displacement);
  EXPECT_TRUE(registry.find("surface:wave", TM_DISPLACEMENT, folder));
  EXPECT_FALSE(registry.find("surface:still", TM_DISPLACEMENT, folder));
  displaceByMovingSurfaces(scene, registry, log);
  EXPECT_EQ(said(), "") << "a scene that has been through it stays as it is";
}

TEST_F(MovingSurfaces, GiveWayToADisplacementShader) {
  write("wave.sl", "surface wave() { P += N; Ci = 1; }");
  write("bump.sl",
        "displacement bump(output float height = 0; output color c = 0; output string s = \"\";\n"
        "output float list[2] = {0, 0}; float a = 1;) { height = 1; P += N; }");
  surface("wave");
  displacement("bump");
  const Attributes& a = moved();
  EXPECT_EQ(a.displacement->name, "bump");
  EXPECT_TRUE(
      says("surface-moves: stage.rib: 7: surface shader \"wave\" assigns P, and displacement shader \"bump\" moves "
           "points too"))
      << said();
  ASSERT_EQ(a.displacementOutputs.size(), 2u) << "surfaces may ask for numbers, but not for texts and lists";
  EXPECT_EQ(a.displacementOutputs[0].name, "height");
  EXPECT_EQ(a.displacementOutputs[1].type, ValueType::Color);
}

TEST_F(MovingSurfaces, AreNoneWherePointsStay) {
  write("still.sl", "surface still() { Ci = 1; }");
  surface("still");
  EXPECT_FALSE(moved().displacement);
}

}  // namespace
}  // namespace tomales
