// Declarations of parameter names: standard, by Declare, and inline.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "reyes/base/value.h"

namespace tomales::rib {

struct Declaration {
  Storage storage = Storage::Uniform;
  ValueType type = ValueType::Float;
  int arrayLength = 1;
  bool standard = false;   ///< True if the type is the standard one of the name, neither inline nor by Declare.
  bool reference = false;  ///< True for "reference color c": a string that stands in for a value of the type.
};

class Dictionary {
 public:
  static constexpr int kLongestArray = 1 << 16, kMostColorSamples = 64;

  /// Holds the standard names of RISpec 3.2 and of the options and attributes that Tomales knows.
  Dictionary();

  /// `declaration` is "class type[n]". Each of the three may be missing; n is 1 then. Returns false if it is not
  /// understood.
  bool declare(const std::string& name, const std::string& declaration);

  /// Finds the declaration for the token of a parameter list: a declared name, or an inline declaration "class type[n]
  /// name". On success `name` is the bare name. `category` is the one of an Option or Attribute ("visibility"), whose
  /// own names take precedence.
  std::optional<Declaration> find(const std::string& token, const std::string& category, std::string& name) const;

  /// Sets ColorSamples (RISpec 3.2 section 4.1.6): a row of red, green and blue for each number of a color; if there
  /// are none, colors are red, green and blue. Returns false if the matrix is not of this form.
  bool setColorSamples(std::vector<float> rgbOfSamples);
  int colorSamples() const { return rgbOfSamples_.empty() ? 3 : static_cast<int>(rgbOfSamples_.size() / 3); }
  /// Converts colors of the stream to red, green and blue. Pre: their number is a multiple of colorSamples().
  std::vector<float> rgb(const std::vector<float>& colors) const;
  bool hasColorSamples() const { return !rgbOfSamples_.empty(); }

 private:
  std::vector<float> rgbOfSamples_;
  using Names = std::unordered_map<std::string, Declaration>;
  /// It is shared, because every procedural keeps a copy of the dictionary, and few of them declare anything.
  std::shared_ptr<Names> names_ = std::make_shared<Names>();
};

}  // namespace tomales::rib
