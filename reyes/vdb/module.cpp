// The module over OpenVDB: only this file includes that library.
#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <fstream>
#include <mutex>

#include "reyes/vdb/module.h"

namespace tomales {
namespace {

namespace vdb = openvdb;

/// A grid of more than this would not fit into the memory of most machines.
constexpr double kMostBytes = 16e9;

/// An error with a sentence for the user, without the library's own prefixes.
struct VdbProblem : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the name without the suffix that states the class of the grid.
std::string withoutClass(const std::string& name, vdb::GridClass& given) {
  const auto ends = [&](const char* with) { return name.ends_with(with); };
  if (ends(":fogvolume")) given = vdb::GRID_FOG_VOLUME;
  if (ends(":levelset")) given = vdb::GRID_LEVEL_SET;
  return given == vdb::GRID_UNKNOWN ? name : name.substr(0, name.rfind(':'));
}

std::string namesIn(const vdb::io::File& file) {
  std::vector<std::string> names;
  for (auto name = file.beginName(); name != file.endName(); ++name) names.push_back("\"" + name.gridName() + "\"");
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

/// The library reads zeros where a file ends too early, so this checks the lengths that the file states. The layout is
/// of version 222 and later, which OpenVDB has written since 2013.
void throwIfCut(const std::string& path) {
  constexpr uint32_t kLeastVersion = 222;
  constexpr std::streamoff kMagicBytes = 8, kLibraryBytes = 8, kOffsetsAndUuidBytes = 1 + 36;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const int64_t bytes = in.tellg();
  in.seekg(kMagicBytes);
  uint32_t version = 0, grids = 0;
  in.read(reinterpret_cast<char*>(&version), sizeof version);
  if (version < kLeastVersion) return;
  vdb::io::setVersion(in, {vdb::OPENVDB_LIBRARY_MAJOR_VERSION, vdb::OPENVDB_LIBRARY_MINOR_VERSION}, version);
  in.seekg(kLibraryBytes + kOffsetsAndUuidBytes, std::ios::cur);
  vdb::MetaMap ignored;
  ignored.readMeta(in);
  in.read(reinterpret_cast<char*>(&grids), sizeof grids);
  for (uint32_t k = 0; k < grids && in; ++k) {
    vdb::io::GridDescriptor grid;
    grid.read(in);
    if (grid.getEndPos() > bytes)
      throw VdbProblem(fmt::format("it ends too early: of {} bytes {} are missing", int64_t{grid.getEndPos()},
                                   int64_t{grid.getEndPos()} - bytes));
    in.seekg(grid.getEndPos());
  }
  if (!in) throw VdbProblem("it ends too early");
}

vdb::FloatGrid::Ptr gridOf(const std::string& path, const std::string& name) {
  static std::once_flag once;
  std::call_once(once, [] { vdb::initialize(); });
  throwIfCut(path);
  vdb::io::File file(path);
  file.open(false);  // the file may change while we work
  if (!file.hasGrid(name)) throw VdbProblem(fmt::format("it has no grid \"{}\", but {}", name, namesIn(file)));
  const vdb::GridBase::Ptr grid = file.readGrid(name);
  vdb::FloatGrid::Ptr floats = vdb::gridPtrCast<vdb::FloatGrid>(grid);
  if (!floats)
    throw VdbProblem(fmt::format("its grid \"{}\" holds {}, where floats are wanted", name, grid->valueType()));
  if (!floats->transform().isLinear())
    throw VdbProblem(fmt::format("its grid \"{}\" narrows like a camera's view, which is not supported", name));
  return floats;
}

/// OpenVDB's matrices act on rows from the right and are stored by rows: that is glm's storage.
mat4 indexFromObject(const vdb::FloatGrid& grid) {
  const vdb::Mat4d m = grid.transform().baseMap()->getAffineMap()->getMat4().inverse();
  mat4 out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) out[i][j] = static_cast<float>(m(i, j));
  return out;
}

ivec3 pointOf(const vdb::Coord& c) { return {c.x(), c.y(), c.z()}; }

/// Copies active values, including tiles, and the inactive values of leaves.
void fill(const vdb::FloatGrid& grid, DensityGrid& out) {
  static_assert(vdb::FloatTree::LeafNodeType::DIM == DensityGrid::kSide);
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf)
    std::copy_n(leaf->buffer().data(), DensityGrid::kBrickFloats, out.brickAt(pointOf(leaf->origin())));
  auto tile = grid.cbeginValueOn();
  tile.setMaxDepth(vdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    const vdb::CoordBBox box = tile.getBoundingBox();
    for (int x = box.min().x(); x <= box.max().x(); x += DensityGrid::kSide)
      for (int y = box.min().y(); y <= box.max().y(); y += DensityGrid::kSide)
        for (int z = box.min().z(); z <= box.max().z(); z += DensityGrid::kSide)
          std::fill_n(out.brickAt({x, y, z}), DensityGrid::kBrickFloats, *tile);
  }
}

Bound3 meet(const Bound3& a, const Bound3& b) { return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)}; }

