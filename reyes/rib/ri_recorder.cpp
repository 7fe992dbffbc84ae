#include "reyes/rib/ri_recorder.h"

#include <fmt/format.h>

namespace tomales::rib {
namespace {

void fill(Param& p, RtPointer values, size_t n) {
  if (p.type == ValueType::String)
    p.strings = texts(static_cast<const RtString*>(values), n).strings;
  else if (p.type == ValueType::Integer)
    p.ints.assign(static_cast<const RtInt*>(values), static_cast<const RtInt*>(values) + n);
  else
    p.floats.assign(static_cast<const RtFloat*>(values), static_cast<const RtFloat*>(values) + n);
}

}  // namespace

void Recorder::say(const char* name, std::vector<RibArg> args, ParamList params) {
  calls_.push_back({{name, std::move(args), std::move(params), context_.where}, {}});
  const std::string& request = calls_.back().request.name;
  if (request == "AttributeBegin") steps_.push_back(steps_.back());
  if (request == "AttributeEnd" && steps_.size() > 1) steps_.pop_back();
}

void Recorder::procedural(OwnProcedural own, const RtBound bound) {
  say("Procedural", {text("a function of the plugin"), texts(nullptr, 0), numbers(bound, 6)});
  calls_.back().procedural = std::move(own);
}

void Recorder::declare(RtToken name, RtToken declaration) {
  if (!context_.dictionary.declare(name, declaration))
    warn(fmt::format("RiDeclare: \"{}\" is no declaration", declaration));
  say("Declare", {text(name), text(declaration)});
}

ParamList Recorder::params(const char* request, RI_ARRAYS, const ValueCounts& counts, const std::string& category) {
  ParamList out;
  for (RtInt i = 0; i < n; ++i) {
    Param p;
    const auto declaration = context_.dictionary.find(tokens[i], category, p.name);
    if (declaration && values[i]) {
      p.storage = declaration->storage;
      p.type = declaration->type;
      p.arrayLength = declaration->arrayLength;
      fill(p, values[i], counts.of(p.storage) * widthOf(p));
      out.push_back(std::move(p));
    } else {
      warn(fmt::format("Ri{}: parameter \"{}\" is not declared, or has no values", request, tokens[i]));
    }
  }
  return out;
}

void Recorder::warn(const std::string& what) const {
  log_.report(Severity::Warning, "rib-plugin", context_.where, what + "; ignored");
}

size_t Recorder::widthOf(const Param& p) const {
  const int color = context_.dictionary.colorSamples() * p.arrayLength;
  return static_cast<size_t>(p.type == ValueType::Color ? color : p.width());
}

}  // namespace tomales::rib
