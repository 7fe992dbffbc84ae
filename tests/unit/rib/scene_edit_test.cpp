// Edits of shaders, lights and attributes of a scene whose geometry is settled.

#include <filesystem>
#include <fstream>

#include "rib_test_tools.h"

namespace tomales {
namespace scene_edits {
namespace {

const std::string kWorld = inWorld(
    "LightSource \"pointlight\" \"lamp\" \"intensity\" [5] \"from\" [1 2 3]\n"
    "AttributeBegin Attribute \"identifier\" \"name\" [\"a\"] Color .1 .1 .1 Surface \"plastic\" \"Kd\" [.5] \"Ks\" "
    "[.25]\n" +
    kSphere +
    "AttributeEnd AttributeBegin Attribute \"identifier\" \"name\" [\"b\"] Color .2 .2 .2 Surface \"matte\"\n" +
    kSphere + kSphere + "AttributeEnd Color .3 .3 .3\n" + kSphere);

/// The world above, edited by a text.
struct Edited {
  explicit Edited(const std::string& text) : scene(std::move(reading.scenes.at(0))) {
    scene.freeze();
    const auto file = std::filesystem::temp_directory_path() / "tomales_edit.rib";
    std::ofstream(file) << text;
    editScene({file.string()}, scene, reading.log);
    std::filesystem::remove(file);
  }
  const Attributes& of(const std::string& name) const {
    for (const Object& o : scene.objects)
      if (o.attributes->name == name) return *o.attributes;
    throw std::runtime_error("no object " + name);
  }
  /// Red of the objects a, b and the one without a name.
  vec3 reds() const { return {of("a").color.x, of("b").color.x, of("").color.x}; }
  float number(const ShaderCall& call, const std::string& name) const {
    const Param* p = findParam(call.params, name);
    return p ? p->number(0) : -1;
  }

  Reading reading{"Exposure 1 1\n" + kWorld};
  Scene scene;
};

TEST(SceneEdit, IsOfAllObjectsUntilSomeAreSelected) {
  EXPECT_EQ(Edited("Color 1 0 0").reds(), vec3(1));
  expectNear(Edited("Attribute \"identifier\" \"name\" [\"a\"] Color 1 0 0").reds(), {1, 0.2f, 0.3f});
  expectNear(Edited("Attribute \"identifier\" \"name\" [\"b\"] Color 1 0 0").reds(), {0.1f, 1, 0.3f});
}

TEST(SceneEdit, ASelectionLastsToTheEndOfItsBlock) {
  expectNear(
      Edited("AttributeBegin Attribute \"identifier\" \"name\" [\"a\"] Color 1 0 0 AttributeEnd Color .7 0 0").reds(),
      vec3(0.7f));
  expectNear(
      Edited("Attribute \"identifier\" \"name\" [\"b\"] AttributeBegin Attribute \"identifier\" \"name\" [\"a\"] "
             "Color 1 0 0 AttributeEnd Color .7 0 0")
          .reds(),
      {1, 0.7f, 0.3f});
}

TEST(SceneEdit, GroupsHaveTheAttributesOfTheirObjects) {
  const Edited e("Attribute \"identifier\" \"name\" [\"b\"] Color 1 0 0");
  EXPECT_TRUE(e.reading.log.entries().empty()) << e.reading.codes();
  for (const Object& o : e.scene.objects)
    EXPECT_EQ(e.scene.groups[static_cast<size_t>(o.group)].attributes, o.attributes);
}

TEST(SceneEdit, TheSameShaderKeepsWhatIsNotGivenAndAnotherOneDoesNot) {
  const Edited same("Attribute \"identifier\" \"name\" [\"a\"] Surface \"plastic\" \"Kd\" [.9]");
  EXPECT_EQ(same.of("a").surface->name, "plastic");
  EXPECT_EQ(same.number(*same.of("a").surface, "Kd"), 0.9f);
  EXPECT_EQ(same.number(*same.of("a").surface, "Ks"), 0.25f);
  EXPECT_EQ(same.of("b").surface->name, "matte");
  const Edited other("Attribute \"identifier\" \"name\" [\"a\"] Surface \"metal\" \"Kd\" [.9]");
  EXPECT_EQ(other.of("a").surface->name, "metal");
  EXPECT_EQ(other.number(*other.of("a").surface, "Ks"), -1);
}

TEST(SceneEdit, LightsAreKnownByTheirHandlesAndKeepWhatIsNotGiven) {
  const Edited e("LightSource \"pointlight\" \"lamp\" \"intensity\" [9]\nLightSource \"pointlight\" \"other\"");
  ASSERT_EQ(e.scene.lights.size(), 1u);
  EXPECT_EQ(e.number(e.scene.lights[0]->shader, "intensity"), 9);
  ASSERT_TRUE(findParam(e.scene.lights[0]->shader.params, "from"));
  EXPECT_EQ(e.reading.codes(), "edit-light@2 ");
}

TEST(SceneEdit, LightsAreSwitchedForTheSelection) {
  const Edited e("Attribute \"identifier\" \"name\" [\"a\"] Illuminate \"lamp\" 0");
  EXPECT_TRUE(e.of("a").lights.empty());
  EXPECT_EQ(e.of("b").lights.size(), 1u);
}

TEST(SceneEdit, ChangesOptionsOfThePicture) {
  const Edited e("Exposure 2 1.5\nImager \"background\" \"color background\" [1 0 0]");
  EXPECT_EQ(e.scene.options.exposureGain, 2);
  EXPECT_EQ(e.scene.options.exposureGamma, 1.5f);
  ASSERT_TRUE(e.scene.options.imager);
  EXPECT_EQ(e.scene.options.imager->name, "background");
  EXPECT_TRUE(e.reading.log.entries().empty()) << e.reading.codes();
}

TEST(SceneEdit, WhatItCannotChangeIsNamedWithItsLine) {
  EXPECT_EQ(Edited("Sphere 1 -1 1 360").reading.codes(), "edit-request@1 ");
  EXPECT_EQ(Edited("version 3.04\nDeclare \"x\" \"uniform float\"").reading.codes(), "");
  EXPECT_EQ(Edited("\nAttributeEnd").reading.codes(), "rib-unbalanced@2 ");
  EXPECT_EQ(Edited("Attribute \"identifier\" \"name\" [\"nobody\"]").reading.codes(), "edit-name@1 ");
  EXPECT_EQ(Edited("Attribute \"identifier\" \"string shadinggroup\" [\"a\"]").reading.codes(), "edit-name@1 ");
}

}  // namespace
}  // namespace scene_edits
}  // namespace tomales
