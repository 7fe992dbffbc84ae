// Option "searchpath" and "dirmap".
#pragma once
#include <array>
#include <string>
#include <vector>

namespace tomales::rib {

/// The most bytes of a search path. Without it, a path that contains its previous value could double with every line,
/// and each of its folders is searched for each file.
constexpr size_t kLongestSearchPath = 1 << 16;

/// Turns a search path as written into folders with colons between. `&` is the previous value, `@` the built-in one
/// (which is searched anyway, so it becomes nothing); $NAME, ${NAME} and a leading ~ come from the environment.
/// Variables that are not set are appended to `unset`. A result that exceeds kLongestSearchPath is cut there, which its
/// length shows.
std::string expandSearchPath(const std::string& written, const std::string& previous, std::string& unset);

/// Entries of zone, from, to. Only the zone "NFS", which is Unix, applies here.
using DirMap = std::vector<std::array<std::string, 3>>;
/// Reads an array of triples, or one string of the form ["zone" "from" "to"] ["zone" ...].
DirMap readDirMap(const std::vector<std::string>& written);
/// Returns the name with its beginning replaced by the first entry that fits.
std::string mapped(const std::string& name, const DirMap& map);

/// Maps each folder of a search path. A result that exceeds kLongestSearchPath is cut there, as by expandSearchPath().
std::string mappedPath(const std::string& path, const DirMap& map);

}  // namespace tomales::rib
