// Finds in the code the facts that the host needs before it runs a shader, so that no author has to declare them.
#include <algorithm>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {
namespace {

class Analysis {
 public:
  explicit Analysis(const Code& code) : code_(code) {}

  uint32_t find() {
    uint32_t out = 0;
    forEach(code_.body, [&](const Instruction& i) { out |= ofInstruction(i); });
    if (code_.kind == ShaderKind::Light) return out | ofLight();
    if (code_.kind != ShaderKind::Surface) return out;
    if (keepsOpacity()) out |= TM_KEEPS_OPACITY;
    if (emits()) out |= TM_EMITS;
    if (isEven()) out |= TM_EVEN;
    return out;
  }

 private:
  const Register& at(int32_t r) const { return code_.registers[static_cast<size_t>(r)]; }
  bool is(int32_t r, Global g) const {
    return r >= 0 && at(r).origin == Origin::Global && at(r).index == static_cast<int32_t>(g);
  }
  bool reads(Global g) const {
    bool found = false;
    forEach(code_.body, [&](const Instruction& i) { forEachRead(i, [&](int32_t r) { found |= is(r, g); }); });
    return found;
  }

  uint32_t ofInstruction(const Instruction& i) const {
    switch (i.op) {
      case Op::Trace:
      case Op::TraceDistance:
      case Op::Transmission:
      case Op::Gather:
      case Op::EnvironmentF:  // "raytrace" traces rays
      case Op::EnvironmentT:
        return TM_TRACES;
      case Op::Occlusion:
      case Op::IndirectDiffuse:
        return TM_TRACES | ofHemisphere(i);
      case Op::StepU:
      case Op::StepV:
      case Op::TextureF:
      case Op::TextureT:
        return TM_DERIVATIVES;
      default:
        return 0;
    }
  }

  uint32_t ofHemisphere(const Instruction& i) const {
    const auto names = [&](const char* setting) {
      return std::ranges::any_of(i.settings, [&](const Setting& s) {
        const std::vector<std::string>& name = at(s.name).texts;
        return !name.empty() && name.front() == setting;
      });
    };
    if (names("pointbased")) return 0;
    const bool unasked = i.op == Op::IndirectDiffuse || names("maxvariation");
    return unasked ? TM_INTERPOLATED | TM_INTERPOLATED_UNASKED : TM_INTERPOLATED;
  }

  bool isZero(int32_t r) const {
    return at(r).origin == Origin::Constant && std::ranges::all_of(at(r).floats, [](float x) { return x == 0; });
  }

  uint32_t ofLight() const {
    bool hasDirection = false, solar = false, sky = false;
    forEach(code_.body, [&](const Instruction& i) {
      const bool none = i.op == Op::Copy && isZero(i.in[0]);  // `L = 0`, as some ambient lights say
      forEachWrite(i, [&](int32_t r) { hasDirection |= !none && is(r, Global::L); });
      solar |= i.op == Op::ConeLight;
      sky |= i.op == Op::SkyLight;
    });
    if (sky) return TM_LIGHT_SOLAR | TM_LIGHT_SKY;
    if (!hasDirection) return TM_LIGHT_AMBIENT;
    return solar ? TM_LIGHT_SOLAR : 0;
  }

  /// Tells whether Oi is always Os.
  bool keepsOpacity() const {
    bool keeps = true;
    forEach(code_.body, [&](const Instruction& i) {
      forEachWrite(i, [&](int32_t r) {
        if (is(r, Global::Oi)) keeps &= i.op == Op::Copy && is(i.in[0], Global::Os);
      });
    });
    return keeps;
  }

  /// Finds the largest set of registers for which `holds` is true. At first it has all registers; a register is removed
  /// if an instruction breaks the condition, until nothing changes.
  template <class Holds>
  std::vector<char> greatest(const Holds& holds) const {
    std::vector<char> in(code_.registers.size(), 1);
    for (bool changed = true; changed;) {
      changed = false;
      const auto drop = [&](int32_t r) {
        if (in[static_cast<size_t>(r)]) {
          in[static_cast<size_t>(r)] = 0;
          changed = true;
        }
      };
      for (size_t k = 0; k < in.size(); ++k)
        if (code_.registers[k].origin != Origin::Temporary && code_.registers[k].origin != Origin::Variable &&
            !holds.starts(code_.registers[k], code_))
          drop(static_cast<int32_t>(k));
      visit(code_.body, true, in, holds, drop);
    }
    return in;
  }
  template <class Holds, class Drop>
  void visit(const Block& block, bool control, const std::vector<char>& in, const Holds& holds,
             const Drop& drop) const {
    for (const Instruction& i : block) {
      const auto has = [&](int32_t r) { return r < 0 || in[static_cast<size_t>(r)] != 0; };
      if (i.op == Op::Leave && holds.followsControl && !control) dropGlobals(drop);
      forEachWrite(i, [&](int32_t r) {
        if (!holds.keeps(i, has, *this) || (holds.followsControl && !control)) drop(r);
      });
      const bool inner = control && ((i.op != Op::If && i.op != Op::Loop) || has(i.in[0]));
      for (const Block& b : i.blocks) visit(b, inner, in, holds, drop);
    }
  }

  /// Points that have left do not run the code after a Leave, so results there may miss some points.
  template <class Drop>
  void dropGlobals(const Drop& drop) const {
    for (size_t k = 0; k < code_.registers.size(); ++k)
      if (code_.registers[k].origin == Origin::Global) drop(static_cast<int32_t>(k));
  }