std::unique_ptr<DensityGrid> densityOf(vdb::FloatGrid& grid, const Bound3& bound, std::vector<std::string>& notes) {
  const vdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
  if (active.empty()) throw VdbProblem("the grid holds nothing");
  const mat4 toIndex = indexFromObject(grid);
  if (const float volume = glm::determinant(mat3(toIndex)); !(std::abs(volume) > 0 && std::abs(volume) < kInfinity))
    throw VdbProblem("the grid's transformation cannot be used");
  const ivec3 first = pointOf(active.min()), last = pointOf(active.max());
  const double bytes =
      DensityGrid::tableBytes(first, last) + static_cast<double>(grid.activeVoxelCount()) * sizeof(float);
  if (bytes > kMostBytes) throw VdbProblem(fmt::format("the grid would take {:.0f} GB of memory", bytes / 1e9));
  const Bound3 whole = transformBound(glm::inverse(toIndex), {vec3(first) - 1.0f, vec3(last) + 1.0f}),
               seen = meet(whole, bound);
  if (seen.empty())
    throw VdbProblem(fmt::format("the grid lies in [{:g} {:g} {:g} {:g} {:g} {:g}], outside of the bound", whole.lo.x,
                                 whole.hi.x, whole.lo.y, whole.hi.y, whole.lo.z, whole.hi.z));
  auto out = std::make_unique<DensityGrid>(first, last, toIndex, seen);
  fill(grid, *out);
  if (const size_t bad = out->finish(); bad > 0)
    notes.push_back(fmt::format("{} of its values are negative or no numbers: they count as 0", bad));
  return out;
}

std::string withoutPrefix(std::string text) {
  for (const char* prefix : {"IoError: ", "RuntimeError: ", "KeyError: ", "ValueError: "})
    if (text.starts_with(prefix)) return text.substr(std::string_view(prefix).size());
  return text;
}

}  // namespace
}  // namespace tomales

extern "C" __attribute__((visibility("default"))) std::unique_ptr<tomales::DensityGrid> tomalesReadVdb(
    const std::string& path, const std::string& name, const tomales::Bound3& bound, std::vector<std::string>& notes,
    std::string& error) try {
  using namespace tomales;
  vdb::GridClass given = vdb::GRID_UNKNOWN;
  const std::string plain = withoutClass(name, given);
  const vdb::FloatGrid::Ptr grid = gridOf(path, plain);
  if ((given == vdb::GRID_UNKNOWN ? grid->getGridClass() : given) == vdb::GRID_LEVEL_SET)
    vdb::tools::sdfToFogVolume(*grid);
  return densityOf(*grid, bound, notes);
} catch (const std::exception& e) {
  error = tomales::withoutPrefix(e.what());
  return nullptr;
}
