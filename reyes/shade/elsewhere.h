// Where light arrives that a shader asks for: at the points of its batch or, as volumes ask that march along a ray,
// elsewhere. Behind TmServices::illuminance. What a point gets does not depend on the others of its batch: of a
// surface's points those that have not moved keep their samples, and a volume that names positions is in the air at all
// of them. (Lights with "shadowvariance" are the exception: whether their samples are settled is known at the batch's
// own points alone.)
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// A batch at other positions, with lights of its own.
struct Elsewhere {
  /// Copies what the query says. Pre: asking.points, query.P.
  Elsewhere(const Batch& asking, const TmGrid* g, const TmIlluminance& query, bool inAir, int number);
  /// Was it made for this?
  bool isFor(const TmGrid* g, const TmIlluminance& query, bool inAir) const;

  const int number;  ///< Among those of the asking batch, from 1.
  ArenaLease arena;
  ShadeContext context;
  ShadePoints points;
  LightRequest request;
  Batch batch;
};

/// The batch whose lights answer a query: `batch` itself, or one of the latest that it has asked elsewhere.
Batch& placeOf(Batch& batch, const TmGrid* g, TmIlluminance query);

/// What TmIlluminance::light says of a sample.
int32_t lightNumber(const Batch& batch, const Batch& place, size_t sample);
/// Null: there is none of this number, or not any more.
LightSample* lightNumbered(Batch& batch, int32_t number);

}  // namespace tomales
