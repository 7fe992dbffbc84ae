// The files that a shader reads while it runs, found in its code.
#include "tests/unit/rsl/shaded.h"

namespace tomales::compiler {
namespace {

RslReads readsOf(const std::string& body, const std::string& parameters = "") {
  const CompiledText compiled("surface test(" + parameters + ") { Ci = 1; Oi = 1; " + body + " }");
  EXPECT_TRUE(compiled.good()) << compiled.said();
  return rslReads(*compiled.shader().host());
}

bool names(const RslReads& reads, const std::string& file) {
  return reads.isKnown && std::ranges::find(reads.names, file) != reads.names.end();
}

TEST(Reads, AreNamedByTheTextAndByDefaultsOfParameters) {
  EXPECT_TRUE(names(readsOf("Ci = color texture(\"a.tex\");"), "a.tex"));
  EXPECT_TRUE(names(readsOf("Ci = color environment(t, N);", "string t = \"b.env\""), "b.env"));
  EXPECT_TRUE(names(readsOf("Ci = shadow(\"c.z\", P);"), "c.z"));
  EXPECT_TRUE(names(readsOf("color c = 0; texture3d(\"d.ptc\", P, N, \"c\", c); Ci = c;"), "d.ptc"));
  EXPECT_TRUE(names(readsOf("Ci = occlusion(P, N, 0, \"pointbased\", 1, \"filename\", \"e.ptc\");"), "e.ptc"));
}

TEST(Reads, FollowNamesThroughVariablesConditionsAndArrays) {
  for (const char* way : {"string n = a; if (s > 0.5) n = \"b.tex\";",
                          "string all[2] = {\"b.tex\", \"c.tex\"}; string n = all[round(s)];",
                          "string all[2]; all[0] = a; all[1] = \"b.tex\"; string n = all[1];"}) {
    const RslReads reads = readsOf(std::string(way) + " Ci = color texture(n);", "string a = \"\"");
    EXPECT_TRUE(names(reads, "b.tex")) << way;
  }
}

TEST(Reads, AreNotTextsThatNoFileIsNamedBy) {
  const RslReads reads = readsOf(
      "string n = a; if (m == \"mode\") n = \"b.tex\"; Ci = color texture(n); bake3d(\"out.ptc\", \"c\", P, N, \"c\", "
      "Ci);",
      "string a = \"a.tex\"; string m = \"other\"");
  EXPECT_TRUE(names(reads, "a.tex") && names(reads, "b.tex"));
  for (const char* other : {"mode", "other", "out.ptc", "c"}) EXPECT_FALSE(names(reads, other)) << other;
}

TEST(Reads, AreUnknownIfANameIsComputedOrTold) {
  for (const char* way : {"string n = concat(a, \".tex\");", "string n = format(\"%f.tex\", s);",
                          "string n = a; attribute(\"user:n\", n);", "string n = a; n = shadername(\"displacement\");",
                          "string all[2]; all[0] = concat(a, \"x\"); string n = all[1];",
                          "string n = a; string m = concat(a, \"b\"); if (s > 0.5) n = m;"}) {
    const std::string parameters = "string a = \"\"";
    EXPECT_FALSE(readsOf(std::string(way) + " Ci = color texture(n);", parameters).isKnown) << way;
    EXPECT_TRUE(readsOf(std::string(way) + " if (n == \"\") Ci = 0;", parameters).isKnown) << way << " reads nothing";
    EXPECT_TRUE(readsOf(std::string(way) + " Ci = color texture(a);", parameters).isKnown) << way << " reads another";
  }
}

TEST(Reads, OfASurfaceThatMovesItsPointsAreThoseOfBothParts) {
  const RslReads reads = readsOf("P += N * texture(\"bump.tex\"); Ci = color texture(\"paint.tex\");");
  EXPECT_TRUE(names(reads, "bump.tex"));
  EXPECT_TRUE(names(reads, "paint.tex"));
}

TEST(Reads, AreNoneWhereNothingIsRead) {
  EXPECT_TRUE(readsOf("Ci = transform(\"world\", P) == P ? 1 : 0;").names.empty());
}

}  // namespace
}  // namespace tomales::compiler
