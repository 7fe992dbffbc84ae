// Noun: the table of named attributes. Each row has the type, how a scene sets the attribute, and the value that
// conditions and shaders read.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "reyes/state.h"

namespace tomales {

struct NamedAttribute {
  using Setter = void (*)(Attributes&, const Param&);
  using Getter = Param (*)(const Attributes&);

  std::string_view name;                  ///< "category:name" of Attribute, or the request that sets it.
  const char* type = nullptr;             ///< The type of a value that names none, as in Declare; null for a request.
  Setter setNumbers = nullptr;            ///< Pre: the value has a number.
  Setter setStrings = nullptr;            ///< Pre: the value has a string.
  Getter get = nullptr;                   ///< Gives the value to conditions and shaders; its name is empty.
  std::vector<std::string_view> words{};  ///< The strings that it knows; the first stands for others. If empty, any.
};

/// Has a row for all that can be set in Attributes, for what Attribute sets elsewhere, and for names that are known but
/// have no effect.
std::span<const NamedAttribute> namedAttributes();
/// Returns null if there is no row of that name.
const NamedAttribute* findNamedAttribute(std::string_view name);

}  // namespace tomales
