// The settings that `tomales import` gives to the program that reads models (docs/decisions/0140). Threads: plain data.
#pragma once
#include <string>
#include <vector>

#include "reyes/base/log.h"

namespace tomales::model {

struct Settings {
  std::string model;          ///< The file to read.
  std::string scene;          ///< The RIB file to write.
  std::string parts;          ///< Folder for the files that the RIB names: archives of geometry, pictures.
  std::string partsByName;    ///< Name of that folder in the RIB; its archives and pictures lie there in the end.
  bool subdivide = false;     ///< Polygons are the cages of subdivision surfaces.
  float smooth_degrees = 45;  ///< Angle between faces below which their edge looks smooth, if the model has no normals.
  std::string up;             ///< "y" or "z": the axis that points up; empty: the usual one of the format.
  float lightScale = 0;       ///< Multiplies the model's lights; 0: a factor is chosen that suits the picture.
  std::string camera;         ///< Name of the model's camera to look through; empty: the first.
};

/// Returns the CPU time after which the program is ended. It is many times what Assimp needs for a model of that size.
int mostSeconds(const Settings& settings);

/// The program's exit code, from the worst severity that it has reported; other codes mean a crash.
constexpr int kFirstAnswer = 10;
constexpr int answerOf(Severity worst) { return kFirstAnswer + static_cast<int>(worst); }

/// Convert to words of the program's command line, and back. Unknown words are left out.
std::vector<std::string> argumentsOf(const Settings& settings);
Settings settingsOf(const std::vector<std::string>& arguments);

}  // namespace tomales::model
