// Option "searchpath" and "dirmap".
#pragma once
#include <array>
#include <string>
#include <vector>

namespace tomales::rib {

/// In bytes. A path that holds its previous value could else double with every line, and each of its folders
/// is asked for each file.
constexpr size_t kLongestSearchPath = 1 << 16;

/// A search path as written -> folders with colons between. `&` is the previous value, `@` the built-in one
/// (searched anyway, so it becomes nothing); $NAME, ${NAME} and a leading ~ come from the environment.
/// Variables that are not set are appended to `unset`. Longer than kLongestSearchPath: only its beginning,
/// which is longer, too.
std::string expandSearchPath(const std::string& written, const std::string& previous, std::string& unset);

/// Zone, from, to. Only the zone "NFS", that of Unix, applies here.
using DirMap = std::vector<std::array<std::string, 3>>;
/// Of an array of triples, or of one string of the form ["zone" "from" "to"] ["zone" ...].
DirMap readDirMap(const std::vector<std::string>& written);
/// The name with its beginning replaced by the first entry that fits.
std::string mapped(const std::string& name, const DirMap& map);

/// The same for each folder of a search path, and as long as that may be.
std::string mappedPath(const std::string& path, const DirMap& map);

}  // namespace tomales::rib
