#include "reyes/app/commands/completion.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace tomales {
namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : " ") + w;
  return out;
}

std::vector<std::string> namesOf(const CLI::Option& option) {
  std::vector<std::string> out;
  for (const std::string& n : option.get_snames()) out.push_back("-" + n);
  for (const std::string& n : option.get_lnames()) out.push_back("--" + n);
  return out;
}

/// Returns the words that an option takes, from a type of the form "y|z"; none if the type has another form.
std::vector<std::string> choicesOf(const CLI::Option& option) {
  std::string type = option.get_type_name();
  type.resize(std::min(type.find(':'), type.size()));  // CLI11 adds what its own checks say
  const auto isOfWord = [](char c) { return std::islower(static_cast<unsigned char>(c)) || c == '|' || c == '-'; };
  std::vector<std::string> out;
  if (type.find('|') == std::string::npos || !std::all_of(type.begin(), type.end(), isOfWord)) return out;
  std::istringstream words(type);
  for (std::string word; std::getline(words, word, '|');) out.push_back(word);
  return out;
}

/// Adds a case to the script for each option of the command that takes one of a few words, and one for all its options.
void addCommand(const CLI::App& command, std::string& choices, std::string& options) {
  std::vector<std::string> all;
  for (const CLI::Option* o : command.get_options()) {
    const std::vector<std::string> names = namesOf(*o), words = choicesOf(*o);
    all.insert(all.end(), names.begin(), names.end());
    if (words.empty()) continue;
    for (const std::string& n : names)
      choices += "    '" + command.get_name() + " " + n + "') words='" + listed(words) + "' ;;\n";
  }
  options += "    " + command.get_name() + ") words='" + listed(all) + "' ;;\n";
}

}  // namespace

std::string completionScript(const CLI::App& program) {
  std::vector<std::string> commands;
  std::string choices, options, cases;
  for (const CLI::App* c : program.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(c->get_name());
    cases += (cases.empty() ? "" : "|") + c->get_name();
    addCommand(*c, choices, options);
  }
  return "# Completion of tomales in bash, made by `tomales completion`.\n"
         "_tomales() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=render words=\n"
         "  case ${COMP_WORDS[1]} in " +
         cases +
         ") [ \"$COMP_CWORD\" -gt 1 ] && command=${COMP_WORDS[1]} ;; esac\n"
         "  case \"$command $before\" in\n" +
         choices +
         "  esac\n"
         "  if [ -z \"$words\" ] && [ \"$COMP_CWORD\" -eq 1 ] && [[ $word != -* ]]; then\n"
         "    words='" +
         listed(commands) +
         "'\n"
         "  elif [ -z \"$words\" ] && [[ $word == -* ]]; then\n"
         "    case $command in\n" +
         options +
         "    esac\n"
         "  fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "}\n"
         "complete -o default -F _tomales tomales\n";
}

}  // namespace tomales
