// Runs this program as child processes, so that CPU time and memory are those of one rendering, and keeps the
// measurements.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tomales {

/// The cost of one rendering, and its picture.
struct Run {
  std::vector<std::string> arguments;  ///< They follow those of the laboratory.
  std::string picture;                 ///< Path of a linear EXR in the laboratory's folder.
  double cpu_s = 0, wall_s = 0;        ///< CPU time is user and system time; both are those of the whole process.
  double peakBytes = 0;                ///< Resident memory, as the renderer itself reports at its end.
  int64_t records = 0;                 ///< Records of the irradiance cache.
  std::vector<std::string> warnings;   ///< Codes of the warnings that it gave.
  bool recalled = false;               ///< True if an earlier process measured it.
};

struct LabSettings {
  std::string folder;                  ///< Folder of pictures and figures; made if missing.
  std::vector<std::string> scene;      ///< RIB files of every run.
  std::vector<std::string> arguments;  ///< Arguments of every run.
  double budget_s = 600;
};

/// A measurement is named by the contents of the program, of the scene and of the files that the scene names, and by
/// the arguments. So an interrupted chart finds what it has done, and a changed scene finds nothing. Threads: one.
class Lab {
 public:
  explicit Lab(LabSettings settings);
  /// Returns the run from memory or from a child, or nothing if the child fails, is interrupted or would outlive the
  /// budget; why() then says so.
  std::optional<Run> run(const std::vector<std::string>& arguments);
  const std::string& why() const { return why_; }
  double secondsLeft() const;
  double secondsUsed() const;

 private:
  std::optional<Run> recall(const std::string& stem, const std::vector<std::string>& arguments) const;
  bool remember(const std::string& stem, const Run& run) const;

  const LabSettings settings_;
  const uint64_t contents_;
  const std::chrono::steady_clock::time_point start_;
  std::string why_;
};

/// Says why a page cannot be written there or measurements kept in that folder, which is made if it is missing; empty
/// if they can.
std::string placesProblem(const std::string& page, const std::string& folder);

/// Returns the sum over the contents of these files and of all files that they name in strings, archives included.
uint64_t contentsOf(const std::vector<std::string>& files);

}  // namespace tomales
