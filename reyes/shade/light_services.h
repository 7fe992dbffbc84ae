// Finds the lights that a shader asks for by name. Behind TmServices::illuminance.
#pragma once
#include <string_view>

namespace tomales {

/// Tells whether a light of `categories` (names by commas) is one that `expression` names, as RSL does: ',' and '|'
/// join alternatives, '&' conditions, '-' excludes; an empty expression names all.
bool inCategory(std::string_view categories, std::string_view expression);

}  // namespace tomales
