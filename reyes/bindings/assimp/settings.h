// What `tomales import` asks of the program that reads models (docs/decisions/0140). Threads: plain data.
#pragma once
#include <string>
#include <vector>

#include "reyes/base/log.h"

namespace tomales::model {

struct Settings {
  std::string model;          ///< The file to read.
  std::string scene;          ///< The RIB file to write.
  std::string parts;          ///< Folder to write what the RIB names: archives of geometry, pictures.
  std::string partsByName;    ///< What the RIB calls that folder; its archives and pictures lie there in the end.
  bool subdivide = false;     ///< Polygons are the cages of subdivision surfaces.
  float smooth_degrees = 45;  ///< Where a model has no normals, faces that meet at less look smooth.
  std::string up;             ///< "y" or "z": the axis that points up; empty: as files of this kind have it.
  float lightScale = 0;       ///< Multiplies the model's lights; 0: so that they light the picture.
  std::string camera;         ///< Name of the model's camera to look through; empty: the first.
};

/// CPU time after which the program is ended: many times what Assimp takes to read a model of that size, where it ends.
int mostSeconds(const Settings& settings);

/// The program's exit code, by the worst that it has reported; other codes are those of an accident.
constexpr int kFirstAnswer = 10;
constexpr int answerOf(Severity worst) { return kFirstAnswer + static_cast<int>(worst); }

/// For the program's command line, and back: unknown words are left out.
std::vector<std::string> argumentsOf(const Settings& settings);
Settings settingsOf(const std::vector<std::string>& arguments);

}  // namespace tomales::model
