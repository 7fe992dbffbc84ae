// The settings of each curve of a chart, cheapest first, and the reference that they are compared with.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace tomales {

struct ChartCurve {
  std::string name;
  std::vector<std::vector<std::string>> settings;  ///< Arguments of `tomales render`, or a kPrelude.
};

struct ChartSweep {
  std::string name, title;
  /// Names what the scene must have, because all pictures would be black without it.
  std::string needs;
  std::vector<std::string> common;               ///< Arguments of every run, those of the reference too.
  std::vector<std::string> reference;            ///< Arguments of a batch; batches differ in `seed`.
  std::string seed;                              ///< The option that makes batches independent.
  bool tracedReference = false;                  ///< Its batches take --samples, as many as the budget allows.
  bool oneKnob() const { return name != "gi"; }  ///< The last word of a setting varies.
  std::vector<ChartCurve> curves;
};

/// Arguments that begin with this are RIB requests that stand before the scene.
constexpr const char* kPrelude = "prelude:";

std::optional<ChartSweep> chartSweep(const std::string& name);
std::string chartSweepNames();  ///< Separated by commas.

}  // namespace tomales
