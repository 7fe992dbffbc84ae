// Shaders' texts made of choices: expressions with side effects, branches, loops, what leaves them, functions, arrays
// and light loops. All numbers stay small, and all operations are exact, so that two ways to run a text agree to the
// bit.
#pragma once
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

namespace tomales::compiler {

/// A number below the given one.
using Choose = std::function<uint32_t(uint32_t)>;

class WrittenProgram {
 public:
  explicit WrittenProgram(const Choose& choose) : choose_(choose) {
    for (uint32_t k = pick(3); k > 0; --k) function();
    reads_ = {"s", "t", "u", "p"};
    writes_ = {"r0", "r1", "r2", "v0", "v1", "v2"};
    colors_ = {"q0", "c0", "c1"};
    array_ = true;
    lights_ = true;
    text_ +=
        "surface test(float p = 2; output varying float r0 = 0, r1 = 1, r2 = 2; output varying color q0 = 0) {\n"
        "float v0; uniform float v1 = 1; float v2 = s; color c0, c1 = Cs; float n[3] = {1, 2, 3}; float o0 = 4;\n";
    block(0);
    text_ += "r0 += v0 + o0; r1 += v1; r2 += v2 + n[0] + 10 * n[1] + 100 * n[2]; q0 += c0 + c1; }\n";
  }
  const std::string& text() const { return text_; }

 private:
  uint32_t pick(uint32_t below) { return choose_(below); }
  const std::string& oneOf(const std::vector<std::string>& names) {
    return names[pick(static_cast<uint32_t>(names.size()))];
  }

  void function() {
    reads_ = {"s", "a", "b"};
    writes_ = {"o", "l"};
    colors_ = {"m"};
    array_ = lights_ = false;
    inFunction_ = true;
    const std::string name = fmt::format("f{}", functions_.size());
    text_ += fmt::format("float {}(float a, b; output float o) {{\nfloat l = b; color m = a;\n", name);
    block(2);
    text_ += fmt::format("return l + {}; }}\n", number(1));
    functions_.push_back(name);
    inFunction_ = false;
  }

  static std::string held(const std::string& x) { return fmt::format("clamp({}, -8, 8)", x); }
  std::string number(int depth) {
    if (depth <= 0 || pick(4) == 0) return simple();
    switch (pick(11)) {
      case 0:
        return fmt::format("-{}", simple());
      case 1:
        return fmt::format("({} ? {} : {})", condition(depth - 1), number(depth - 1), number(depth - 1));
      case 2:
        return fmt::format("{}({}, {})", pick(2) ? "min" : "max", number(depth - 1), number(depth - 1));
      case 3:
        return fmt::format("{}({})", pick(2) ? "floor" : "abs", number(depth - 1));
      case 4:
        return fmt::format("comp({}, {})", triple(depth - 1), pick(3));
      case 5:
        return array_ ? element(depth) : simple();
      case 6:
        return fmt::format("({} = {})", oneOf(writes_), held(number(depth - 1)));
      case 7:
        // Its output is a variable that is no argument: what one is for the other while it runs is another rule's test.
        if (functions_.empty() || inFunction_) return simple();
        return fmt::format("{}({}, {}, o0)", oneOf(functions_), number(depth - 1), number(depth - 1));
      default:
        static constexpr const char* kOperators[] = {"+", "-", "*"};
        return fmt::format("({} {} {})", number(depth - 1), kOperators[pick(3)], number(depth - 1));
    }
  }
  std::string element(int depth) { return fmt::format("n[clamp(floor({}), 0, 2)]", number(depth - 1)); }
  std::string simple() {
    if (pick(3) == 0) return std::to_string(pick(6));
    return pick(2) ? oneOf(reads_) : oneOf(writes_);
  }
  std::string triple(int depth) {
    if (depth <= 0 || pick(4) == 0) return pick(4) ? oneOf(colors_) : inLight_ ? "Cl" : "Cs";
    switch (pick(5)) {
      case 0:
        return fmt::format("color ({}, {}, {})", number(depth - 1), number(depth - 1), number(depth - 1));
      case 1:
        return fmt::format("({} * {})", number(depth - 1), triple(depth - 1));
      case 2:
        return fmt::format("({} ? {} : {})", condition(depth - 1), triple(depth - 1), triple(depth - 1));
      default:
        return fmt::format("({} {} {})", triple(depth - 1), pick(2) ? "+" : "*", triple(depth - 1));
    }
  }
  std::string condition(int depth) {
    static constexpr const char* kComparisons[] = {"<", "<=", ">", ">=", "==", "!="};
    switch (depth <= 0 ? 9 : pick(6)) {
      case 0:
        return fmt::format("({} && {})", condition(depth - 1), condition(depth - 1));
      case 1:
        return fmt::format("({} || {})", condition(depth - 1), condition(depth - 1));
      case 2:
        return fmt::format("!({})", condition(depth - 1));
      case 3:
        return fmt::format("{} {} {}", triple(depth - 1), pick(2) ? "==" : "!=", triple(depth - 1));
      default:
        return fmt::format("{} {} {}", number(depth - 1), kComparisons[pick(6)], number(depth - 1));
    }
  }

