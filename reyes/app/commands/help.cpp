#include "reyes/app/commands/help.h"

#include <sstream>
#include <string_view>

namespace tomales {
namespace {

struct Group {
  const char* name;
  const char* options;  ///< Each has a blank before and after it.
  bool common = true;   ///< True if --help shows it; --help-all shows all.
};
constexpr Group kGroups[] = {
    {"Picture", " -o --format --frames --crop --pixel-samples --shading-rate --draft "},
    {"Light", " --gi --samples --bounces --irradiance "},
    {"Scene", " --edit --shaders --plugin-path --allow-plugins --allow-system "},
    {"Run", " -t --progress --stats -q -v --resume --memory-limit --json -h --help --help-all "},
    {"Picture, in detail", " --one-picture --overwrite --skip-finished --seed --bucket-size --preview --pixel ", false},
    {"Light, in detail",
     " --target-error --target-smudges --time-budget --pilot-frames --animation-settings --audit-every --max-error "
     "--error-function --indirect-only --light-samples --light-seed "
     "--photons --photon-noise "
     "--atlas-direct --atlas "
     "--radiosity-texels --radiosity-maps --brick-cache --brick-maxerror --geometry-cache --ray-geometry --no-hit-list "
     "--specular --arealight --irradiance-append --baked ",
     false},
};
constexpr Group kRest{"More", "", false};

/// Commands with at least this many options show only the common ones.
constexpr size_t kMany = 20;

struct Example {
  const char* command;
  const char* lines;
};
constexpr Example kExamples[] = {
    {"render",
     "  tomales scene.rib                          the pictures that the scene names\n"
     "  tomales scene.rib -o look.png --draft      a quick look\n"
     "  tomales scene.rib --frames 1-24 -o f.####.exr --progress"},
    {"hide", "  tomales hide scene.rib -o shot.dfb         then: tomales shade shot.dfb -o shot.exr"},
    {"prepare",
     "  tomales prepare scene.rib --gi atlas --atlas maps         then: tomales scene.rib --gi atlas --atlas maps"},
    {"gather", "  tomales gather shot.dfb -o shot.icf        then: tomales shade shot.dfb --irradiance shot.icf"},
    {"shade", "  tomales shade shot.dfb --edit brighter.rib -o shot.exr"},
    {"relight",
     "  tomales relight shot.dfb --irradiance shot.icf\n"
     "  tomales relight scene.rib --folder edits                  hidden and gathered first"},
    {"batch",
     "  tomales batch shot.rib --frames 1-24 -o f.####.exr        here, or with --engine slurm on a cluster\n"
     "  tomales batch status shot.batch"},
    {"info",
     "  tomales info scene.rib                     frames, and which files and shaders are missing\n"
     "  tomales info plastic                       a shader and its parameters\n"
     "  tomales info shot.exr --json"},
    {"list",
     "  tomales list lights\n"
     "  tomales list shaders --json"},
    {"compare", "  tomales compare new.exr reference.exr --diff difference.png"},
    {"chart", "  tomales chart scene.rib -o chart.html --budget 10m"},
    {"catrib", "  tomales catrib scene.rib --binary --gzip -o small.rib"},
    {"import",
     "  tomales import model.glb -o scene.rib      then: tomales scene.rib\n"
     "  tomales import cage.obj -o smooth.rib --subdivide"},
    {"requests", "  tomales requests"},
    {"completion", "  tomales completion > ~/.local/share/bash-completion/completions/tomales"},
    {"compile", "  tomales compile marble.sl                  says what is wrong with it"},
    {"shadetest", "  tomales shadetest marble.sl Kd=.5 -o marble.png"},
    {"photons", "  tomales photons scene.rib -o photons       then: tomales irradiance photons -o points"},
    {"join", "  tomales join tile_*.exr -o frame.exr"},
    {"denoise", "  tomales denoise a.exr b.exr -o clean.exr   a and b: rendered with --light-seed 1 and 2"},
    {"irradiance", "  tomales irradiance photons -o points       then: tomales brickmake points -o bricks"},
    {"brickmake", "  tomales brickmake points -o bricks         then: tomales scene.rib --gi atlas --atlas bricks"},
    {"view", "  tomales view points/room.ptc -o points.png --camera scene.rib"},
    {"convert", "  tomales convert points.ptc points.ply"},
};

bool names(std::string_view list, const CLI::Option& option) {
  const auto isThere = [&](const std::string& name) { return list.find(" " + name + " ") != std::string_view::npos; };
  for (const std::string& n : option.get_lnames())
    if (isThere("--" + n)) return true;
  for (const std::string& n : option.get_snames())
    if (isThere("-" + n)) return true;
  return false;
}

const Group& groupOf(const CLI::Option& option) {
  for (const Group& g : kGroups)
    if (names(g.options, option)) return g;
  return kRest;
}

/// Wraps the text into lines shorter than `width`, and indents all but the first.
std::string wrapped(const std::string& text, size_t indent, size_t width) {
  std::istringstream words(text);
  std::string out;
  size_t column = indent;
  for (std::string word; words >> word;) {
    if (!out.empty() && column + 1 + word.size() > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!out.empty()) {
      out += ' ';
      ++column;
    }
    out += word;
    column += word.size();
  }
  return out;
}

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat() { column_width(34); }

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    const bool many = app->get_parent() && app->get_options().size() >= kMany;
    std::string out = wrapped(app->get_description(), 0, kWidth) + "\n" + make_usage(app, name);
    if (many && mode == CLI::AppFormatMode::Normal) out += "(--help-all shows all options)\n";
    out += make_positionals(app);
    for (const Group& g : kGroups)
      if (!many || g.common || mode != CLI::AppFormatMode::Normal) out += group(*app, g);
    if (!many || mode != CLI::AppFormatMode::Normal) out += group(*app, kRest);
    out += make_subcommands(app, CLI::AppFormatMode::Normal);
    return out + "\n" + make_footer(app);
  }

  std::string make_option(const CLI::Option* option, bool isPositional) const override {
    const std::string head = "  " + make_option_name(option, isPositional) + make_option_opts(option);
    const size_t column = get_column_width();
    const std::string gap =
        head.size() + 1 < column ? std::string(column - head.size(), ' ') : "\n" + std::string(column, ' ');
    return head + gap + wrapped(make_option_desc(option), column, kWidth) + "\n";
  }

  std::string make_subcommand(const CLI::App* command) const override {
    constexpr size_t kColumn = 14;
    const std::string head = "  " + command->get_name();
    return head + std::string(kColumn - std::min(kColumn, head.size()), ' ') +
           wrapped(command->get_description(), kColumn, kWidth) + "\n";
  }

 private:
  static constexpr size_t kWidth = 110;

  std::string group(const CLI::App& app, const Group& g) const {
    const std::vector<const CLI::Option*> options =
        app.get_options([&](const CLI::Option* o) { return o->nonpositional() && o->get_group() == g.name; });
    return options.empty() ? "" : make_group(g.name, false, options);
  }
};

}  // namespace

void setHelp(CLI::App& program) {
  program.formatter(std::make_shared<HelpFormat>());
  program.set_help_all_flag("--help-all", "All options");
}

void finishHelp(CLI::App& program) {
  const auto sort = [](CLI::App& app) {
    for (CLI::Option* o : app.get_options()) o->group(groupOf(*o).name);
  };
  sort(program);
  for (CLI::App* command : program.get_subcommands({})) {
    sort(*command);
    for (const Example& e : kExamples)
      if (command->get_name() == e.command) command->footer(std::string("Examples:\n") + e.lines);
  }
}

}  // namespace tomales
