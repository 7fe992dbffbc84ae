#include "reyes/app/chart/lab_scene.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "reyes/base/input_file.h"

namespace tomales {
namespace {

constexpr const char* kMark = "##lab ";

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> out;
  for (std::string word; stream >> word;) out.push_back(word);
  return out;
}

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string::npos ? std::string() : text.substr(begin, end - begin + 1);
}

/// Returns the texts before and after the last colon.
std::pair<std::string, std::string> named(const std::string& text) {
  const size_t colon = text.rfind(": ");
  return colon == std::string::npos ? std::pair{text, std::string()}
                                    : std::pair{trimmed(text.substr(0, colon)), text.substr(colon + 1)};
}

bool isNumber(const std::string& word) {
  size_t used = 0;
  try {
    const double value = std::stod(word, &used);
    return value > 0 && std::isfinite(value) && used == word.size();
  } catch (const std::exception&) {
    return false;
  }
}

/// Returns false if there is no such word, or if `rest` does not suit it.
bool take(LabScene& scene, const std::string& word, const std::string& rest) {
  if (word == "title")
    scene.title = rest;
  else if (word == "note")
    scene.note += (scene.note.empty() ? "" : " ") + rest;
  else if (word == "common")
    scene.common = wordsOf(rest);
  else if (word == "truth")
    scene.truth = wordsOf(rest);
  else if (word == "method") {
    const auto [name, arguments] = named(rest);
    scene.methods.push_back({name, wordsOf(arguments)});
  } else if (word == "knob") {
    const auto [name, values] = named(rest);
    scene.knob = name;
    scene.values = wordsOf(values);
    return !scene.values.empty() && std::all_of(scene.values.begin(), scene.values.end(), isNumber);
  } else if (word == "limit") {
    const auto [warning, value] = named(rest);
    scene.limit = LabLimit{warning, trimmed(value)};
    return !warning.empty() && isNumber(scene.limit->value);
  } else
    return false;
  return true;
}

}  // namespace

std::optional<LabScene> readLabScene(const std::string& file, std::string& error) {
  if (const std::string problem = inputProblem(file); !problem.empty()) {
    error = "cannot be read: " + problem;
    return std::nullopt;
  }
  std::ifstream stream(file);
  LabScene out{file, {}, {}, {}, {}, {}, {}, {}, {}, {std::istreambuf_iterator<char>(stream), {}}};
  std::istringstream lines(out.text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(kMark)) continue;
    const std::string said = trimmed(line.substr(std::string(kMark).size()));
    const size_t space = said.find(' ');
    const std::string rest = space == std::string::npos ? std::string() : trimmed(said.substr(space));
    if (take(out, said.substr(0, space), rest)) continue;
    error = "cannot be understood: " + line;
    return std::nullopt;
  }
  const auto& values = out.values;
  const bool limitIsElsewhere =
      out.limit && (values.empty() || std::find(values.begin() + 1, values.end(), out.limit->value) == values.end());
  for (const auto& [missing, what] :
       {std::pair{out.title.empty(), "has no \"##lab title\""},
        {out.values.empty(), "has no \"##lab knob\""},
        {out.truth.empty(), "has no \"##lab truth\""},
        {out.methods.empty(), "has no \"##lab method\""},
        {out.text.find("$knob") == std::string::npos, "has no $knob"},
        {limitIsElsewhere, "has a \"##lab limit\" that is none of the knob's values after the first"}})
    if (missing) {
      error = what;
      return std::nullopt;
    }
  return out;
}

std::string replaced(std::string text, const std::string& name, const std::string& value) {
  for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + value.size()))
    text.replace(at, name.size(), value);
  return text;
}

}  // namespace tomales
