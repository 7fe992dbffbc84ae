#include "gi/photons/passes.h"

#include <algorithm>
#include <cmath>

namespace tomales {
namespace {

constexpr int64_t kFirstRound = 1 << 13, kMostPhotonsOfPass = 1 << 17;
/// Disks are as large as their micropolygons after this many photons. Other numbers suit other scenes
/// (docs/measured/indirect.md, "Caustics"): fewer suit small caustics, and more suit rooms in large pictures.
constexpr double kPhotonsOfUnitScale = 0x1p28;

/// The area of a disk falls with n^(alpha - 1) after n photons. With alpha = 2/3, noise and bias fall equally fast
/// (Knaus and Zwicker 2011, section 4.3). The area in a round is the mean of those that it would have if disks shrank
/// after each photon.
double scaleOfRound(int64_t begin, int64_t end) {
  const auto integral = [](int64_t n) { return 1.5 * std::pow(static_cast<double>(n) / kPhotonsOfUnitScale, 2.0 / 3); };
  return std::sqrt((integral(end) - integral(begin)) * kPhotonsOfUnitScale / static_cast<double>(end - begin));
}

int64_t dividedUp(int64_t a, int64_t b) { return (a + b - 1) / b; }

}  // namespace

std::vector<PhotonPass> photonPasses(int64_t photons, bool shrinks) {
  std::vector<PhotonPass> out;
  for (int64_t begin = 0, end; begin < photons; begin = end) {
    end = std::max(2 * begin, kFirstRound);
    const double scale = shrinks ? scaleOfRound(begin, end) : 1;
    end = std::min(end, photons);
    const int64_t passes = 2 * dividedUp(end - begin, 2 * kMostPhotonsOfPass);
    for (int64_t i = 0, at = begin; i < passes && at < end; ++i) {
      const int64_t sent = std::min(dividedUp(end - begin, passes), end - at);
      at += sent;
      out.push_back({sent, static_cast<float>(scale), at == end});
    }
  }
  return out;
}

}  // namespace tomales
