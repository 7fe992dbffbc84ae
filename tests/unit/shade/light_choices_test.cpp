// Which of many lamps are drawn from sets, and which objects share a set.
#include "reyes/shade/bound_scene.h"
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

constexpr int kDrawn = 2;              // lamps of a point
constexpr int kFew = 4 * kDrawn;       // so many lamps with shadows all run,
constexpr int kFewOpen = 32 * kDrawn;  // and so many without

class LightChoices : public Stage {
 protected:
  LightChoices() { scene.options.user["trace:lightcut"] = number("lightcut", kDrawn); }
  /// Adds lamps in a row. The name of a parameter may be given for all of them.
  void addLamps(int count, const ParamList& params = {}, bool shadows = true, const char* shader = "pointlight") {
    for (int k = 0; k < count; ++k) {
      ParamList own = params;
      if (shader == std::string("pointlight") && !findParam(params, "from"))
        own.push_back(point("from", {static_cast<float>(scene.lights.size()), 0, 0}));
      light(shader, own).castsShadows = shadows;
    }
  }
  /// Adds an object that the lamps from `first` on light, up to `end`.
  void addObject(int first, int end) {
    Attributes own;
    for (int k = first; k < end; ++k) own.lights.switchOn(k);
    Object o;
    o.shapes = {std::make_shared<BlankPrim>(std::vector<Primvar>{})};
    o.attributes = std::make_shared<const Attributes>(own);
    o.where = at(9);
    scene.objects.push_back(o);
  }
  /// What each object draws from; null where all lamps run.
  std::vector<const LightSets*> choices() {
    scene.freeze();
    bound = std::make_unique<BoundScene>(scene, registry, log, stats);
    std::vector<const LightSets*> out;
    for (const Object& o : scene.objects)
      out.push_back(bound->groups[static_cast<size_t>(o.group)].choice->sets(*bound));
    return out;
  }
  /// What one object under all lamps draws from.
  const LightSets* choice() {
    scene.objects.clear();
    addObject(0, static_cast<int>(scene.lights.size()));
    return choices()[0];
  }
  /// The part of the one set that each object draws from.
  std::vector<LightsOfSet> parts() {
    std::vector<LightsOfSet> out;
    for (const LightSets* sets : choices()) {
      EXPECT_TRUE(sets && sets->sets.size() == 1 && sets->alone.empty());
      out.push_back(sets->sets[0]);
    }
    return out;
  }
  std::unique_ptr<BoundScene> bound;
};

TEST_F(LightChoices, FewLampsAllRunAndMoreOfThemIfTheyCastNoShadows) {
  addLamps(kFew);
  EXPECT_FALSE(choice());
  addLamps(1);
  EXPECT_TRUE(choice());
  scene.lights.clear();
  addLamps(kFewOpen, {}, false);
  EXPECT_FALSE(choice());
  addLamps(1, {}, false);
  EXPECT_TRUE(choice());
  scene.options.user["trace:lightcut"] = number("lightcut", 0);
  EXPECT_FALSE(choice()) << "the scene wants all of them";
}

TEST_F(LightChoices, ASetHoldsTheNumbersInWhichItsLampsDiffer) {
  addLamps(10, {number("intensity", 5)});
  const LightSets* sets = choice();
  ASSERT_TRUE(sets && sets->sets.size() == 1);
  const LightSet& set = *sets->sets[0].set;
  ASSERT_EQ(set.varying.size(), 1u);
  EXPECT_STREQ(set.lights[0]->bound->shader->params[set.varying[0]].name, "from");
  ASSERT_EQ(set.numbers.size(), 30u);
  for (size_t k = 0; k < 10; ++k) EXPECT_EQ(set.numbers[3 * k], static_cast<float>(k));
  EXPECT_EQ(set.numbers[4], 0);
}

TEST_F(LightChoices, LampsThatDifferInMoreThanNumbersAreInSetsOfTheirOwn) {
  const ParamList kinds[] = {{},
                             {text("lighting", "direct")},
                             {text("lighting", "indirect")},
                             {number("__nondiffuse", 1)},
                             {number("__nonspecular", 1)},
                             {text("__category", "a")}};
  for (const ParamList& params : kinds) addLamps(kFew + 1, params);
  addLamps(kFewOpen + 1, {}, false);
  addLamps(kFew + 1, {}, true, "spotlight");
  const LightSets* sets = choice();
  ASSERT_TRUE(sets);
  ASSERT_EQ(sets->sets.size(), std::size(kinds) + 2);
  EXPECT_TRUE(sets->alone.empty());
  int first = 0;
  for (const LightsOfSet& some : sets->sets) {  // in the order of their first lamps
    EXPECT_EQ(some.set->lights[0]->index, first);
    EXPECT_EQ(some.set->lights.size(), some.count);
    first += static_cast<int>(some.count);
  }
}

