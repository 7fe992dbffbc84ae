// Point clouds that shaders leave and look up.
#include "gi/clouds.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "gi/photons/irradiance.h"
#include "gi/point_file.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// A wall at z = 0 with the value x + 2 y, as one call of bake3d() has it.
struct Wall {
  explicit Wall(int n) : count(n * n), active(static_cast<size_t>(count), 1) {
    for (int i = 0; i < count; ++i) {
      const float px = static_cast<float>(i % n) / static_cast<float>(n),
                  py = static_cast<float>(i / n) / static_cast<float>(n);
      x.push_back(px);
      y.push_back(py);
      zero.push_back(0);
      one.push_back(1);
      radius.push_back(0.8f / static_cast<float>(n));
      value.push_back(px + 2 * py);
    }
  }
  CloudQuery query(const std::string& file, int begin, int end) {
    const auto at = [&](std::vector<float>& v) { return v.data() + begin; };
    return {file,      end - begin, active.data() + begin, {at(x), at(y), at(zero)}, {at(zero), at(zero), at(one)},
            at(radius)};
  }
  std::vector<CloudValue> values(int begin) {
    return {{"sum", 1, {value.data() + begin, nullptr, nullptr}},
            {"P", 3, {x.data() + begin, y.data() + begin, zero.data() + begin}}};
  }

  int count;
  std::vector<uint8_t> active;
  std::vector<float> x, y, zero, one, radius, value;
};

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Clouds : public ::testing::Test {
 protected:
  Clouds() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Clouds() override { fs::remove_all(folder); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string bakeWall() {
    CloudFiles files("");
    std::string problem;
    EXPECT_TRUE(files.bake(wall.query(path("wall.ptc"), 0, wall.count), wall.values(0), problem)) << problem;
    files.write(log);
    return path("wall.ptc");
  }

  const fs::path folder = test::temporary("tomales_clouds");
  Wall wall{32};
  Log log{Log::Verbosity::Quiet};
};

TEST_F(Clouds, PointsThatAreNotNumbersAreLeftOutAndCounted) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CloudFiles files("");
  std::string problem;
  wall.value[3] = nan;
  wall.radius[7] = nan;
  wall.radius[8] = -1;
  wall.x[20] = std::numeric_limits<float>::infinity();
  ASSERT_TRUE(files.bake(wall.query(path("wall.ptc"), 0, wall.count), wall.values(0), problem)) << problem;
  files.write(log);
  EXPECT_EQ(PointFile(path("wall.ptc")).count(), static_cast<uint64_t>(wall.count - 4));
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_NE(log.entries()[0].message.find("4 of 1024"), std::string::npos) << log.entries()[0].message;
}

TEST_F(Clouds, WhatIsNoPhotonMapSaysSo) {
  const std::string file = bakeWall();
  CloudFiles files("");
  std::string problem;
  std::vector<float> e(static_cast<size_t>(wall.count));
  EXPECT_FALSE(
      files.photons(wall.query(file, 0, wall.count), tmPhotonDefaults(), {e.data(), e.data(), e.data()}, problem));
  EXPECT_NE(problem.find("power"), std::string::npos) << problem;
}

