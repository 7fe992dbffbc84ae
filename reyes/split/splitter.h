// Private to splitting: halves the patches of one object until their pieces fit into grids.
#pragma once
#include "reyes/base/stop.h"
#include "reyes/split.h"
#include "reyes/split/object_view.h"
#include "reyes/split/rate.h"
#include "reyes/split/visits.h"

namespace tomales {

/// Splits the patches of one object.
class Splitter {
 public:
  /// Counts of pieces that were left out because halving did not help, or because there was no time left.
  struct GivenUp {
    int64_t atEye = 0, tooMany = 0;
  };

  /// The context must outlive this object.
  Splitter(const SplitContext& context, int object, Splitting splitting);

  /// Tells whether patches like this one may be dots. A shape has either disks only or none.
  bool hasDots(uint32_t patch) const {
    return view_.canBeRound(patch) && object_.displacementBound <= 0 && object_.attributes->rasterOrient;
  }
  /// Takes a patch that is clearly a small disk, or invisible, without measuring it, and returns nothing. Otherwise it
  /// returns the patch's bound, and the patch has to be split. Pre: hasDots().
  std::optional<Bound3> takeDot(uint32_t patch, std::vector<SubPatch>& out);
  /// Known facts about a whole patch before it is split.
  struct Known {
    PatchSize size;                ///< The result of measureWhole().
    const Bound3* bare = nullptr;  ///< The result of undisplacedBound(); null if it has not been computed.
  };
  void splitPatch(uint32_t patch, const Known& known, std::vector<SubPatch>& out) {
    splitWithin(visits_.ofPatch(object_.shape().patchCount()), patch, UvRect{}, 0, &known, out);
  }
  void splitPiece(const SubPatch& coarse, std::vector<SubPatch>& out) {
    splitWithin(coarse.visits, coarse.patch, coarse.rect, coarse.depth, nullptr, out);
  }

  const GivenUp& givenUp() const { return givenUp_; }

 private:
  /// Splits within a budget. Coarse pieces inherit the remaining visits, in proportion to those that they are expected
  /// to take: however deep they are nested, a patch takes no more than its budget.
  void splitWithin(int64_t visits, uint32_t patch, const UvRect& rect, int depth, const Known* known,
                   std::vector<SubPatch>& out);

  /// The latest enclosing piece that was four times as long.
  struct Shrunk {
    float edgeLengths = HUGE_VALF;
    int depth = 0;
  };

  /// What decides whether a piece is halved.
  struct Measured {
    PatchSize size;
    float edgeLengths;  ///< Sum of the lengths along u and along v.
    Bound3 bare;        ///< Box in camera space before displacement.
    Bound3 bound;       ///< The same after displacement.
    bool crossesEye;
    int nu, nv;      ///< Cells that the rate asks for.
    float reach_px;  ///< Distance by which the hider may push its border out.
  };
  /// Returns nothing for a piece that cannot be seen. `known` may be null.
  std::optional<Measured> measured(uint32_t patch, const UvRect& rect, int depth, const Known* known);
  SubPatch pieceOf(uint32_t patch, const UvRect& rect, int depth, const Measured& m) const;
  SubPatch oneCellOf(uint32_t patch, const UvRect& rect, int depth, const Measured& m) const;

  /// Takes a piece, or halves it. `known` may be null.
  void split(uint32_t patch, const UvRect& rect, int depth, Shrunk from, const Known* known,
             std::vector<SubPatch>& out);

  /// Tells whether the number of grids of a piece can be estimated, because halving shrinks it and its bound as it
  /// should. The piece may then stay coarse until a bucket needs it.
  bool isEstimable(const Measured& m) const;

  /// Takes a piece that one grid can hold.
  void takeGrid(uint32_t patch, const UvRect& rect, int depth, const Measured& m, std::vector<SubPatch>& out);

  /// Takes a flat piece that floats cannot divide as one cell, however large it is in the picture. It must not reach
  /// through the eye plane.
  void takeSmallest(uint32_t patch, const UvRect& rect, int depth, const Measured& m, std::vector<SubPatch>& out);

  /// Cuts a long and narrow piece, which would otherwise be diced as a whole for its visible end. Its measured size is
  /// used for the parts.
  void cutAcross(uint32_t patch, const UvRect& rect, int depth, int nu, int nv, std::vector<SubPatch>& out);

  SubPatch roundPiece(uint32_t patch, const UvRect& rect, const Bound2& raster, float zMin) const;
  bool isStill() const { return object_.keyTimes.size() == 1; }
  bool stopped() const { return stop_.requested(); }

  const Object& object_;
  const int index_, gridSize_;
  const int longest_;  ///< Greatest number of cells in a row.
  const Camera& camera_;
  Stats& stats_;
  const bool lazily_;
  const StopToken stop_;
  const float edge_px_;
  const ObjectView view_;
  const Visits visits_;
  int start_ = 0;                      ///< Depth of the piece that is being split.
  int64_t budget_ = 0;                 ///< Number of pieces that may still be visited.
  bool flat_ = false, alone_ = false;  ///< Results of isFlat() and isAlone() for the current patch.
  GivenUp givenUp_;
};

}  // namespace tomales
