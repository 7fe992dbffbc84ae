// Shared by the tests of the RIB reader.
#pragma once
#include <gtest/gtest.h>

#include "reyes/rib.h"
#include "reyes/rib/parser.h"

namespace tomales {

/// Opens all procedurals of the scene.
inline Scene opened(Scene&& scene) {
  scene.expandAll([](const Attributes&) { return true; });
  return std::move(scene);
}

/// All scenes of a text, and what the log says about it.
struct Reading {
  std::vector<Scene> scenes;
  bool good = false;
  Log log{Log::Verbosity::Quiet};

  explicit Reading(const std::string& text, std::vector<std::string> archivePath = {"."}) {
    RibSettings settings;
    settings.archivePath = std::move(archivePath);
    settings.onScene = [this](Scene&& s) { scenes.push_back(opened(std::move(s))); };
    good = readRibText(text, "test.rib", settings, log);
  }
  const Scene& scene() const { return scenes.at(0); }
  const Object& object(size_t i) const { return scene().objects.at(i); }
  const Attributes& attributes(size_t i) const { return *object(i).attributes; }
  /// The first message with that code; an empty one if there is none.
  LogEntry message(const std::string& code) const {
    for (const LogEntry& e : log.entries())
      if (e.code == code) return e;
    return {};
  }
  /// Messages with that code, however often each was reported.
  int told(const std::string& code) const {
    int out = 0;
    for (const LogEntry& e : log.entries()) out += e.code == code;
    return out;
  }
  std::string codes() const {
    std::string out;
    for (const LogEntry& e : log.entries()) out += e.code + "@" + std::to_string(e.where.line) + " ";
    return out;
  }
};

inline const std::string kSphere = "Sphere 1 -1 1 360\n";

inline void expectNear(const vec3& a, const vec3& b, float tolerance = 1e-5f) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

inline std::string inWorld(const std::string& text) { return " WorldBegin\n" + text + "\nWorldEnd\n"; }

/// The requests of a text.
struct Requests {
  Log log{Log::Verbosity::Quiet};
  std::vector<Request> list;

  explicit Requests(const std::string& text) {
    rib::Dictionary dictionary;
    const auto stream = rib::ByteStream::fromMemory(text);
    rib::Parser parser(*stream, "test.rib", dictionary, log);
    while (auto r = parser.next()) list.push_back(*r);
  }
};

}  // namespace tomales
