// Declarations of parameter names: the standard ones, those of Declare, and inline ones.
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
  bool standard = false;   ///< Neither inline nor by Declare: the type that such a name has as a rule.
  bool reference = false;  ///< "reference color c": a string that stands in for a value of the type.
};

class Dictionary {
 public:
  static constexpr int kLongestArray = 1 << 16, kMostColorSamples = 64;

  /// Holds the standard names of RISpec 3.2 and of the options and attributes that Tomales knows.
  Dictionary();

  /// `declaration`: "class type[n]", where class and type may each be missing, and n: then it is 1. False: not
  /// understood.
  bool declare(const std::string& name, const std::string& declaration);

  /// Of the token of a parameter list: a declared name, or an inline declaration "class type[n] name". On
  /// success `name` is the bare name. `category` is that of Option and Attribute ("visibility"), whose own
  /// names come first.
  std::optional<Declaration> find(const std::string& token, const std::string& category, std::string& name) const;

  /// ColorSamples (RISpec 3.2 section 4.1.6): a row of red, green and blue for each number of a color; empty: they are
  /// those three. False: the matrix is none.
  bool setColorSamples(std::vector<float> rgbOfSamples);
  int colorSamples() const { return rgbOfSamples_.empty() ? 3 : static_cast<int>(rgbOfSamples_.size() / 3); }
  /// The colors of the stream as red, green and blue. Pre: a multiple of colorSamples().
  std::vector<float> rgb(const std::vector<float>& colors) const;
  bool hasColorSamples() const { return !rgbOfSamples_.empty(); }

 private:
  std::vector<float> rgbOfSamples_;
  using Names = std::unordered_map<std::string, Declaration>;
  /// Every procedural keeps a copy of the dictionary; few of them declare anything.
  std::shared_ptr<Names> names_ = std::make_shared<Names>();
};

}  // namespace tomales::rib
