// Counters and stage times of one frame, filled by every unit and printed by reyes/app (--stats, -v). Threads: counters
// are atomic; add in bulk (per bucket, per batch), never per sample.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace tomales {

using Counter = std::atomic<int64_t>;

struct Stats {
  struct {
    Counter primitives{0}, subpatches{0}, gridsDiced{0}, micropolygonsDiced{0}, micropolygonsVisible{0}, culled{0},
        eyeSplitsGivenUp{0}, piecesVisited{0};
  } geometry;
  struct {
    Counter verticesShaded{0};
  } shade;
  struct {
    Counter gather{0}, transmission{0}, specular{0}, photon{0}, reference{0}, hitlistAdjusted{0};
  } rays;
  struct {
    Counter coarsePolygons{0}, bytes{0};
  } raytrace;
  struct {
    Counter lookups{0}, misses{0}, bytes{0}, finePolygons{0};
  } geometryCache;
  struct {
    Counter samples{0}, lookups{0}, interpolated{0};
  } irradianceCache;
  struct {
    Counter emitted{0}, stored{0}, groups{0}, groupsKept{0};
  } photons;
  struct {
    Counter total{0}, lookups{0}, misses{0}, cacheBytes{0}, bytesOnDisk{0};
  } bricks;
  struct {
    Counter lookups{0}, tileRequests{0}, tileMisses{0}, bytesRead{0};
  } textures;
  struct {
    Counter pixels{0}, paths{0};
  } audit;
  struct {
    Counter grids{0}, geometry{0}, deepFrame{0};
  } memoryBytes;

  /// Returns the number of rays traced for light so far, without those of photons.
  double lightRays() const;

  /// Adds to the figures of one named shader ("shade.by_shader").
  void addShader(const std::string& name, int64_t vertices, double time_s);
  /// Adds wall and CPU time to a stage of the frame ("parse", "hide", "gather", "shade", "image", "write").
  void addStage(const std::string& name, double wall_s, double cpu_s);

  /// Mean relative error of a kind of light in the last frame that was audited, its 90 % interval, the noise of the
  /// audit itself, and the 99th percentile.
  struct AuditFigures {
    double mean = 0, low = 0, high = 0, noise = 0, p99 = 0;
  };
  void addAudit(const std::string& light, const AuditFigures&);
  /// Adds the name of a file that has been written.
  void addOutput(const std::string& file);

  struct ShaderFigures {
    int64_t vertices = 0;
    double time_s = 0;
  };
  struct StageFigures {
    double wall_s = 0, cpu_s = 0;
  };
  std::map<std::string, ShaderFigures> byShader() const;
  std::map<std::string, StageFigures> stages() const;
  std::map<std::string, AuditFigures> audits() const;
  std::vector<std::string> outputs() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, ShaderFigures> shaders_;
  std::map<std::string, StageFigures> stages_;
  std::map<std::string, AuditFigures> audits_;
  std::vector<std::string> outputs_;
};

/// Return the CPU seconds that all threads of this process have used, and those of the calling thread.
double processCpuSeconds();
double threadCpuSeconds();

/// Times one stage from construction to destruction, on one thread. `cpuSeconds` measures the process, or the thread
/// where other stages run meanwhile.
class StageTimer {
 public:
  StageTimer(Stats& stats, std::string name, double (*cpuSeconds)() = processCpuSeconds);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;

 private:
  Stats& stats_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
  double (*cpuSeconds_)();
  double cpuStart_;
};

}  // namespace tomales
