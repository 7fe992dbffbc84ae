// What a chart varies: the settings of each curve, cheapest first, and the reference that they are held against.
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
  std::string needs;                             ///< Of the scene, lest all pictures are black.
  std::vector<std::string> common;               ///< Arguments of every run, the reference's included.
  std::vector<std::string> reference;            ///< Of a batch; batches differ in `seed`.
  std::string seed;                              ///< The option that makes batches independent.
  bool tracedReference = false;                  ///< Its batches take --samples, by what the budget allows.
  bool oneKnob() const { return name != "gi"; }  ///< The last word of a setting is what varies.
  std::vector<ChartCurve> curves;
};

/// Arguments that begin with this are RIB requests that stand before the scene.
constexpr const char* kPrelude = "prelude:";

std::optional<ChartSweep> chartSweep(const std::string& name);
std::string chartSweepNames();  ///< Comma-separated.

}  // namespace tomales
