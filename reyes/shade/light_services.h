// Finds the lights that a shader asks for by category. Used by TmServices::illuminance.
#pragma once
#include <string_view>

namespace tomales {

/// Tells whether a light of `categories` (names separated by commas) matches an expression of RSL: ',' and '|' join
/// alternatives, '&' joins conditions, '-' excludes; an empty expression matches all.
bool inCategory(std::string_view categories, std::string_view expression);

}  // namespace tomales
