// The positions at which a shader asks for light: the points of its batch, or other positions, for example of a volume
// that marches along a ray. Used by TmServices::illuminance. The light at a point does not depend on the other points
// of its batch: points of a surface that have not moved keep their samples, and a volume that names positions is in the
// air at all of them. Lights with "shadowvariance" are the exception, because only at the batch's own points it is
// known whether enough shadow rays have been traced.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// A copy of a batch at other positions, where its shader asks for light. Its lights run for these positions.
struct RemoteBatch {
  /// Copies the query. Pre: `asking` has points, and the query has a P.
  RemoteBatch(const Batch& asking, const TmGrid* g, const TmIlluminance& query, bool inAir, int number);
  /// Tells whether it was made for this query.
  bool isFor(const TmGrid* g, const TmIlluminance& query, bool inAir) const;

  const int number;  ///< Its number among those of the asking batch, from 1.
  ArenaLease arena;
  ShadeContext context;
  ShadePoints points;
  LightRequest request;
  Batch batch;
};

/// Returns the batch whose lights answer a query: `batch` itself, or one of its latest remote batches.
Batch& remoteBatchOf(Batch& batch, const TmGrid* g, TmIlluminance query);

/// Returns the number of a sample in TmIlluminance::light.
int32_t lightNumber(const Batch& batch, const Batch& place, size_t sample);
/// Returns the sample of that number; null if it does not exist, or no longer exists.
LightSample* lightNumbered(Batch& batch, int32_t number);

}  // namespace tomales
