#include "reyes/rsl/machine/lists.h"

namespace tomales::compiler {
namespace {

TmType typeOf(Base base) {
  switch (base) {
    case Base::Color:
      return TM_COLOR;
    case Base::Point:
      return TM_POINT;
    case Base::Vector:
      return TM_VECTOR;
    case Base::Normal:
      return TM_NORMAL;
    case Base::Matrix:
      return TM_MATRIX;
    case Base::String:
      return TM_STRING;
    default:
      return TM_FLOAT;
  }
}

/// Returns the type of a value, from its register's shape if its type in the source is unknown.
TmType typeOf(const Register& r, Base base) {
  switch (r.shape) {
    case Shape::Number:
      return TM_FLOAT;
    case Shape::Triple:
      return base >= Base::Color && base <= Base::Normal ? typeOf(base) : TM_COLOR;
    case Shape::Matrix:
      return TM_MATRIX;
    case Shape::Text:
      return TM_STRING;
  }
  return TM_FLOAT;
}

}  // namespace

rsl::Setting settingOf(Call& call, const Setting& entry) {
  Run& run = call.run;
  const Register& reg = run.reg(entry.value);
  const TmType type = typeOf(reg, entry.base);
  rsl::Setting out;
  if (reg.shape == Shape::Text && !entry.fills) {
    out = rsl::Setting(run.text(entry.value).c_str());
  } else if (reg.shape == Shape::Number || reg.shape == Shape::Triple) {
    const bool several = reg.shape == Shape::Triple;
    const Lanes& l = run.lane(entry.value);
    const ptrdiff_t first = l.block != 0 ? run.firstActive() : 0;
    const float* const c[3] = {l.data, l.data + l.component, l.data + 2 * static_cast<ptrdiff_t>(l.component)};
    const rsl::Color one{c[0][first], c[1][first], c[2][first]};
    if (l.block != 0 && !entry.fills)
      out = rsl::Setting({c[0], c[1], c[2]}, type, one);
    else if (several)
      out = rsl::Setting(one, type);
    else
      out = rsl::Setting(one.x);
    if (entry.fills)
      out.fills = several ? call.giveTripleTo(entry.value) : TmVec3{call.giveNumberTo(entry.value), nullptr, nullptr};
  }
  out.type = type;
  if (entry.fills) out.target = entry.value;
  return out;
}

void tell(Call& call, const std::string& name, const rsl::Setting& value, const rsl::Entry& taken) {
  Run& run = call.run;
  const std::string list = "has a parameter list with \"" + name + "\"";
  if (!taken.known)
    run.warn(list + ", which is unknown; it is left out");
  else if (taken.idle)
    run.warn("\"" + name + "\" has no effect: " + taken.idle);
  else if (!value.fits)
    run.warn(list + " that has a value of another type than it wants");
  else if (value.tookFirst)
    run.warn(list + " that may differ from point to point, where one value counts for all");
}

}  // namespace tomales::compiler