TEST_F(Clouds, TheFileDependsNeitherOnThreadsNorOnTheOrderOfBatches) {
  const std::string once = contents(bakeWall());
  CloudFiles files("");
  std::vector<std::jthread> threads;
  for (int part = 3; part >= 0; --part)
    threads.emplace_back([&, part] {
      std::string problem;
      for (int begin = part * 256; begin < (part + 1) * 256; begin += 64)
        EXPECT_TRUE(files.bake(wall.query(path("parts.ptc"), begin, begin + 64), wall.values(begin), problem));
    });
  threads.clear();
  files.write(log);
  EXPECT_EQ(contents(path("parts.ptc")), once);
  EXPECT_EQ(PointFile(path("parts.ptc")).count(), 1024u);
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(Clouds, WhatWasBakedIsFoundAgainAlongTheSearchPathByPointCloudAndByBrickMap) {
  const std::string cloud = bakeWall();
  writeBrickMap(PointFile(cloud).readAll(), {0}, path("wall.bkm"));
  CloudFiles files("/nowhere:" + folder.string());
  Wall at(8);
  for (const char* file : {"wall.ptc", "wall.bkm"}) {
    for (float& x : at.x) x += 0.05f;
    const std::vector<float> truth = at.x;
    std::vector<float> sum(static_cast<size_t>(at.count), -1), found(sum), px(sum), py(sum), pz(sum);
    at.active[5] = 0;
    std::string problem;
    EXPECT_TRUE(files.lookUp(at.query(file, 0, at.count),
                             {{"P", 3, {px.data(), py.data(), pz.data()}}, {"sum", 1, {sum.data(), nullptr, nullptr}}},
                             found.data(), problem))
        << problem;
    for (size_t i = 0; i < sum.size(); ++i) {
      if (i == 5) {
        EXPECT_EQ(sum[i], -1) << "nobody asked";
        continue;
      }
      EXPECT_EQ(found[i], 1);
      if (truth[i] > 0.1f && truth[i] < 0.9f && at.y[i] > 0.1f && at.y[i] < 0.9f) {
        EXPECT_NEAR(sum[i], truth[i] + 2 * at.y[i], 0.05f) << file;  // points are 0.03 apart
        EXPECT_NEAR(px[i], truth[i], 0.03f) << file;
      }
    }
    for (float& x : at.x) x -= 0.05f;
  }
}

TEST_F(Clouds, WhatFacesAwayOrLiesElsewhereIsNotFound) {
  CloudFiles files("");
  const std::string cloud = bakeWall();
  Wall at(2);
  for (float& n : at.one) n = -1;
  std::vector<float> sum(4, -1), found(4, -1);
  std::string problem;
  EXPECT_TRUE(files.lookUp(at.query(cloud, 0, 4), {{"sum", 1, {sum.data(), nullptr, nullptr}}}, found.data(), problem));
  EXPECT_EQ(found, std::vector<float>(4, 0.0f));
  EXPECT_EQ(sum, std::vector<float>(4, -1.0f));
}

TEST_F(Clouds, MistakesAreTold) {
  CloudFiles files("");
  std::vector<float> sum(1024, -1), found(1024);
  const std::vector<CloudValue> wanted{{"sum", 1, {sum.data(), nullptr, nullptr}}};
  std::string problem;
  EXPECT_FALSE(files.lookUp(wall.query(path("absent.ptc"), 0, 4), wanted, found.data(), problem));
  EXPECT_NE(problem.find("absent.ptc"), std::string::npos) << problem;
  EXPECT_FALSE(files.lookUp(wall.query(bakeWall(), 0, 4), {{"colour", 3, {sum.data(), sum.data(), sum.data()}}},
                            found.data(), problem));
  EXPECT_NE(problem.find("colour"), std::string::npos) << problem;
  EXPECT_FALSE(files.photons(wall.query(path("wall.ptc"), 0, 4), tmPhotonDefaults(),
                             {sum.data(), sum.data(), sum.data()}, problem));
  EXPECT_NE(problem.find("photon map"), std::string::npos) << problem;
  std::ofstream(path("short.ptc")) << contents(path("wall.ptc")).substr(0, 2000);
  EXPECT_FALSE(files.lookUp(wall.query(path("short.ptc"), 0, 4), wanted, found.data(), problem));
  EXPECT_TRUE(files.bake(wall.query(path("new.ptc"), 0, 4), wall.values(0), problem));
  EXPECT_FALSE(files.bake(wall.query(path("new.ptc"), 0, 4), wanted, problem)) << "other channels";
  EXPECT_TRUE(files.bake(wall.query("/nowhere/at/all.ptc", 0, 4), wall.values(0), problem));
  files.write(log);
  EXPECT_EQ(log.worst(), Severity::Output);
}

// Photons spread evenly over a wall: E is their power over its area.
TEST_F(Clouds, APhotonMapTellsOfItsIrradiance) {
  PointCloud photons;
  photons.channels = {{"power", 3}};
  for (int i = 0; i < wall.count; ++i) {
    const float power[3] = {2, 1, 0.5f};
    photons.add({wall.x[static_cast<size_t>(i)], wall.y[static_cast<size_t>(i)], 0}, {0, 0, 1}, 0, power);
  }
  writePointFile(photons, path("photons.ptc"));
  CloudFiles files("");
  std::vector<float> e[3];
  for (auto& c : e) c.assign(1024, 0);
  std::string problem;
  ASSERT_TRUE(files.photons(wall.query(path("photons.ptc"), 0, 1024), tmPhotonDefaults(),
                            {e[0].data(), e[1].data(), e[2].data()}, problem))
      << problem;
  for (const size_t i : {size_t{16 * 32 + 16}, size_t{12 * 32 + 20}})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(e[c][i], 1024 * (c == 0 ? 2 : c == 1 ? 1 : 0.5) / double{kPi}, 0.1 * 1024 / double{kPi});
  TmPhotonOptions least = tmPhotonDefaults();
  least.estimator = 1;
  ASSERT_TRUE(
      files.photons(wall.query(path("photons.ptc"), 0, 1024), least, {e[0].data(), e[1].data(), e[2].data()}, problem));
  EXPECT_GT(e[0][16 * 32 + 16], 0) << "an estimate of one photon would be of no area";
}

TEST_F(Clouds, PhotonsWhosePowerIsNoColorAreRefused) {
  PointCloud photons;
  photons.channels = {{"power", 3}, {"pathpower", 1}};
  EXPECT_EQ(powerOffset(photons.channels), 0);
  photons.channels = {{"power", 1}};
  EXPECT_EQ(powerOffset(photons.channels), -1);
}

}  // namespace
}  // namespace tomales
