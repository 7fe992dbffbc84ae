// The commands of the command line, their options, and the places where these are kept.
#pragma once
#include "reyes/app/batch/batch.h"
#include "reyes/app/chart/chart.h"
#include "reyes/app/commands/atlas_commands.h"
#include "reyes/app/commands/catrib.h"
#include "reyes/app/commands/compile.h"
#include "reyes/app/commands/import.h"
#include "reyes/app/commands/info.h"
#include "reyes/app/commands/join.h"
#include "reyes/app/commands/options.h"
#include "reyes/app/commands/render.h"
#include "reyes/app/commands/shadetest.h"
#include "reyes/app/denoise/command.h"
#include "reyes/app/relight/relight.h"

namespace tomales {

/// Everything that the arguments may fill.
struct Invocation {
  RenderSettings render;
  CatribSettings catrib;
  model::Settings import;
  ShadetestCommand shadetest;
  CompileCommand compile;
  IrradianceCommand irradiance;
  BrickmakeCommand brickmake;
  ViewCommand view;
  ConvertCommand convert;
  ChartSettings chart;
  BatchCommand batch;
  PrepareCommand prepare;
  RelightCommand relight;
  bool stability = false;
  std::string first, second, difference;
  InfoCommand info;
  JoinCommand join;
  DenoiseCommand denoise;
  bool json = false;
};

/// Each adds its commands to `app`. Parsing runs the command that is named, which sets `code` to its exit code.
void addFrameCommands(CLI::App& app, Invocation& in, int& code);  ///< render, hide, gather, shade, batch, chart
/// Adds commands for scenes, shaders, models and pictures as files.
void addFileCommands(CLI::App& app, Invocation& in, int& code);
/// Adds commands for photons, point clouds and brick maps.
void addAtlasCommands(CLI::App& app, Invocation& in, int& code);

}  // namespace tomales
