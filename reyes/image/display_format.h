// Private to reyes/image: the file format of a Display.
#pragma once
#include "reyes/image/image_file.h"

namespace tomales {

/// Returns a string parameter of a Display, in lower case; empty if it is not there.
std::string displayText(const DisplayCall& display, const char* name);
/// Reports the parameters that are unknown and ignored.
void warnAboutParams(const DisplayCall& display, Log& log);
/// Reports parameters that a driver has not read, unless the renderer has.
void warnOfUnreadParams(const DisplayCall& display, const std::vector<std::string>& unread, Log& log);
/// Reports a driver that is not used only because it is not trusted.
void warnOfRefusedDriver(const DisplayCall& display, const Options& options, const PluginTrust& trust, Log& log);
/// Decides the file format, and reports parameters of the Display that the format cannot use.
FileFormat formatOf(const DisplayCall& display, Log& log);

}  // namespace tomales
