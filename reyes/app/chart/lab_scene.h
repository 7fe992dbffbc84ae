// A scene with a knob that drives a method from harmless to fatal. It is RIB, with `$knob` where the knob's value
// belongs (there or in the arguments of a method). Comments say what is measured:
//
//   ##lab title Walls thinner than a record's reach
//   ##lab knob thickness of the wall, m: 0.4 0.2 0.1 0.05 0.02             (harmless first)
//   ##lab truth --gi reference --bounces 1 --samples 256 --light-seed @    (several times, whose number is @)
//   ##lab method gather, screen: --gi gather --samples 200                 (one line for each method)
//   ##lab common --indirect-only                                           (of every run)
//   ##lab note Walls under 2 cm leak with records farther apart than that. (optional; repeated lines are joined)
//   ##lab limit pixel-noise: 0.05      (optional: from this value on the renderer itself warns, under this code)
//
// `$truth` is 1 while the truth is rendered and 0 else: by IfBegin "$truth == 1" the truth can have things that methods
// do not.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace tomales {

struct LabMethod {
  std::string name;
  std::vector<std::string> arguments;
};

/// The documented limit of a method's use.
struct LabLimit {
  std::string warning;  ///< Code of the renderer's warning beyond the limit.
  std::string value;    ///< The first value of the knob that is beyond it.
};

struct LabScene {
  std::string file, title, knob;
  std::vector<std::string> values;  ///< The values as written, harmless first.
  std::vector<std::string> common, truth;
  std::vector<LabMethod> methods;
  std::optional<LabLimit> limit;
  std::string note;  ///< Words of the manual about the scene.
  std::string text;  ///< The text of the whole file.
};

/// Returns nothing, and says why, if the file cannot be read or lacks a title, a knob, a truth or a method, or if its
/// limit is none of the knob's values after the first.
std::optional<LabScene> readLabScene(const std::string& file, std::string& error);
/// Replaces every `name`, a word that begins with $, in the text.
std::string replaced(std::string text, const std::string& name, const std::string& value);

}  // namespace tomales
