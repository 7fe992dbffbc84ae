#include "reyes/app/commands/usage.h"

#include "reyes/app/commands/compare_command.h"
#include "reyes/app/commands/completion.h"
#include "reyes/app/commands/list.h"
#include "reyes/image.h"
#include "reyes/image_files.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

void buildInfo(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand(
      "info",
      "What is in a .rib, .dfb, .icf, picture (" + pictureExtensions() +
          ") or shader .sl or .so file, or of a shader by its name; of a scene, which files and shaders that it needs "
          "are missing");
  c->add_option("FILE", in.info.file, "A file, or the name of a shader")->required();
  c->add_flag("--json", in.info.json, "As JSON");
  addTrust(*c, in.info.trust);
  c->callback([&] { code = infoCommand(in.info); });
}

void buildList(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("list", "What is built in, with parameters, types, defaults and what they are for");
  c->add_option("KIND", in.first, "By default " + listedKinds().front())->check(CLI::IsMember(listedKinds()));
  c->add_flag("--json", in.json, "As JSON");
  c->callback([&] { code = listCommand(in.first.empty() ? listedKinds().front() : in.first, in.json); });
}

void buildCompare(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("compare", "The error of a picture against a reference");
  c->add_option("A", in.first)->required();
  c->add_option("B", in.second, "The reference")->required();
  c->add_flag("--json", in.json, "As JSON");
  addParsed(*c, "--diff", in.difference, parseOutput, pictureNames(), "Write the absolute difference as a picture");
  c->callback([&] { code = compareCommand(in.first, in.second, in.difference, in.json); });
}

void buildJoin(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("join", "Join tiles of one frame into the file that one run would have written");
  addParsed(*c, "-o", in.join.output, parseNamed(".exr"), "FILE.exr", "Write here")->required();
  addParsed(*c, "--crop", in.join.crop, parseCrop, "XMIN,XMAX,YMIN,YMAX",
            "The window of the frame that the tiles make (default: all of it)");
  c->add_option("TILE.exr", in.join.tiles, "OpenEXR pictures of crop windows, in any order")->required();
  c->callback([&] { code = joinCommand(in.join); });
}

void buildDenoise(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("denoise", "A picture without noise of two that differ in --light-seed alone");
  c->add_option("A.exr", in.denoise.first, "Its channels albedo, normal and z guide the filter")->required();
  c->add_option("B.exr", in.denoise.second, "The same frame with another --light-seed")->required();
  addParsed(*c, "-o", in.denoise.output, parseNamed(".exr"), "FILE.exr",
            "Write here: A with the colours of both, filtered")
      ->required();
  c->callback([&] { code = denoiseCommand(in.denoise); });
}

void buildCompile(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("compile", "Check shaders in the RenderMan Shading Language");
  c->add_option("SHADER.sl", in.compile.files)->required();
  c->add_option("-I", in.compile.folders, "Folder of #include; may be given again")
      ->type_name("FOLDER")
      ->expected(1)
      ->take_all();
  c->add_option("-D", in.compile.definitions, "Define a macro; may be given again")
      ->type_name("NAME[=VALUE]")
      ->expected(1)
      ->take_all();
  c->add_option("--dump", in.compile.dump, "Print what a stage makes of the shaders")
      ->check(CLI::IsMember({"tokens", "tree", "types", "lowered", "code"}))
      ->type_name("tokens|tree|types|lowered|code");
  c->add_flag("-q", in.compile.quiet, "No warnings");
  addShaderFolders(*c, in.compile.shaderFolders);
  c->callback([&] { code = compileCommand(in.compile); });
}

void buildShadetest(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("shadetest", "One shader over a grid: time and values");
  c->add_option("SHADER", in.shadetest.shader, "A name, a .sl file, or a plugin .so")->required();
  c->add_option("PARAMETER=VALUE", in.shadetest.parameters, "Of the shader: Kd=.5, color=1,0,0, name=marble");
  c->add_option("-I", in.shadetest.folders, "Folder of #include, for a .sl; may be given again")
      ->type_name("FOLDER")
      ->expected(1)
      ->take_all();
  addShaderFolders(*c, in.shadetest.shaderFolders);
  c->add_flag("--watch", in.shadetest.watch, "Shade again whenever the .sl or what it includes changes");
  addParsed(
      *c, "--grid", in.shadetest.grid, [](const std::string& t) { return parsePair(t, 2, 4096); }, "NxM",
      "Points along u and v (default 64x64)");
  addParsed(*c, "-o", in.shadetest.output, parseOutput, pictureNames(), "Picture of Ci");
  c->add_flag("--check", in.shadetest.check,
              "Check that the shader, or each of the file, does what it declares; exit code 3 if not");
  c->callback([&] { code = shadetestCommand(in.shadetest); });
}

void buildCatrib(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c =
      app.add_subcommand("catrib", "Write RIB files as one file in another encoding; requests stay as they are");
  c->add_option("IN", in.catrib.files, "RIB files of any encoding; - is standard input")->required();
  c->add_option("-o", in.catrib.output, "Write here instead of to standard output")->type_name("FILE.rib");
  c->add_flag("--binary", in.catrib.binary, "Binary RIB instead of ASCII");
  c->add_flag("--gzip", in.catrib.gzip, "Compressed");
  c->callback([&] { code = catribCommand(in.catrib); });
}

void buildImport(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand(
      "import",
      "A model (.obj .ply .gltf .glb .stl .fbx .dae and other kinds that Assimp reads) as a scene with a camera and "
      "lights (docs/import.md)");
  c->add_option("MODEL", in.import.model, "The file of the model")->required();
  addParsed(*c, "-o", in.import.scene, parseNamed(".rib"), "SCENE.rib",
            "Write here, and the files that it names into the folder SCENE_parts beside it")
      ->required();
  c->add_flag("--subdivide", in.import.subdivide, "Polygons are the cages of subdivision surfaces");
  c->add_option("--smooth", in.import.smooth_degrees,
                "Where the model has no normals, faces that meet at less than this angle look smooth (default 45)")
      ->check(CLI::Range(0.0, 180.0))
      ->type_name("DEGREES");
  c->add_option("--up", in.import.up, "Axis of the model that points up (default: z for .stl and .3mf, else y)")
      ->check(CLI::IsMember({"y", "z"}))
      ->type_name("y|z");
  c->add_option("--camera", in.import.camera, "Look through this camera of the model (default: the first)")
      ->type_name("NAME");
  c->add_option(
       "--light-scale", in.import.lightScale,
       "Multiplies the lights of the model (default: chosen so that the picture is neither too dark nor too bright)")
      ->check(between(1e-12, 1e12));
  c->callback([&] { code = importCommand(in.import); });
}

void buildRequests(CLI::App& app) {
  app.add_subcommand("requests",
                     "Every request of RIB with its arguments, for programs that write it (reyes/rib.h:ribRequests)")
      ->callback([] { std::fputs(ribRequests().c_str(), stdout); });
}

void buildCompletion(CLI::App& app) {
  app.add_subcommand("completion", "A script that completes this command line in bash and zsh")->callback([&app] {
    std::fputs(completionScript(app).c_str(), stdout);
  });
}

}  // namespace

void addFileCommands(CLI::App& app, Invocation& in, int& code) {
  buildInfo(app, in, code);
  buildList(app, in, code);
  buildCompare(app, in, code);
  buildDenoise(app, in, code);
  buildJoin(app, in, code);
  buildCompile(app, in, code);
  buildShadetest(app, in, code);
  buildCatrib(app, in, code);
  buildImport(app, in, code);
  buildRequests(app);
  buildCompletion(app);
}

}  // namespace tomales
