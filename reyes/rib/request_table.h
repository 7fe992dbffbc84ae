// The signatures of every request of RISpec 3.2 and of PRMan's extensions. The parser needs them for all
// requests, also for those that are not rendered: only a signature tells where a request ends.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tomales::rib {

enum class Support {
  Works,
  Draws,    ///< The request works, and without it something would be missing from the picture.
  Ignored,  ///< It is reported once, then ignored.
};

/// `arguments` is a list of letters, one for each positional argument:
///   f number   i integer   s string   h handle (a string, or a number that becomes one)
///   F, I, S array of numbers, integers, strings
///   c a color: as many numbers as ColorSamples says, else 3
///   2..9 that many numbers, bare or in brackets anywhere   m 16 numbers   b a Basis: name or 16 numbers
///   ? what follows is given as a whole or left out
struct Signature {
  std::string_view name, arguments;
  bool parameterList;
  Support support;
};

/// Returns null if there is no such request.
const Signature* findSignature(std::string_view name);
/// Returns the names of all that findSignature() finds.
const std::vector<std::string>& requestNames();

}  // namespace tomales::rib
