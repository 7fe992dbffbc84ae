// Which lights a shader asks for, by name. Behind TmServices::illuminance.
#pragma once
#include <string_view>

namespace tomales {

/// RSL categories: is a light of `categories` (names by commas) one that `expression` names? ',' and '|' join
/// alternatives, '&' conditions, '-' excludes; an empty expression names all.
bool inCategory(std::string_view categories, std::string_view expression);

}  // namespace tomales