void shineNot(const TmGrid*) {}
rsl::PointParam place("place", {0, 0, 0}, "", TM_ROLE_POSITION);
rsl::StringParam slide("slide", "", "");
rsl::FloatArrayParam petals("petals", {1, 2, 3}, "");
rsl::UniformFloatParam steps("steps", 1, "");
const rsl::Shader projectorShader(TM_LIGHT, "projector", "", TM_LIGHT_BOUNDED, shineNot,
                                  {&place, &slide, &petals, &steps});

TEST_F(LightChoices, LampsOfOtherTextsArraysOrUniformNumbersAreInSetsOfTheirOwn) {
  static const TmShader* const shaders[] = {projectorShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  Param array = number("petals", 1);
  array.floats = {1, 2, 4};
  array.arrayLength = 3;
  const ParamList kinds[] = {{}, {text("slide", "leaves")}, {array}, {number("steps", 2)}};
  for (const ParamList& params : kinds) addLamps(kFew + 1, params, true, "projector");
  const LightSets* sets = choice();
  ASSERT_TRUE(sets);
  EXPECT_EQ(sets->sets.size(), std::size(kinds));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(LightChoices, LampsWithoutAPlaceOrWithCountedShadowsRunAtEveryPoint) {
  addLamps(kFew + 1);
  addLamps(kFew + 1, {}, true, "distantlight");
  addLamps(kFew + 1, {}, true, "ambientlight");
  addLamps(kFew + 1, {number("shadowvariance", 0.1f)});
  const LightSets* sets = choice();
  ASSERT_TRUE(sets && sets->sets.size() == 1);
  EXPECT_EQ(sets->sets[0].set->lights[0]->index, 0);
  EXPECT_EQ(sets->alone.size(), 3u * (kFew + 1));
}

TEST_F(LightChoices, LampsAtOnePlaceAreDrawnByTheirBrightnessAndDarkOnesStillAre) {
  const auto lamp = [&](float intensity, const vec3& tint) {
    addLamps(1, {point("from", {0, 0, 1}), number("intensity", intensity), color("lightcolor", tint)});
  };
  lamp(1, vec3(1));
  lamp(2, {3, 0, 0});
  lamp(-4, vec3(1));  // takes light away
  lamp(0, vec3(1));
  for (int k = 0; k < 6; ++k) lamp(1, vec3(1));
  const LightSets* sets = choice();
  ASSERT_TRUE(sets && sets->sets.size() == 1);
  const LightTree& tree = sets->sets[0].set->tree;
  std::vector<LightCluster> cut;
  const LightReceiver at{vec3(0), vec3(0)};
  tree.cut(at, 1, 1, cut);
  const float all = 1 + 2 + 4 + 6;
  for (const auto& [index, brightness] : {std::pair(0u, 1.0f), {1u, 2.0f}, {2u, 4.0f}, {9u, 1.0f}})
    EXPECT_NEAR(tree.expected(at, cut, index), brightness / all, 1e-5f) << index;
  EXPECT_GT(tree.expected(at, cut, 3), 0);
  EXPECT_LT(tree.expected(at, cut, 3), 1e-5f);
}

TEST_F(LightChoices, AnObjectUnderTheFirstHalfOfAnothersLampsSharesItsSet) {
  addLamps(20);
  addObject(0, 10);
  addObject(0, 20);
  const std::vector<LightsOfSet> of = parts();
  EXPECT_EQ(of[0].set, of[1].set);
  EXPECT_EQ(of[0].count, 10u);
  EXPECT_EQ(of[1].count, 20u);
}

TEST_F(LightChoices, AnObjectUnderFewerLampsHasItsOwnSet) {
  addLamps(20);
  addObject(0, 9);
  addObject(0, 20);
  const std::vector<LightsOfSet> of = parts();
  EXPECT_NE(of[0].set, of[1].set);
  EXPECT_EQ(of[0].count, 9u);
}

TEST_F(LightChoices, AnObjectUnderOtherLampsHasItsOwnSet) {
  addLamps(20);
  addObject(1, 20);
  addObject(0, 20);
  const std::vector<LightsOfSet> of = parts();
  EXPECT_NE(of[0].set, of[1].set);
  EXPECT_EQ(of[0].count, 19u);
}

TEST_F(LightChoices, TheSetThatIsSharedIsThatOfTheNextLongerListWithItsOwn) {
  addLamps(50);
  for (const int end : {10, 20, 45, 50}) addObject(0, end);
  const std::vector<LightsOfSet> of = parts();
  EXPECT_EQ(of[0].set, of[1].set);
  EXPECT_NE(of[1].set, of[2].set);
  EXPECT_EQ(of[2].set, of[3].set);
}

TEST_F(LightChoices, AnObjectUnderFewOfTheLampsRunsThemAll) {
  addLamps(2 * kFew);
  addObject(0, kFew);
  addObject(0, 2 * kFew);
  const std::vector<const LightSets*> of = choices();
  EXPECT_FALSE(of[0]);
  EXPECT_TRUE(of[1]);
}

}  // namespace
}  // namespace tomales
