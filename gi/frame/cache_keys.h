// Private to gi: which settings an indirect light is gathered with, and which cache answers it or a question about a
// hemisphere. Lengths: current space.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Returns the settings of an indirect light as this group sees them: the command line wins over the group's
/// attributes, and those over the light.
CacheKey cacheKeyFor(const GiState&, int group, const IndirectQuery&);

/// Finds the cache that serves a key, if there is one. Records that were given serve even where a light or an option
/// has since been changed: preferably those whose key differs in its rays alone, else those for the same question.
std::vector<PreparedCache>::const_iterator preparedFor(const GiState&, const CacheKey&);

/// Returns the settings that a cache with this error function has at `maxError`.
CacheSettings cacheSettings(ErrorFunction, float maxError);

/// Tells whether indirect light comes from an irradiance cache.
bool interpolatesIndirect(const GiState&);

/// Returns the number of diffuse bounces of a light.
int bouncesFor(const GiState&, const IndirectQuery&);
/// Returns the same for the paths of an audit (ShadeContext::auditPaths), which stand for all light that the method
/// brings, by maps or otherwise.
int auditBouncesFor(const GiState&, const IndirectQuery&);

}  // namespace tomales
