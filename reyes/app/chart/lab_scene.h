// A scene with a knob that drives a method from harmless to fatal. It is RIB, with `$knob` where the knob's value
// belongs (there or in the arguments of a method), and says in comments what is to be measured:
//
//   ##lab title Walls thinner than a record's reach
//   ##lab knob thickness of the wall, m: 0.4 0.2 0.1 0.05 0.02        (harmless first)
//   ##lab truth --gi reference --bounces 1 --samples 256 --light-seed @ (rendered several times; @ is the number of the
//   time)
//   ##lab method gather, screen: --gi gather --samples 200             (once a method)
//   ##lab common --indirect-only                                       (of every run)
//   ##lab note Walls under 2 cm leak with records farther apart than that. (optional; repeated lines are joined)
//   ##lab limit pixel-noise: 0.05                                      (optional: from this value on the renderer
//   itself warns, under this code)
//
// `$truth` is 1 while the truth is rendered and 0 else: IfBegin "$truth == 1" can give the truth what methods are
// spared.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace tomales {

struct LabMethod {
  std::string name;
  std::vector<std::string> arguments;
};

/// Of a method's use, as documented.
struct LabLimit {
  std::string warning;  ///< Code of what the renderer says beyond it.
  std::string value;    ///< Of the knob, the first that is beyond.
};

struct LabScene {
  std::string file, title, knob;
  std::vector<std::string> values;  ///< As written; harmless first.
  std::vector<std::string> common, truth;
  std::vector<LabMethod> methods;
  std::optional<LabLimit> limit;
  std::string note;  ///< What the manual says about it.
  std::string text;  ///< Of the whole file.
};

/// Nothing, and why, if the file cannot be read or lacks a title, a knob, a truth or a method, or its limit is none of
/// the knob's values after the first.
std::optional<LabScene> readLabScene(const std::string& file, std::string& error);
/// The text with every `name`, a word that begins with $, replaced.
std::string replaced(std::string text, const std::string& name, const std::string& value);

}  // namespace tomales
