#include "reyes/prim/subdivision_tags.h"

#include <fmt/format.h>

#include <span>

namespace tomales {
namespace {

struct Tag {
  const std::string& name;
  std::span<const int> ints;
  std::span<const float> floats;
  std::span<const std::string> strings;
};

class TagReader {
 public:
  TagReader(const EdgeFaces& edges, int faceCount, int vertexCount, Problems& problems)
      : edges_(edges), faceCount_(faceCount), vertexCount_(vertexCount), problems_(problems) {}

  void read(const Tag& tag) {
    if (tag.name == "crease") return readCrease(tag);
    if (tag.name == "corner") return readCorners(tag);
    if (tag.name == "hole") return readHoles(tag);
    if (tag.name == "interpolateboundary") return readBoundary(tag);
    if (tag.name == "facevaryinginterpolateboundary") return readFaceVaryingBoundary(tag);
    if (tag.name == "facevaryingpropagatecorners") {
      out.propagateCorners = !tag.ints.empty() && tag.ints[0] != 0;
      return;
    }
    if (tag.name == "smoothtriangles") return readSmoothTriangles(tag);
    if (tag.name == "creasemethod") return readCreaseMethod(tag);
    if (tag.name == "vertexedit" || tag.name == "edgeedit" || tag.name == "faceedit")
      return problems_.push_back(fmt::format(
          "\"{}\" [{}] \"{}\": hierarchical edits are not applied, OpenSubdiv 3 has none; the surface is that of the "
          "coarse mesh there",
          tag.name, fmt::join(tag.ints, " "), fmt::join(tag.strings, "\" \"")));
    problems_.push_back(fmt::format("tag \"{}\" is not supported; it was ignored", tag.name));
  }

  MeshTags out;

 private:
  /// Tells whether the tag has one sharpness for all, or one for each of `count`.
  bool sharpnessFits(const Tag& tag, size_t count) {
    const bool fits = tag.floats.size() == 1 || (count > 0 && tag.floats.size() == count);
    if (!fits)
      problems_.push_back(fmt::format("tag \"{}\" has {} sharpnesses for {} elements; it was ignored", tag.name,
                                      tag.floats.size(), count));
    return fits;
  }
  static float sharpness(const Tag& tag, size_t k) {
    const float given = tag.floats[tag.floats.size() == 1 ? 0 : k];
    return given > 0 ? std::min(given, 10.0f) : 0.0f;  // 10 is infinitely sharp; NaN counts as smooth
  }

  void readCrease(const Tag& tag) {
    if (tag.ints.size() < 2) return problems_.push_back("tag \"crease\" names fewer than two vertices; it was ignored");
    if (!sharpnessFits(tag, tag.ints.size() - 1)) return;
    for (size_t k = 0; k + 1 < tag.ints.size(); ++k) {
      const int a = tag.ints[k], b = tag.ints[k + 1];
      if (a < 0 || b < 0 || edges_.count(a, b) == 0) {
        problems_.push_back(
            fmt::format("tag \"crease\": no edge joins vertices {} and {}; that edge was ignored", a, b));
        continue;
      }
      out.creaseEdges.insert(out.creaseEdges.end(), {a, b});
      out.creaseSharpness.push_back(sharpness(tag, k));
    }
  }

  void readCorners(const Tag& tag) {
    if (!sharpnessFits(tag, tag.ints.size())) return;
    for (size_t k = 0; k < tag.ints.size(); ++k) {
      if (!inRange(tag, k, vertexCount_, "vertex")) continue;
      out.corners.push_back(tag.ints[k]);
      out.cornerSharpness.push_back(sharpness(tag, k));
    }
  }

  void readHoles(const Tag& tag) {
    for (size_t k = 0; k < tag.ints.size(); ++k)
      if (inRange(tag, k, faceCount_, "face")) out.holes.push_back(tag.ints[k]);
  }

  bool inRange(const Tag& tag, size_t k, int count, const char* what) {
    if (tag.ints[k] >= 0 && tag.ints[k] < count) return true;
    problems_.push_back(fmt::format("tag \"{}\": there is no {} {}; it was ignored", tag.name, what, tag.ints[k]));
    return false;
  }

  /// Returns the argument of a tag that has one: 1 if it is missing, -1 (with a sentence) if it is out of range.
  int choice(const Tag& tag, int highest) {
    const int given = tag.ints.empty() ? 1 : tag.ints[0];
    if (given >= 0 && given <= highest) return given;
    problems_.push_back(fmt::format("tag \"{}\" has no value {}; it was ignored", tag.name, given));
    return -1;
  }

  void readBoundary(const Tag& tag) {
    using B = MeshTags::Boundary;
    static constexpr B kMeaning[] = {B::None, B::EdgeAndCorner, B::EdgeOnly};
    if (const int k = choice(tag, 2); k >= 0) out.boundary = kMeaning[k];
  }

  void readFaceVaryingBoundary(const Tag& tag) {
    using B = MeshTags::FaceVaryingBoundary;
    static constexpr B kMeaning[] = {B::Linear, B::EdgeAndCorner, B::EdgeOnly, B::AlwaysSharp};
    if (const int k = choice(tag, 3); k >= 0) out.faceVarying = kMeaning[k];
  }

  /// With the argument 1 triangles have the weights of other faces, with 2 their own.
  void readSmoothTriangles(const Tag& tag) {
    if (const int k = choice(tag, 2); k >= 0) out.smoothTriangles = k == 2;
  }

  void readCreaseMethod(const Tag& tag) {
    const std::string method = tag.strings.empty() ? "" : tag.strings[0];
    if (method != "normal" && method != "chaikin")
      return problems_.push_back(fmt::format("tag \"creasemethod\" has no method \"{}\"; it was ignored", method));
    out.chaikin = method == "chaikin";
  }

  const EdgeFaces& edges_;
  const int faceCount_, vertexCount_;
  Problems& problems_;
};

}  // namespace

MeshTags readTags(const SubdivisionTags& tags, const EdgeFaces& edges, int faceCount, int vertexCount,
                  Problems& problems) {
  if (tags.argCounts.size() != 3 * tags.names.size())
    throw PrimError(fmt::format("{} tags need {} argument counts and {} are given", tags.names.size(),
                                3 * tags.names.size(), tags.argCounts.size()));
  TagReader reader(edges, faceCount, vertexCount, problems);
  std::span<const int> ints(tags.ints);
  std::span<const float> floats(tags.floats);
  std::span<const std::string> strings(tags.strings);
  const auto take = [&](auto& from, int count, const std::string& name) {
    if (count < 0 || static_cast<size_t>(count) > from.size())
      throw PrimError(fmt::format("tag \"{}\" asks for {} arguments where {} are left", name, count, from.size()));
    const auto taken = from.first(static_cast<size_t>(count));
    from = from.subspan(static_cast<size_t>(count));
    return taken;
  };
  for (size_t t = 0; t < tags.names.size(); ++t) {
    const std::string& name = tags.names[t];
    const int* counts = &tags.argCounts[3 * t];
    const auto theInts = take(ints, counts[0], name);
    const auto theFloats = take(floats, counts[1], name);
    reader.read({name, theInts, theFloats, take(strings, counts[2], name)});
  }
  return std::move(reader.out);
}

}  // namespace tomales
