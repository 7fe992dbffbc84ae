// Texts: comparison, concat(), match(), format(), printf() (RISpec 15.5). A value that differs from point to point
// counts as that of the first active point, except in printf().
#include <fmt/format.h>

#include "reyes/rsl/machine/call.h"
#include "reyes/shader/text.h"

namespace tomales::compiler {
namespace {

void setNumber(Run& run, int32_t to, float value) {
  std::fill_n(run.lane(to).data, run.varies(to) ? run.padded : kBlock, value);
}

void textEqual(Run& run, const PreparedInstruction& s) {
  setNumber(run, s.of->out[0], run.text(s.of->in[0]) == run.text(s.of->in[1]) ? 1.0f : 0.0f);
}

void match(Run& run, const PreparedInstruction& s) {
  setNumber(run, s.of->out[0], rsl::match(run.text(s.of->in[0]), run.text(s.of->in[1])) ? 1.0f : 0.0f);
}

/// Gives a register its text. A text that grows without end, as by `a = concat(a, a)` in a loop, is cut.
void setText(Run& run, const PreparedInstruction& s, std::string value) {
  if (value.size() > kLongestText) {
    run.missing(fmt::format("makes a text that would be longer than {} bytes; it is cut", kLongestText));
    value.resize(kLongestText);
  }
  run.variableText(s.of->out[0]) = std::move(value);
}

void concat(Run& run, const PreparedInstruction& s) {
  std::string all;
  for (const int32_t r : s.of->in) all += run.text(r);
  setText(run, s, std::move(all));
}

/// Returns a register's value at a point. The elements of an array are one value.
rsl::FormatValue valueAt(const Run& run, int32_t r, int32_t i) {
  const Register& reg = run.reg(r);
  rsl::FormatValue out;
  for (int32_t e = 0; e < elementsOf(reg); ++e) {
    if (reg.shape == Shape::Text) {
      out.text += (e > 0 ? " " : "") + run.text(r, e);
      continue;
    }
    const int32_t width = floatsOf(reg);
    for (int32_t c = 0; c < width; ++c)
      out.numbers.push_back(
          run.lane(r).data[(e * width + c) * static_cast<ptrdiff_t>(run.stride(r)) + (run.varies(r) ? i : 0)]);
  }
  return out;
}

std::string formatted(const Run& run, const Instruction& of, int32_t i) {
  std::vector<rsl::FormatValue> values;
  for (size_t k = 1; k < of.in.size(); ++k) values.push_back(valueAt(run, of.in[k], i));
  return rsl::formatValues(run.text(of.in[0]), values);
}

void format(Run& run, const PreparedInstruction& s) { setText(run, s, formatted(run, *s.of, run.firstActive())); }

/// Prints a line for each active point (RISpec 15.5).
void print(Run& run, const PreparedInstruction& s) {
  const TmGrid* const g = run.asking();
  for (int32_t i = 0; i < run.count; ++i)
    if (run.mask->on[i]) g->call->print(g->host, g, formatted(run, *s.of, i).c_str());
}

void report(Run& run, const PreparedInstruction& s) { run.missing(run.text(s.of->in[0])); }

constexpr Row kTextRows[] = {{Op::TextEqual, textEqual}, {Op::Match, match}, {Op::Concat, concat},
                             {Op::Format, format},       {Op::Print, print}, {Op::Report, report}};

}  // namespace

std::span<const Row> textRows() { return kTextRows; }

}  // namespace tomales::compiler
