// Private to ri_calls.cpp: records calls of the C binding as Requests.
#pragma once
#include <array>

#include "reyes/rib/arguments.h"
#include "reyes/rib/ri_calls.h"

namespace tomales::rib {

/// The number of values of each storage class that a primitive takes (RISpec 3.2 section 5).
struct ValueCounts {
  size_t uniform = 1, varying = 1, vertex = 1, faceVarying = 1;
  size_t of(Storage s) const {
    switch (s) {
      case Storage::Constant:
        return 1;
      case Storage::Uniform:
        return uniform;
      case Storage::Varying:
        return varying;
      case Storage::Vertex:
        return vertex;
      case Storage::FaceVarying:
        return faceVarying;
    }
    return 1;
  }
};
inline constexpr ValueCounts kQuadric{1, 4, 4, 4};

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
