// Private to reyes/image: which file a Display asks for.
#pragma once
#include "reyes/image/image_file.h"

namespace tomales {

/// A string parameter of a Display, in lower case; empty if it is not there.
std::string displayText(const DisplayCall& display, const char* name);
/// Says what of the parameters is unknown, and ignored.
void warnAboutParams(const DisplayCall& display, Log& log);
/// Decides file format, and the name where the Display leaves it open (RISpec's "ri.pic" has a format of no one's).
FileFormat formatOf(const DisplayCall& display, std::string& path, Log& log);

}  // namespace tomales
