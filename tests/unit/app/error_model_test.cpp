#include "reyes/app/frame/error_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tomales {
namespace {

/// A frame that follows the law of the model: noise of rays, interpolation, lamps, and rays that they take.
struct Frame {
  double noise = 0.3, bias = 0.01, biasPower = 3, lamps = 0.08, lampsPower = -0.75;
  QualityTrial trial(const LightQuality& q) const {
    QualityTrial out{q};
    out.indirect = std::sqrt(noise * noise / q.samples + bias * bias * std::pow(q.maxError, biasPower));
    out.direct = lamps * std::pow(q.lightSamples, lampsPower);
    out.gatherCost = 1000.0 * q.samples * std::pow(q.maxError, -0.8);
    out.shadeCost = 20000.0 * q.lightSamples;
    return out;
  }
  double error(const LightQuality& q) const { return std::hypot(trial(q).indirect, trial(q).direct); }
  double rays(const LightQuality& q) const { return trial(q).gatherCost + trial(q).shadeCost; }
  ErrorModel model() const { return {trial({150, 1, 4}), trial({600, 1, 16}), trial({150, 2, 4})}; }
};

TEST(ErrorModel, FindsTheLawOfAFrameFromThreeTrials) {
  const Frame frame;
  const ErrorModel model = frame.model();
  for (const LightQuality& q : {LightQuality{75, 0.5, 2}, LightQuality{1200, 1.5, 64}, LightQuality{300, 3, 8}}) {
    EXPECT_NEAR(model.error(q) / frame.error(q), 1, 1e-6);
    EXPECT_NEAR(model.cost(q) / frame.rays(q), 1, 1e-6);
  }
}

TEST(ErrorModel, ReachesATargetWithFewerRaysThanEveryQualityThatAlsoDoes) {
  const Frame frame;
  const LightQuality chosen = frame.model().cheapest({0.012});
  EXPECT_LE(frame.error(chosen), 0.012);
  for (int samples : {100, 200, 400, 800, 1600, 3200})
    for (float maxError : {0.25f, 0.5f, 1.0f, 2.0f})
      for (int lightSamples : {1, 4, 16, 64, 256}) {
        const LightQuality other{samples, maxError, lightSamples};
        if (frame.error(other) <= 0.012) {
          EXPECT_LE(frame.rays(chosen), 1.1 * frame.rays(other)) << optionsOf(other);
        }
      }
}

TEST(ErrorModel, KeepsRecordsThatThereAreWhereOnlyLampsErrTooMuch) {
  const ErrorModel model = Frame().model();
  const LightQuality gathered{1700, 0.71f, 4}, chosen = model.cheapest({0.015}, gathered);
  EXPECT_LE(model.error(chosen), 0.015);
  EXPECT_TRUE(chosen.hasRecordsOf(gathered)) << optionsOf(chosen);
  EXPECT_FALSE(model.cheapest({0.015}).hasRecordsOf(gathered)) << "otherwise others are cheaper";
  EXPECT_FALSE(model.cheapest({0.004}, gathered).hasRecordsOf(gathered)) << "they do not reach this target";
}

TEST(ErrorModel, ChoosesNoRecordsThatAreWiderThanThoseOfTheTrials) {
  Frame frame;
  frame.bias = 1e-6;
  EXPECT_EQ(frame.model().cheapest({0.05}).maxError, 2);
}

TEST(ErrorModel, LeavesSmudgesOutThatNothingReachesIfNobodyHasAskedForThem) {
  Frame frame;
  const auto smudged = [&](const LightQuality& q) {
    QualityTrial t = frame.trial(q);
    t.smudges = 0.5 + t.indirect;
    return t;
  };
  const ErrorModel model(smudged({150, 1, 4}), smudged({600, 1, 16}), smudged({150, 2, 4}));
  const ErrorTarget target{0.02, 0.02};
  const LightQuality best = model.cheapest(target), chosen = model.cheapestOfError(target);
  EXPECT_GT(model.smudges(best), 0.02);
  EXPECT_LE(model.error(best), 0.02) << "lamps count where smudges miss: " << optionsOf(best);
  EXPECT_EQ(chosen, model.cheapest({0.02, 0}));
  EXPECT_EQ(Frame().model().cheapestOfError(target), Frame().model().cheapest(target)) << "without smudges";
}

TEST(ErrorModel, BelievesAnAuditAsFarAsItIsCertain) {
  EXPECT_NEAR(likelyError(0.01, 0.04, 0.04, 0.04), 0.04, 1e-9);
  EXPECT_NEAR(likelyError(0.01, 0.04, 0.0001, 4), 0.01, 0.002);
  const double width = std::exp(1.645 * 0.25);  // as certain as the model
  EXPECT_NEAR(likelyError(0.01, 0.04, 0.04 / width, 0.04 * width), 0.02, 1e-6);
  EXPECT_EQ(likelyError(0, 0.04, 0.01, 0.05), 0.04);
  EXPECT_EQ(likelyError(0.01, 0, 0, 0.05), 0);
}

TEST(ErrorModel, AsksForMoreRaysOfATargetThatIsSmaller) {
  const ErrorModel model = Frame().model();
  double before = 0;
  for (double target : {0.08, 0.04, 0.02, 0.01}) {
    const double rays = model.cost(model.cheapest({target}));
    EXPECT_GT(rays, before);
    before = rays;
  }
}

TEST(ErrorModel, GivesTheLeastErrorOfItsRangeWhereATargetCannotBeReached) {
  const ErrorModel model = Frame().model();
  const LightQuality chosen = model.cheapest({1e-6});
  EXPECT_GT(model.error(chosen), 1e-6);
  EXPECT_LE(model.error(chosen), model.error({9600, 0.07f, 512}));
}

TEST(ErrorModel, GivesTheLeastErrorThatSoManyRaysBring) {
  const ErrorModel model = Frame().model();
  const LightQuality chosen = model.best(1e6);
  EXPECT_LE(model.cost(chosen), 1e6);
  EXPECT_LE(model.error(chosen), model.error(model.cheapest({1.1 * model.error(chosen)})));
}

TEST(ErrorModel, GivesTheMostLightSamplesForATimeAndLeavesRaysAlone) {
  const ErrorModel model = Frame().model();
  const LightQuality chosen = model.bestLightSamples({300, 0.7f, 4}, 400000);
  EXPECT_EQ(chosen.samples, 300);
  EXPECT_EQ(chosen.maxError, 0.7f);
  EXPECT_EQ(chosen.lightSamples, 20);
  EXPECT_EQ(model.bestLightSamples({300, 0.7f, 4}, 0).lightSamples, 1);
}

TEST(ErrorModel, FillsATimeWithRays) {
  const ErrorModel model = Frame().model();
  for (double most : {3e5, 5e5, 1.1e6, 2.3e6, 7e6}) {
    const LightQuality chosen = model.best(most);
    EXPECT_LE(model.cost(chosen), most);
    EXPECT_GT(model.cost(chosen), 0.93 * most) << optionsOf(chosen);
  }
}

TEST(ErrorModel, GoesAsFarWhateverRaysTheTrialsHad) {
  const Frame frame;
  const ErrorModel brief(frame.trial({37, 1, 1}), frame.trial({150, 1, 4}), frame.trial({37, 2, 1}));
  for (const ErrorModel& model : {brief, frame.model()}) {
    EXPECT_GT(model.best(1e12).samples, 9000);
    EXPECT_LE(model.best(1e12).samples, 9600);
    EXPECT_EQ(model.bestLightSamples({300, 1, 4}, 1e12).lightSamples, 1024);
  }
}

TEST(ErrorModel, KnowsThatRecordsOfFurtherBouncesAreNotMoreWhereOthersAre) {
  const Frame frame;
  const auto trial = [&](const LightQuality& q) {
    QualityTrial out = frame.trial(q);
    out.bounceCost = 4000.0 * std::sqrt(q.samples);
    return out;
  };
  ErrorModel model(trial({150, 1, 4}), trial({600, 1, 16}), trial({150, 2, 4}));
  for (const LightQuality& q : {LightQuality{75, 0.5, 2}, LightQuality{1200, 1.5, 64}})
    EXPECT_NEAR(model.gatherCost(q) / (trial(q).gatherCost + trial(q).bounceCost), 1, 1e-6);
}

TEST(ErrorModel, KnowsThatAPointCostsSomethingWithoutItsLamps) {
  const auto trial = [](const LightQuality& q) {
    QualityTrial out = Frame().trial(q);
    out.shadeCost = 50 + 2 * q.lightSamples;
    return out;
  };
  ErrorModel model(trial({150, 1, 4}), trial({600, 1, 16}), {});
  EXPECT_NEAR(model.shadeCost({600, 1, 1}), 52, 1e-6);
  EXPECT_NEAR(model.shadeCost({600, 1, 256}), 562, 1e-6);
  model.correctShadeCost({600, 1, 128}, 58 + 6 * 124);
  EXPECT_NEAR(model.shadeCost({600, 1, 1024}), 58 + 6 * 1020, 1e-6) << "what is seen far away decides the slope";
}

TEST(ErrorModel, DoesNotBelieveThatLightSamplesCostNothing) {
  const auto model = [](double cheap, double dear) {
    const auto trial = [&](const LightQuality& q) {
      QualityTrial out = Frame().trial(q);
      out.shadeCost = q.lightSamples > 4 ? dear : cheap;
      return out;
    };
    return ErrorModel(trial({150, 1, 4}), trial({600, 1, 16}), {});
  };
  EXPECT_GT(model(10, 9).shadeCost({150, 1, 1024}), 100) << "the first trial has paid for what is read once";
  ErrorModel seen = model(10, 20);
  seen.correctShadeCost({150, 1, 16}, 5);
  EXPECT_NEAR(seen.shadeCost({150, 1, 16}), 5, 1e-6);
  EXPECT_GT(seen.shadeCost({150, 1, 256}), 30) << "what costs less than expected makes the line no flatter";
}

TEST(ErrorModel, LearnsWhatRaysCostFromTrialsInTheSameBuckets) {
  const Frame frame;
  ErrorModel model = frame.model();
  QualityTrial few{{100, 1, 4}}, many{{1600, 1, 4}};
  few.gatherCost = 3;
  many.gatherCost = 3 * 8;
  model.learnRays(few, many);
  EXPECT_NEAR(model.gatherCost({1600, 1, 4}) / model.gatherCost({100, 1, 4}), 8, 1e-6);
  model.correctGatherCost({100, 1, 4}, 50);
  EXPECT_NEAR(model.gatherCost({1600, 1, 4}), 400, 1e-6);
}

TEST(ErrorModel, KeepsTheWidthOfRecordsWhereThatIsAsked) {
  const ErrorModel model = Frame().model();
  const LightQuality wide{150, 2, 4}, chosen = model.bestAsWide(wide, 1e6);
  EXPECT_EQ(chosen.maxError, 2);
  EXPECT_LE(model.cost(chosen), 1e6);
  EXPECT_GE(model.error(chosen), model.error(model.best(1e6)));
}

TEST(ErrorModel, IsCorrectedByWhatTheFrameHasTaken) {
  ErrorModel model = Frame().model();
  const LightQuality q{150, 1, 4}, other{600, 0.5f, 16};
  const double gather = model.gatherCost(other), shade = model.shadeCost(other);
  model.correctGatherCost(q, 0.7 * model.gatherCost(q));
  model.correctShadeCost(q, 2 * model.shadeCost(q));
  EXPECT_NEAR(model.gatherCost(other), 0.7 * gather, 1e-6 * gather);
  EXPECT_NEAR(model.shadeCost(other), 2 * shade, 1e-6 * shade);
  model.correctShadeCost(q, 0);
  EXPECT_NEAR(model.shadeCost(other), 2 * shade, 1e-6 * shade) << "what took no time tells nothing";
}

TEST(ErrorModel, PathsAreTracedWhileThePictureIsShaded) {
  const auto paths = [](const LightQuality& q) {
    return QualityTrial{q, 0.3 / std::sqrt(q.samples), 0.01, 0, 0, 0, 10.0 + q.samples};
  };
  const ErrorModel model(paths({16, -1, 0}), paths({64, -1, 0}), {});
  EXPECT_NEAR(model.cost({256, -1, 0}), 266, 1e-6);
  EXPECT_LE(model.cost(model.best(151)), 151);
  EXPECT_GT(model.cost(model.best(151)), 149);
}

TEST(ErrorModel, IsCorrectedByAPictureThatErrsMoreThanItSaid) {
  ErrorModel model = Frame().model();
  const LightQuality first = model.cheapest({0.02});
  model.correct({first, 3 * model.indirectError(first), model.directError(first)});
  EXPECT_GT(model.error(first), 0.02);
  const LightQuality second = model.cheapest({0.02});
  EXPECT_GT(second.samples, first.samples);
  EXPECT_LE(model.error(second), 0.02);
}

TEST(ErrorModel, AsksForMoreWhereSmoothRegionsWouldShowSmudges) {
  const Frame frame;
  const auto uneven = [&](const LightQuality& q) {
    QualityTrial out = frame.trial(q);
    out.smudges = 0.5 * out.indirect;
    return out;
  };
  const ErrorModel model(uneven({150, 1, 4}), uneven({600, 1, 16}), uneven({150, 2, 4}));
  const LightQuality any = model.cheapest({0.02}), even = model.cheapest({0.02, 0.004});
  EXPECT_EQ(any, frame.model().cheapest({0.02})) << "smudges that nobody asked of cost nothing";
  EXPECT_LE(model.smudges(even), 0.004);
  EXPECT_GT(model.smudges(any), 0.004);
  EXPECT_GT(model.cost(even), model.cost(any));
  EXPECT_NEAR(model.smudges({75, 0.5, 2}), uneven({75, 0.5, 2}).smudges, 1e-9);
}

TEST(ErrorModel, LearnsFromNarrowRecordsHowManyThereAre) {
  // Half as wide as the base they are 4 times as many, and twice as wide nearly as many: the rest is as wide as may be.
  Frame frame;
  ErrorModel model = frame.model();
  const LightQuality narrow{150, 0.25f, 4}, between{150, 0.5f, 4};
  EXPECT_LT(model.gatherCost(narrow), 150e3 * 16 / 4);
  QualityTrial trial = frame.trial(narrow);
  trial.gatherCost = 150e3 * 16;
  model.addNarrower(trial);
  EXPECT_NEAR(model.gatherCost(narrow), 150e3 * 16, 1);
  EXPECT_NEAR(model.gatherCost(between), 150e3 * 4, 1);
  EXPECT_NEAR(model.gatherCost({150, 2, 4}), frame.trial({150, 2, 4}).gatherCost, 1) << "wide ones stay";
  EXPECT_NEAR(model.error(between) / frame.error(between), 1, 0.03)
      << "a trial always leaves a little for interpolation";
}

TEST(ErrorModel, LeavesRaysAndRecordsAloneWhereOnlyLampsErr) {
  Frame frame;
  const auto lampsOnly = [&](int lightSamples) {
    QualityTrial out = frame.trial({150, 1, lightSamples});
    out.quality.samples = 0;
    out.quality.maxError = -1;
    out.indirect = out.gatherCost = 0;
    return out;
  };
  const ErrorModel model(lampsOnly(4), lampsOnly(16), {});
  const LightQuality chosen = model.cheapest({0.01});
  EXPECT_EQ(optionsOf(chosen), "--light-samples 16");
}

TEST(ErrorModel, SurvivesTrialsThatSawNothing) {
  const ErrorModel model({{150, 1, 4}}, {{600, 1, 16}}, QualityTrial{{150, 2, 4}});
  EXPECT_EQ(model.error(model.cheapest({0.01})), 0);
  EXPECT_EQ(model.cheapest({0.01}), LightQuality());
}

TEST(ErrorModel, SurvivesAFinerTrialThatErrsMore) {
  const Frame frame;
  QualityTrial unlucky = frame.trial({600, 1, 16});
  unlucky.indirect = 2 * frame.trial({150, 1, 4}).indirect;
  unlucky.direct = 1;
  const ErrorModel model(frame.trial({150, 1, 4}), unlucky, frame.trial({150, 2, 4}));
  const LightQuality chosen = model.cheapest({0.01});
  EXPECT_GT(chosen.samples, 0);
  EXPECT_TRUE(std::isfinite(model.error(chosen)));
}

}  // namespace
}  // namespace tomales
