// Options of the command line that several commands share.
#pragma once
#include <CLI/CLI.hpp>

#include "reyes/app/settings.h"

namespace tomales {

/// Adds an option whose text must parse: it stores the value or makes the usage error. `range` says what values of this
/// form are allowed, if not all are.
template <class T, class Parse>
CLI::Option* addParsed(CLI::App& app, const std::string& name, T& target, Parse parse, const std::string& form,
                       const std::string& help, const std::string& range = {}) {
  const auto take = [&target, parse, name, form, range](const std::string& text) {
    const auto value = parse(text);
    if (!value) throw CLI::ValidationError(name, "\"" + text + "\" is not of the form " + form + range);
    target = *value;
  };
  return app.add_option_function<std::string>(name, take, help)->type_name(form);
}

/// Accepts a number between two others: CLI::Range lets NaN pass.
CLI::Validator between(double least, double most);

/// Accepts a file of our own formats, by its extension.
inline auto parseNamed(const char* extension) {
  return [extension](const std::string& text) {
    return text.ends_with(extension) && text != extension ? std::optional(text) : std::nullopt;
  };
}

/// Returns the text if it is the name of a picture.
std::optional<std::string> parseOutput(const std::string& text);

/// Refuses `-o -v` and `--stats -o a.exr` for every command: an option stands where a value is missing. A file whose
/// name begins with a dash is given as ./-name.
void refuseOptionsAsValues(CLI::App& app);

void addOutput(CLI::App& app, PictureSettings& s);
void addCrop(CLI::App& app, PictureSettings& s);
void addFrameSize(CLI::App& app, RenderSettings& s);  ///< Options of size, samples and seeds.
void addFramesApart(CLI::App& app, InputSettings& s);
void addPictureOptions(CLI::App& app, RenderSettings& s);  ///< Options of the frame, --crop among them.
void addLightOptions(CLI::App& app, RenderSettings& s);
void addTrust(CLI::App& app, Trust& trust);                  ///< Options that say whose code may run.
void addShaderFolders(CLI::App& app, std::string& folders);  ///< --shaders, which is one of them.
void addRunOptions(CLI::App& app, RenderSettings& s);        ///< Threads, statistics, memory of textures, verbosity.
/// --target-error, --time-budget. Pre: the options of the command that it excludes have been added.
void addTarget(CLI::App& app, QualitySettings& s);
/// Adds the same options for a run that renders several frames.
void addAnimationTarget(CLI::App& app, QualitySettings& s);
void addWatching(CLI::App& app, RenderSettings& s);  ///< --preview, --pixel

}  // namespace tomales
