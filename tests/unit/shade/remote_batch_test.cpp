// Light at places that are not the points of a batch: illuminance(Q), messages to lights.
#include <cstddef>

#include "tests/unit/shade/remote_batch.h"

namespace tomales {
namespace {

using namespace sl;

TEST_F(Elsewhere, LightsRunWhereTheyAreAskedFor) {
  light("pointlight", {point("from", {1, 2, 3}), number("intensity", 8)});
  const ShadedPoints out = asked(8, [](sl::Surface& s) {
    Point Q = s.P + Vector(0, 3 * s.u, -1);
    s.illuminance(Q, [&] { s.Ci = Color(xcomp(s.Cl), length(s.L), ycomp(s.L)); });
  });
  for (int i = 0; i < 8; ++i) {
    const vec3 Q(0, 3 * static_cast<float>(i) / 8, 4), L = vec3(1, 2, 3) - Q;
    expectColor(out.color(i), {8 / dot(L, L), glm::length(L), L.y});
  }
}

TEST_F(Elsewhere, OnlyTheMaskIsLitAndOnlyTheConeIsShadowed) {
  light("counting").castsShadows = true;
  services.visible = [](const vec3& P, const vec3& toward) {
    EXPECT_EQ(P.y, 1) << "shadow rays leave the place that is asked for";
    EXPECT_NEAR(glm::length(P + toward - vec3(0, 0, -1)), 0, 1e-6f);
    return 0.5f;
  };
  const ShadedPoints out = asked(10, [](sl::Surface& s) {
    If(s.u < 0.5, [&] {
      Point Q = s.P + Vector(0, 1, 0);
      s.illuminance(Q, Vector(0, 0, -1), Float(0.5) * (1 - step(0.25, s.u)), [&] { s.Ci = s.Cl; });
    });
  });
  EXPECT_EQ(litPoints, 5);
  EXPECT_EQ(services.shadowRays, 3) << "the cone has closed at the others";
  for (int i = 0; i < 10; ++i) expectColor(out.color(i), vec3(i < 3 ? 0.5f : -1.0f));
}

TEST_F(Elsewhere, LightIsKeptForThePlacesThatWereAskedLast) {
  light("counting");
  asked(4, [](sl::Surface& s) {
    const auto ask = [&](double y) { s.illuminance(s.P + Vector(0, y, 0), [] {}); };
    ask(0);
    ask(0);
    EXPECT_EQ(litPoints, 4) << "that is where the batch is";
    ask(1);
    ask(1);
    ask(2);
    ask(1);
    EXPECT_EQ(litPoints, 12);
    ask(3);
    ask(4);
    ask(5);
    ask(6);
    ask(1);
    EXPECT_EQ(litPoints, 32) << "forgotten, and asked again";
    If(s.u < 0.5, [&] { ask(1); });
    EXPECT_EQ(litPoints, 32) << "a part of them";
    If(s.u < 0.5, [&] { ask(7); });
    ask(7);
    EXPECT_EQ(litPoints, 32 + 2 + 4);
  });
}

TEST_F(Elsewhere, LoopsMayBeNestedAndTellOfTheirOwnLight) {
  light("counting", {number("power", 3)});
  light("counting", {number("power", 5)});
  const ShadedPoints out = asked(2, [](sl::Surface& s) {
    Color sum;
    s.illuminance(s.P + Vector(0, 1, 0), [&] {
      const int outer = s.lightNumber;
      Float before, after;
      lightsource(outer, "doubled", before);
      for (double y : {2.0, 3.0}) s.illuminance(s.P + Vector(0, y, 0), [&] { sum += Color(0, 0, xcomp(s.Cl)); });
      EXPECT_TRUE(lightsource(outer, "doubled", after));
      sum += Color(before, after, 0);
    });
    s.Ci = sum;
    Float none = -1;
    EXPECT_FALSE(lightsource(1 << 24, "doubled", none)) << "of a place that was never asked";
  });
  expectColor(out.color(0), {16, 16, 32});
}

TEST_F(Elsewhere, LightsTakeWhatTheyAreSent) {
  light("counting", {number("power", 3)});
  light("pointlight", {point("from", {0, 0, -1})});
  const ShadedPoints out = asked(4, [](sl::Surface& s) {
    Color answers[4];
    Float heard, deaf = -1;
    const auto sum = [&](Color& to) { return [&to, &s] { to += Color(xcomp(s.Cl), ycomp(s.Cl), zcomp(s.Cl)); }; };
    Float varying = 1 + s.u;
    Color red(1, 0, 0);
    s.illuminance(s.P, lights("send:light:power", varying, "light:doubled", &heard, "light:absent", &deaf),
                  sum(answers[0]));
    s.illuminance(s.P, s.N, 1.5, lights("send:light:tint", red, "send:light:word", "said"), sum(answers[1]));
    s.illuminance(s.P, lights("send:light:power", red, "send:light:whole", varying), sum(answers[2]));
    s.illuminance(s.P, lights("send:light:power", 7), sum(answers[3]));
    s.Ci = Color(xcomp(answers[0]), xcomp(answers[1]) - ycomp(answers[1]), xcomp(answers[2]));
    s.Oi = Color(heard, xcomp(answers[3]), deaf);
  });
  const float other = 1.0f / 36;
  for (int i = 0; i < 4; ++i) {
    const float own = 1 + static_cast<float>(i) / 4;
    expectColor(out.color(i), {own + other, 300, 3 + other});
    expectColor(out.opacity(i), {2 * own, 7 + other, -1});
  }
  ASSERT_EQ(log.entries().size(), 1u) << "once for the shader";
  EXPECT_NE(log.entries()[0].message.find("of another type"), std::string::npos) << log.entries()[0].message;
}

TEST_F(Elsewhere, WhatIsSentIsKeptUntilTheLastLightHasRunAndBelongsToItsPlace) {
  light("counting");
  light("counting");
  const ShadedPoints out = asked(2, [](sl::Surface& s) {
    Float sent = 3;
    Color sum, here, there;
    s.illuminance(s.P, lights("send:light:power", sent), [&] {
      sum += s.Cl;
      sent = 100;
    });
    s.illuminance(s.P + Vector(0, 8, 0), lights("send:light:power", 2), [&] { there += Color(length(s.L)); });
    const float two = 2;
    const TmMessage message{"power", {{&two, nullptr, nullptr}, 0, 1, nullptr}, TM_FLOAT};
    TmIlluminance query = tmIlluminanceDefaults();
    query.sent = &message;
    query.sentCount = 1;
    while (grid()->call->illuminance(grid()->host, grid(), &query)) here += Color(length(Vector(query.L)));
    s.Ci = Color(xcomp(sum), xcomp(here), xcomp(there));
    EXPECT_THROW(lights("send:light:power", &sent), std::invalid_argument);
    EXPECT_THROW(lights("lightcache", "renew"), std::invalid_argument);
    EXPECT_THROW(rays("maxdist", sent), std::invalid_argument)
        << "no list but that of lights takes a number for each point";
  });
  expectColor(out.color(0), {6, 12, 20});
}

// Lights that have an extent draw samples by what a point is and where it asks, whoever else asks.
TEST_F(Elsewhere, WhatAPointGetsDoesNotDependOnTheOthers) {
  light("arealight", {number("samples", 4)}, true);
  services.emitter = [](float a, float b, vec3& P, vec3& N, float& area) {
    P = {-1 + 2 * a, -0.5f + b, 3};
    N = {0, 0, 1};
    area = 2;
  };
  attributes.atmosphere = std::make_shared<const ShaderCall>(call("between", {}));
  onSurface = [](sl::Surface& s) {
    Point Q = s.P;
    If(s.u >= 0.5, [&] { Q += Vector(0, 0.5, 0); });
    s.Ci = Color();
    s.illuminance(Q, [&] { s.Ci += s.Cl; });
  };
  inVolume = [](sl::Volume& v) {
    Point Q = v.P;
    If(v.u >= 0.5, [&] { Q += Vector(0, 0.5, -0.25); });
    v.illuminance(Q, [&] { v.Ci += v.Cl; });
  };
  const ShadePoints all = points(std::vector<vec3>(6, vec3(0, 0, 5)));
  const auto lit = [&](const ShadePoints& p) {
    ShadedPoints out;
    system().shade(p, {}, out);
    system().atmosphere(p, out);
    return out;
  };
  const ShadedPoints together = lit(all);
  for (int i = 0; i < all.count(); ++i) {
    ShadePoints one(all.group(), all.primvarFloats());
    one.assign(all, i, i + 1);
    EXPECT_EQ(lit(one).color(0), together.color(i)) << i;
  }
  EXPECT_NE(together.color(0), together.color(5));
}

/// A light that asks what light arrives where it shines.
struct nosy : sl::Light {
  void main() {
    TmIlluminance query = tmIlluminanceDefaults();
    const Point away = Ps + Vector(0, 1, 0);
    query.P = away;
    float heard = 0;
    while (grid()->call->illuminance(grid()->host, grid(), &query)) ++heard;
    illuminate(Point(0, 0, 0), [&] { Cl = Color(1 + double(heard)); });
  }
};
TEST_F(Elsewhere, ALightThatAsksHearsOfThoseThatHaveRun) {
  static const rsl::Shader nosyShader(TM_LIGHT, "nosy", "", 0, sl::shade<nosy>, {});
  static const TmShader* const shaders[] = {nosyShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  light("counting");
  light("nosy");
  const ShadedPoints out = asked(1, [](sl::Surface& s) {
    Color own, away;
    s.illuminance(s.P, [&] { own += s.Cl; });
    s.illuminance(s.P + Vector(0, 2, 0), [&] { away += s.Cl; });
    s.Ci = Color(xcomp(own), xcomp(away), 0);
  });
  expectColor(out.color(0), {1 + 2, 1 + 2, 0});
}

TEST_F(Elsewhere, RefreshedLightsRunAgain) {
  light("counting");
  asked(4, [](sl::Surface& s) {
    int seen = 0;
    const auto ask = [&](const char* cache) { s.illuminance(s.P, lights("lightcache", cache), [&] { ++seen; }); };
    ask("reuse");
    ask("reuse");
    EXPECT_EQ(litPoints, 4);
    ask("refresh");
    ask("refresh");
    EXPECT_EQ(litPoints, 12);
    EXPECT_EQ(seen, 4) << "each light once";
    EXPECT_THROW(lights("lightcash", "reuse"), std::invalid_argument);
  });
}

TEST_F(Elsewhere, AQueryWithoutRoomForTheAnswerEndsAtOnce) {
  light("counting");
  asked(2, [](sl::Surface&) {
    TmIlluminance query{};
    EXPECT_FALSE(grid()->call->illuminance(grid()->host, grid(), &query));
    query.structBytes = offsetof(TmIlluminance, L);
    EXPECT_FALSE(grid()->call->illuminance(grid()->host, grid(), &query));
  });
  EXPECT_EQ(litPoints, 0);
}

TEST_F(Elsewhere, CategoriesRunTheirOwnLightsAlone) {
  light("counting", {text("__category", "key")});
  light("counting", {text("__category", "fill")});
  asked(4, [](sl::Surface& s) {
    int seen = 0;
    s.illuminance("-key", s.P + Vector(0, 1, 0), [&] { ++seen; });
    EXPECT_EQ(seen, 1);
  });
  EXPECT_EQ(litPoints, 4);
}

}  // namespace
}  // namespace tomales
