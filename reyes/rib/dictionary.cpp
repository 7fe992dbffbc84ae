#include "reyes/rib/dictionary.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "reyes/attribute_table.h"
#include "reyes/rib/option_table.h"

namespace tomales::rib {
namespace {

struct Standard {
  const char *declaration, *names;
};

constexpr Standard kStandard[] = {
    // Primitive variables (RISpec 3.2 table 5.1)
    {"vertex point", "P"},
    {"vertex hpoint", "Pw"},
    {"vertex float", "Pz"},
    {"varying normal", "N"},
    {"uniform normal", "Np"},
    {"varying color", "Cs Os"},
    {"varying float", "s t width"},
    {"varying float[2]", "st"},
    {"constant float", "constantwidth"},
    {"varying float", "patchangle patchaspectratio"},
    {"uniform point", "gatherP"},
    {"uniform normal", "gatherN"},
    // Parameters of the standard shaders (RISpec 3.2 appendix A)
    {"float",
     "Ka Kd Ks Kr roughness intensity coneangle conedeltaangle beamdistribution amplitude mindistance "
     "maxdistance distance Km opacity samples blur shadowbias"},
    {"color", "lightcolor specularcolor background bgcolor color"},
    {"point", "from to"},
    {"string", "filename texturename shadowname mapname sfpx sfnx sfpy sfny sfpz sfnz"},
    // Camera, displays, hiders
    {"float", "fov depthbias jitter dither minwidth dofaspect"},
    {"float[4]", "aperture"},
    {"int", "samplemotion"},
    {"float[2]", "shutteropening exposure filterwidth"},
    {"float[4]", "quantize"},
    {"int[2]", "origin"},
    {"string",
     "operation subset compression filter depthfilter type source exrpixeltype exrcompression transfer lightgroup "
     "__group __category"},
    {"float", "fill mergedepth mergeopacity"},
    {"float", "maxerror radiusscale"},  // parameters of MakeBrickMap
    {"int", "maxdepth ignorenormals"},
    {"float[8]", "chromaticities"},
    {"int", "tiled multipart"},
};

template <class Enum, size_t kCount>
bool findName(const std::string_view (&names)[kCount], std::string_view word, Enum& out) {
  const auto it = std::find(names, names + kCount, word);
  if (it == names + kCount) return false;
  out = static_cast<Enum>(it - names);
  return true;
}

bool readWord(std::string_view word, Storage& out) {
  if (word == "facevertex") return out = Storage::FaceVarying, true;
  return findName(kStorageNames, word, out);
}

bool readWord(std::string_view word, ValueType& out) {
  if (word == "integer") return out = ValueType::Integer, true;
  if (word == "mpoint") return out = ValueType::Matrix, true;
  return findName(kValueTypeNames, word, out);
}

std::vector<std::string_view> words(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<std::string_view> out;
  for (size_t begin = text.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    out.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kBlanks, end);
  }
  return out;
}

// Removes "[n]", with blanks anywhere, from `text`.
bool takeArrayLength(std::string& text, int& length) {
  const size_t open = text.find('['), close = text.find(']');
  if (open == std::string::npos && close == std::string::npos) return true;
  if (open == std::string::npos || close == std::string::npos || close < open) return false;
  const auto digits = words(std::string_view(text).substr(open + 1, close - open - 1));
  if (digits.empty()) {
    text.replace(open, close - open + 1, " ");
    return true;
  }
  if (digits.size() != 1) return false;
  const auto [end, error] = std::from_chars(digits[0].data(), digits[0].data() + digits[0].size(), length);
  const bool good = error == std::errc() && end == digits[0].data() + digits[0].size() && length >= 1 &&
                    length <= Dictionary::kLongestArray;
  text.replace(open, close - open + 1, " ");
  return good;
}

// Takes class and type off the front; the rest is the name.
bool takeClassAndType(std::vector<std::string_view>& list, Declaration& d, bool& typed) {
  const auto take = [&list](auto& value) {
    const bool found = !list.empty() && readWord(list[0], value);
    if (found) list.erase(list.begin());
    return found;
  };
  d.reference = !list.empty() && list[0] == "reference";
  if (d.reference) list.erase(list.begin());
  const bool classed = take(d.storage);
  typed = take(d.type);
  // What PRMan's nodes refer to by handle: manifolds of patterns ("struct"), and other nodes of a kind.
  static constexpr std::string_view kNodes[] = {"struct",      "bxdf",         "displacement", "displayfilter",
                                                "lightfilter", "samplefilter", "integrator",   "projection"};
  if (d.reference && !typed && list.size() > 1 &&
      std::find(std::begin(kNodes), std::end(kNodes), list[0]) != std::end(kNodes)) {
    d.type = ValueType::String;
    typed = true;
    list.erase(list.begin());
  }
  return classed || typed;
}

}  // namespace

Dictionary::Dictionary() {
  const auto add = [this](std::string_view name, const char* declaration) {
    declare(std::string(name), declaration);
    (*names_)[std::string(name)].standard = true;
  };
  for (const Standard& s : kStandard)
    for (const std::string_view name : words(s.names)) add(name, s.declaration);
  for (const NamedOption& row : namedOptions()) add(row.name, row.type);
  for (const NamedAttribute& row : namedAttributes())
    if (row.type) add(row.name, row.type);
}

bool Dictionary::declare(const std::string& name, const std::string& declaration) {
  std::string text = declaration;
  Declaration d;
  if (name.empty() || !takeArrayLength(text, d.arrayLength)) return false;
  auto list = words(text);
  bool typed = false;
  if (!takeClassAndType(list, d, typed) || !list.empty()) return false;
  if (names_.use_count() > 1) names_ = std::make_shared<Names>(*names_);
  (*names_)[name] = d;
  return true;
}

bool Dictionary::setColorSamples(std::vector<float> rgbOfSamples) {
  const size_t n = rgbOfSamples.size() / 3;
  if (rgbOfSamples.size() % 3 != 0 || n > static_cast<size_t>(kMostColorSamples)) return false;
  rgbOfSamples_ = std::move(rgbOfSamples);
  return true;
}

std::vector<float> Dictionary::rgb(const std::vector<float>& colors) const {
  const size_t n = rgbOfSamples_.size() / 3;
  if (n == 0) return colors;
  std::vector<float> out(colors.size() / n * 3, 0.0f);
  for (size_t i = 0; i < colors.size() / n * n; ++i)
    for (size_t c = 0; c < 3; ++c) out[i / n * 3 + c] += colors[i] * rgbOfSamples_[i % n * 3 + c];
  return out;
}

std::optional<Declaration> Dictionary::find(const std::string& token, const std::string& category,
                                            std::string& name) const {
  const auto declared = [&](const std::string& bare) -> const Declaration* {
    auto it = category.empty() ? names_->end() : names_->find(category + ":" + bare);
    if (it == names_->end()) it = names_->find(bare);
    return it == names_->end() ? nullptr : &it->second;
  };
  if (const Declaration* d = declared(token)) {
    name = token;
    return *d;
  }
  std::string text = token;
  Declaration d;
  if (!takeArrayLength(text, d.arrayLength)) return std::nullopt;
  auto list = words(text);
  // A lone word is a name, even if it is also the name of a type.
  bool typed = false;
  if (list.size() < 2 || !takeClassAndType(list, d, typed) || list.size() != 1) return std::nullopt;
  name = list[0];
  const Declaration* known = typed ? nullptr : declared(name);
  if (known) d = {d.storage, known->type, known->arrayLength, false, d.reference};
  return d;
}

}  // namespace tomales::rib
