#include <fmt/format.h>

#include "reyes/rsl/code.h"

namespace tomales::compiler {
namespace {

std::string escapedText(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '\n' ? std::string("\\n") : c == '"' ? std::string("\\\"") : std::string(1, c);
  return out + "\"";
}

class Printer {
 public:
  explicit Printer(const Code& code) : code_(code) {}
  std::string print() {
    out_ = fmt::format("{} {}\n", name(code_.kind), code_.name);
    for (const Parameter& p : code_.parameters)
      out_ += fmt::format("  parameter {}{} {}\n", p.output ? "output " : "", name(p.type), p.name);
    print(code_.body, 1);
    return std::move(out_);
  }

 private:
  std::string text(int32_t reg) const {
    if (reg < 0) return "-";
    const Register& r = code_.registers[static_cast<size_t>(reg)];
    if (r.origin == Origin::Constant) {
      if (r.shape == Shape::Text) return escapedText(r.texts[0]);
      std::string out;
      for (const float x : r.floats) out += fmt::format("{}{:g}", out.empty() ? "" : " ", x);
      return r.floats.size() == 1 ? out : "(" + out + ")";
    }
    const char* kind = r.shape == Shape::Number   ? "f"
                       : r.shape == Shape::Triple ? "t"
                       : r.shape == Shape::Matrix ? "m"
                                                  : "s";
    return fmt::format("{}{}{}{}{}", r.varying ? "" : "u", kind, reg, r.name.empty() ? "" : ".", r.name);
  }
  void print(const Block& block, int depth) {
    static constexpr const char* kParts[] = {"", "else", "step"};
    const std::string indent(2 * static_cast<size_t>(depth), ' ');
    for (const Instruction& i : block) {
      out_ += indent;
      for (const int32_t r : i.out) out_ += text(r) + " ";
      if (!i.out.empty()) out_ += "= ";
      out_ += std::string(info(i.op).name);
      for (const int32_t r : i.in) out_ += " " + text(r);
      for (const Setting& s : i.settings)
        out_ += fmt::format(" [{} {} {}]", text(s.name), s.fills ? "->" : "=", text(s.value));
      if (i.op == Op::Leave || i.op == Op::Scope || i.op == Op::Loop) out_ += fmt::format(" @{}", i.extra);
      if (!i.masked) out_ += " all";
      out_ += "\n";
      for (size_t k = 0; k < i.blocks.size(); ++k) {
        if (i.blocks[k].empty()) continue;
        if (k > 0) out_ += indent + kParts[std::min<size_t>(k, 2)] + "\n";
        print(i.blocks[k], depth + 1);
      }
    }
  }
  const Code& code_;
  std::string out_;
};

}  // namespace

std::string dump(const Code& code) { return Printer(code).print(); }

}  // namespace tomales::compiler
