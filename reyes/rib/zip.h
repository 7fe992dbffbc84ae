// Members of zip files, as RenderMan names them: "models.zip!ball.rib".
#pragma once
#include <functional>
#include <string>

namespace tomales::rib {

/// The file of "models.zip!ball.rib", "models.zip"; other names as they are.
std::string fileOfMember(const std::string& path);

/// The bytes of a member, a part at a time; 0 is the end. What is deflated comes as a gzip member of the same data, so
/// that it is unpacked, checked and limited as one. Empty: `path` names no member of a zip file that can be read (those
/// that are encrypted or need 64-bit sizes cannot).
std::function<size_t(char* buffer, size_t size)> zipMember(const std::string& path);

}  // namespace tomales::rib
