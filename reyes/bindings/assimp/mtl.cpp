#include "reyes/bindings/assimp/mtl.h"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "reyes/base/text.h"

namespace tomales::model {
namespace {

constexpr const char* kBlanks = " \t\r";

/// The words of a line, one after another.
class Words {
 public:
  explicit Words(std::string& line) : line_(line) {}
  /// Returns the next word; empty: the line ends.
  std::string next() {
    begin_ = std::min(line_.find_first_not_of(kBlanks, end_), line_.size());
    end_ = std::min(line_.find_first_of(kBlanks, begin_), line_.size());
    return line_.substr(begin_, end_ - begin_);
  }
  void back() { end_ = begin_; }
  size_t begin() const { return begin_; }
  /// Removes the text from there to the beginning of the next word.
  void erase(size_t from) {
    next();
    line_.erase(from, begin_ - from);
    end_ = from;
  }
  /// Returns the rest of the line without the blanks around it.
  std::string rest() const {
    const size_t first = line_.find_first_not_of(kBlanks, end_);
    return first == line_.npos ? "" : line_.substr(first, line_.find_last_not_of(kBlanks) + 1 - first);
  }

 private:
  std::string& line_;
  size_t begin_ = 0, end_ = 0;
};

std::optional<float> numberOf(const std::string& word) {
  char* end = nullptr;
  const float out = std::strtof(word.c_str(), &end);
  return word.empty() || *end != 0 ? std::nullopt : std::optional(out);
}

/// Reads up to three numbers. A number that is not finite leaves its component as it was.
vec3 numbersOf(Words& words, vec3 out) {
  for (int k = 0; k < 3; ++k) {
    const auto number = numberOf(words.next());
    if (!number) {
      words.back();
      break;
    }
    if (std::isfinite(*number)) out[k] = *number;
  }
  return out;
}

aiTextureType typeOf(const std::string& word) {
  static const std::map<std::string, aiTextureType> kTypes = {
      {"map_kd", aiTextureType_DIFFUSE},   {"map_ke", aiTextureType_EMISSIVE},
      {"map_d", aiTextureType_OPACITY},    {"map_emissive", aiTextureType_EMISSIVE},
      {"norm", aiTextureType_NORMALS},     {"map_kn", aiTextureType_NORMALS},
      {"map_pm", aiTextureType_METALNESS}, {"map_pr", aiTextureType_DIFFUSE_ROUGHNESS}};
  const auto found = kTypes.find(word);
  return found == kTypes.end() ? aiTextureType_NONE : found->second;
}

/// Reads the options of a picture, and removes those that place it.
void readOptions(Words& words, aiTextureType type, MtlMaterial* material) {
  vec3 scale(1.0f), offset(0.0f), unused(0.0f);
  bool isPlaced = false;
  for (std::string option = words.next(); option.size() > 1 && option[0] == '-'; option = words.next()) {
    vec3* placing = option == "-s" ? &scale : option == "-o" ? &offset : option == "-t" ? &unused : nullptr;
    if (placing) {
      const size_t from = words.begin();
      *placing = numbersOf(words, *placing);
      words.erase(from);
      isPlaced = true;
    } else {
      for (int k = option == "-mm" ? 2 : 1; k > 0; --k) words.next();
    }
  }
  if (!material) return;
  material->placed.erase(type);  // which an earlier line may have placed
  if (isPlaced) material->placed[type] = {{scale.x, 0, 0}, {0, scale.y, 0}, {offset.x, offset.y, 1}};
}

}  // namespace

std::string plainMtl(const std::string& text, MtlMaterials& materials) {
  std::istringstream lines(text);
  std::string out, line;
  MtlMaterial* material = nullptr;
  while (std::getline(lines, line)) {
    Words words(line);
    const std::string word = lowerCase(words.next());
    if (word == "newmtl")
      material = &materials[words.rest()];
    else if (word == "kd" && material)
      material->hasColor = true;
    else if (word.starts_with("map_") || word == "norm" || word == "bump" || word == "disp" || word == "refl")
      readOptions(words, typeOf(word), material);
    out += line + "\n";
  }
  return out;
}

}  // namespace tomales::model
