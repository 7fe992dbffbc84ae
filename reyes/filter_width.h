// The widths of pixel filters that can be used.
#pragma once

namespace tomales {

/// A filter narrower than a pixel would miss every sample of some pixels.
constexpr float kNarrowestFilter_px = 1;
/// This limit bounds memory against a mistyped width.
constexpr float kWidestFilter_px = 32;

}  // namespace tomales
