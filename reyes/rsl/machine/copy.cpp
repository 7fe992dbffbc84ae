// Assignments, which change active points alone, and elements of arrays.
#include "reyes/rsl/machine/masks.h"
#include "reyes/rsl/machine/table.h"

namespace tomales::compiler {
namespace {

/// Copies one component of a register to another register.
void copyLane(Run& run, bool all, const float* from, bool fromVaries, float* to, bool toVaries) {
  if (!toVaries)
    std::fill_n(to, kBlock, fromVaries ? from[run.firstActive()] : *from);
  else if (all && fromVaries)
    std::copy_n(from, run.padded, to);
  else if (all)
    std::fill_n(to, run.padded, *from);
  else if (fromVaries)
    copyWhere(run.padded, run.mask->on, from, to);
  else
    fillWhere(run.padded, run.mask->on, *from, to);
}

void executeComponent(Run& run, const PreparedInstruction& s) {
  const Lanes &from = run.lane(s.in[0]), &to = run.lane(s.out);
  copyLane(run, true, from.data + s.component * static_cast<ptrdiff_t>(from.component), from.block != 0, to.data,
           to.block != 0);
}

void copyTexts(Run& run, int32_t from, int32_t to) {
  const int32_t has = run.reg(from).length, wants = elementsOf(run.reg(to));
  for (int32_t e = 0; e < (has > 0 ? std::min(has, wants) : wants); ++e)
    run.variableText(to, e) = run.text(from, has > 0 ? e : 0);
}

void executeCopy(Run& run, const PreparedInstruction& s) {
  const int32_t from = s.of->in[0], to = s.of->out[0];
  const Register &source = run.reg(from), &target = run.reg(to);
  if (target.shape == Shape::Text) return copyTexts(run, from, to);
  const bool all = !s.of->masked || run.mask->full, fromVaries = run.varies(from), toVaries = run.varies(to);
  const bool each = source.length > 0;  // otherwise the value counts for all elements
  const int32_t elements = each ? std::min(source.length, elementsOf(target)) : elementsOf(target);
  const int32_t width = floatsOf(target);
  const ptrdiff_t one = floatsOf(source) == 1 ? 0 : run.stride(from), next = run.stride(to);
  const ptrdiff_t element = each ? floatsOf(source) * static_cast<ptrdiff_t>(run.stride(from)) : 0;
  for (int32_t e = 0; e < elements; ++e)
    for (int32_t c = 0; c < width; ++c)
      copyLane(run, all, run.lane(from).data + e * element + c * one, fromVaries,
               run.lane(to).data + (e * width + c) * next, toVaries);
}

/// Returns the element that a number asks for: rounded down and clamped to the array.
int32_t elementAt(float index, int32_t length, bool& outside) {
  const bool fits = index >= 0 && index < static_cast<float>(length);
  outside |= !fits;
  return fits ? static_cast<int32_t>(index) : index > 0 ? length - 1 : 0;
}

void tellOutside(Run& run, int32_t array) {
  const Register& r = run.reg(array);
  run.warn("asks for an element that the array \"" + r.name + "\" of " + std::to_string(r.length) +
           " has not; the nearest is taken");
}

/// Returns the elements that all points ask for; inactive points may ask for any.
const int32_t* elements(Run& run, int32_t array, int32_t index) {
  int32_t* const out = reinterpret_cast<int32_t*>(run.memory.floats(static_cast<size_t>(run.padded)));
  const float* const wanted = run.lane(index).data;
  const int32_t step = run.varies(index) ? 1 : 0, length = elementsOf(run.reg(array));
  bool outside = false;
  for (int32_t i = 0; i < run.padded; ++i) {
    bool wrong = false;
    out[i] = elementAt(wanted[i * step], length, wrong);
    outside |= wrong && run.mask->on[i];
  }
  if (outside) tellOutside(run, array);
  return out;
}

void executeElement(Run& run, const PreparedInstruction& s) {
  const int32_t array = s.of->in[0], index = s.of->in[1], to = s.of->out[0];
  const int32_t width = floatsOf(run.reg(to)), stride = run.stride(array), next = run.stride(to);
  const float* const from = run.lane(array).data;
  const ptrdiff_t element = static_cast<ptrdiff_t>(width) * stride;
  const bool varies = run.varies(array);
  if (!run.varies(index)) {
    bool outside = false;
    const int32_t e = elementAt(*run.lane(index).data, elementsOf(run.reg(array)), outside);
    if (outside) tellOutside(run, array);
    for (int32_t c = 0; c < width; ++c)
      copyLane(run, true, from + e * element + c * static_cast<ptrdiff_t>(stride), varies,
               run.lane(to).data + c * static_cast<ptrdiff_t>(next), run.varies(to));
    return;
  }
  const Borrowed borrowed(run.memory);
  const int32_t* const which = elements(run, array, index);
  for (int32_t c = 0; c < width; ++c) {
    float* const out = run.lane(to).data + c * static_cast<ptrdiff_t>(next);
    for (int32_t i = 0; i < run.padded; ++i)
      out[i] = from[which[i] * element + c * static_cast<ptrdiff_t>(stride) + (varies ? i : 0)];
  }
}

void executeElementText(Run& run, const PreparedInstruction& s) {
  bool outside = false;
  const int32_t array = s.of->in[0], index = s.of->in[1];
  const float wanted = run.lane(index).data[run.varies(index) ? run.firstActive() : 0];
  const int32_t e = elementAt(wanted, elementsOf(run.reg(array)), outside);
  if (outside) tellOutside(run, array);
  run.variableText(s.of->out[0]) = run.text(array, e);
}

void executeSetElement(Run& run, const PreparedInstruction& s) {
  const int32_t array = s.of->out[0], index = s.of->in[0], value = s.of->in[1];
  const Register& target = run.reg(array);
  bool outside = false;
  if (target.shape == Shape::Text) {
    const int32_t e = elementAt(*run.lane(index).data, elementsOf(target), outside);
    if (outside) tellOutside(run, array);
    run.variableText(array, e) = run.text(value);
    return;
  }
  const int32_t width = floatsOf(target), stride = run.stride(array);
  const ptrdiff_t element = static_cast<ptrdiff_t>(width) * stride,
                  one = floatsOf(run.reg(value)) == 1 ? 0 : run.stride(value);
  float* const to = run.lane(array).data;
  const float* const from = run.lane(value).data;
  if (!run.varies(index)) {
    const int32_t e = elementAt(*run.lane(index).data, elementsOf(target), outside);
    if (outside) tellOutside(run, array);
    for (int32_t c = 0; c < width; ++c)
      copyLane(run, !s.of->masked || run.mask->full, from + c * one, run.varies(value),
               to + e * element + c * static_cast<ptrdiff_t>(stride), run.varies(array));
    return;
  }
  const Borrowed borrowed(run.memory);
  const int32_t* const which = elements(run, array, index);
  const int32_t step = run.varies(value) ? 1 : 0;
  for (int32_t i = 0; i < run.count; ++i)
    for (int32_t c = 0; run.mask->on[i] && c < width; ++c)
      to[which[i] * element + c * static_cast<ptrdiff_t>(stride) + (run.varies(array) ? i : 0)] =
          from[c * one + i * step];
}

constexpr Row kCopyRows[] = {{Op::Copy, executeCopy},        {Op::SetElement, executeSetElement},
                             {Op::ElementF, executeElement}, {Op::ElementT, executeElement},
                             {Op::ElementM, executeElement}, {Op::ElementS, executeElementText}};

}  // namespace

Execute componentRunner() { return executeComponent; }

std::span<const Row> copyRows() { return kCopyRows; }

}  // namespace tomales::compiler