  /// The condition that a value is black where no light is: the surface reflects, but does not emit.
  struct Dark {
    bool startsOver;  ///< True if the first value of Ci, which is Cs, does not matter.
    static constexpr bool followsControl = false;
    bool starts(const Register& r, const Code&) const {
      if (r.origin == Origin::Constant) {
        for (const float x : r.floats)
          if (x != 0) return false;
        return true;
      }
      // Ci begins as Cs, so a shader that leaves it emits light.
      if (r.origin != Origin::Global) return false;
      return r.index == static_cast<int32_t>(Global::Cl) || (startsOver && r.index == static_cast<int32_t>(Global::Ci));
    }
    template <class Has>
    bool keeps(const Instruction& i, const Has& has, const Analysis&) const {
      switch (i.op) {
        case Op::Ambient:
        case Op::Diffuse:
        case Op::Specular:
        case Op::Trace:
        case Op::Gather:
        case Op::IndirectDiffuse:
        case Op::Illuminance:
        case Op::Caustic:
        case Op::PhotonMap:
        case Op::Subsurface:
        case Op::EnvironmentF:
        case Op::EnvironmentT:
          return true;
        case Op::Mul:
        case Op::Dot:
        case Op::Cross:
          return has(i.in[0]) || has(i.in[1]);
        case Op::Div:
        case Op::Component:
        case Op::ColorTransform:
          return has(i.in[i.op == Op::ColorTransform ? 2 : 0]);
        case Op::Add:
        case Op::Sub:
        case Op::Neg:
        case Op::Copy:
        case Op::Abs:
        case Op::Min:
        case Op::Max:
        case Op::MakeTriple:
        case Op::Sqrt:
        case Op::Sin:
        case Op::Tan:
          for (const int32_t r : i.in)
            if (!has(r)) return false;
          return true;
        case Op::Pow:
          return has(i.in[0]);
        case Op::Clamp:
          return has(i.in[0]) && has(i.in[1]);
        case Op::Mix:
        case Op::Select:
          return i.op == Op::Mix ? has(i.in[0]) && has(i.in[1]) : has(i.in[1]) && has(i.in[2]);
        case Op::SetElement:
          return has(i.in[1]);
        case Op::ElementF:
        case Op::ElementT:
          return has(i.in[0]);
        default:
          return false;
      }
    }
  };
  bool emits() const {
    const std::vector<char> dark = greatest(Dark{startsOver(Global::Ci)});
    for (size_t k = 0; k < code_.registers.size(); ++k)
      if (is(static_cast<int32_t>(k), Global::Ci)) return dark[k] == 0;
    return true;  // never assigned: it stays Cs
  }
  /// Tells whether the first instruction that touches a global assigns all of it.
  bool startsOver(Global g) const {
    for (const Instruction& i : code_.body) {
      bool touched = false;
      const auto look = [&](const Instruction& at) {
        forEachRead(at, [&](int32_t r) { touched |= is(r, g); });
        forEachWrite(at, [&](int32_t r) { touched |= is(r, g); });
      };
      look(i);
      const bool reads = touched;
      for (const Block& inner : i.blocks) forEach(inner, look);
      if (!touched) continue;
      bool itself = false;
      forEachRead(i, [&](int32_t r) { itself |= is(r, g); });
      return reads && i.blocks.empty() && !i.masked && !itself;
    }
    return false;
  }

  /// The condition that a value is a normal on the side from which the surface is seen.
  struct Facing {
    static constexpr bool followsControl = false;
    bool starts(const Register&, const Code&) const { return false; }
    template <class Has>
    bool keeps(const Instruction& i, const Has& has, const Analysis&) const {
      return i.op == Op::Faceforward || ((i.op == Op::Copy || i.op == Op::Normalize) && has(i.in[0]));
    }
  };

  /// The condition that a value depends on Cs, Os, parameters and light alone, not on places, directions or pictures.
  struct Even {
    const std::vector<char>& facing;
    static constexpr bool followsControl = true;
    bool starts(const Register& r, const Code&) const {
      if (r.origin != Origin::Global) return true;
      switch (static_cast<Global>(r.index)) {
        case Global::Cs:
        case Global::Os:
        case Global::Ci:
        case Global::Oi:
        case Global::Cl:
        case Global::time:
        case Global::dtime:
        case Global::ncomps:
          return true;
        default:
          return false;
      }
    }
    template <class Has>
    bool keeps(const Instruction& i, const Has& has, const Analysis&) const {
      switch (i.op) {
        case Op::Ambient:
          return true;
        case Op::Diffuse:  // by any normal that faces the eye: the same light is on every side
        case Op::Specular:
          return facing[static_cast<size_t>(i.in[0])] != 0;
        default:
          break;
      }
      if (!info(i.op).pure() && i.op != Op::Copy && i.op != Op::SetElement) return false;
      for (const int32_t r : i.in)
        if (!has(r)) return false;
      return true;
    }
  };
  bool isEven() const {
    const std::vector<char> facing = greatest(Facing{});
    const std::vector<char> even = greatest(Even{facing});
    bool seen = true;
    for (size_t k = 0; k < code_.registers.size(); ++k)
      if (is(static_cast<int32_t>(k), Global::Ci) || is(static_cast<int32_t>(k), Global::Oi)) seen &= even[k] != 0;
    return seen;
  }

  const Code& code_;
};

}  // namespace

void findCapabilities(Code& code) { code.capabilities = Analysis(code).find(); }

}  // namespace tomales::compiler