  void assignment() {
    switch (pick(6)) {
      case 0:
        text_ += fmt::format("{} = clamp({}, color (-8, -8, -8), color (8, 8, 8));\n", oneOf(colors_), triple(2));
        break;
      case 1:
        if (array_) text_ += fmt::format("{} = {};\n", element(2), held(number(2)));
        break;
      case 2:
        text_ += fmt::format("setcomp({}, {}, {});\n", oneOf(colors_), pick(3), held(number(2)));
        break;
      case 3:
        text_ += fmt::format("{} {}= {};\n", oneOf(writes_), pick(2) ? "+" : "-", held(number(1)));
        break;
      default:
        text_ += fmt::format("{} = {};\n", oneOf(writes_), held(number(3)));
    }
  }
  void nested(int depth) {
    text_ += "{\n";
    block(depth + 1);
    text_ += "}\n";
  }
  void branch(int depth) {
    text_ += fmt::format("if ({})\n", condition(2));
    nested(depth);
    if (pick(2) == 0) return;
    text_ += "else\n";
    nested(depth);
  }
  void loop(int depth) {
    const std::string counter = fmt::format("k{}", counters_++), until = std::to_string(1 + pick(4));
    const std::string further = pick(2) ? " && " + condition(1) : "";
    reads_.push_back(counter);
    ++loops_;
    if (pick(2))
      text_ += fmt::format("{{ float {0}; for ({0} = 0; {0} < {1}{2}; {0} += 1)\n", counter, until, further);
    else
      text_ += fmt::format("{{ float {0} = 0; while (({0} += 1) <= {1}{2})\n", counter, until, further);
    nested(depth);
    text_ += "}\n";
    reads_.pop_back();
    --loops_;
  }
  void lightLoop(int depth) {
    text_ += "illuminance (P)\n";
    inLight_ = true;
    ++loops_;
    nested(depth);
    inLight_ = false;
    --loops_;
  }
  void leave() {
    if (inFunction_ && pick(3) == 0)
      text_ += fmt::format("return {};\n", number(1));
    else if (!inFunction_ && pick(12) == 0)
      text_ += "return;\n";
    else if (loops_ > 0)
      text_ += fmt::format("{} {};\n", pick(2) ? "break" : "continue", 1 + pick(loops_));
  }
  void block(int depth) {
    for (uint32_t count = 1 + pick(4); count > 0; --count) {
      const uint32_t what = pick(depth < 4 ? 12 : 6);
      if (what < 5)
        assignment();
      else if (what == 5) {
        text_ += fmt::format("if ({})\n{{\n", condition(1));
        leave();
        text_ += "}\n";
      } else if (what < 9)
        branch(depth);
      else if (what < 11 || !lights_ || inLight_)
        loop(depth);
      else
        lightLoop(depth);
    }
  }

  const Choose& choose_;
  std::string text_;
  std::vector<std::string> functions_, reads_, writes_, colors_;
  bool array_ = false, lights_ = false, inFunction_ = false, inLight_ = false;
  uint32_t loops_ = 0;
  int counters_ = 0;
};

}  // namespace tomales::compiler
