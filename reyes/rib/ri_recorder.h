// Private to ri_calls.cpp: records calls of the C binding as Requests.
#pragma once
#include <array>

#include "reyes/rib/arguments.h"
#include "reyes/rib/ri_calls.h"
#include "reyes/rib/ri_counts.h"

namespace tomales::rib {

class Recorder {
 public:
  Recorder(RiContext context, Log& log, std::vector<RiCall>& calls)
      : context_(std::move(context)), log_(log), calls_(calls), steps_{{context_.uStep, context_.vStep}} {}

  void say(const char* name, std::vector<RibArg> args = {}, ParamList params = {});
  void procedural(OwnProcedural own, const RtBound bound);
  void declare(RtToken name, RtToken declaration);

  /// `category` is that of RiAttribute, which has names of its own.
  ParamList params(const char* request, RI_ARRAYS, const ValueCounts& counts, const std::string& category);
  RibArg color(const RtFloat* c) const { return numbers(c, static_cast<size_t>(context_.dictionary.colorSamples())); }
  std::array<int, 2>& steps() { return steps_.back(); }

 private:
  void warn(const std::string& what) const;
  size_t widthOf(const Param& p) const;

  RiContext context_;
  Log& log_;
  std::vector<RiCall>& calls_;
  std::vector<std::array<int, 2>> steps_;  ///< Steps of the bases along u and v, as RiAttributeBegin saves them.
};

}  // namespace tomales::rib
