#include "app/completion.h"

#include <CLI/CLI.hpp>

namespace onestroke {
namespace {

// ':' parts words in bash, so what follows "file:" is a word of its own; it is a file's name.
constexpr const char* values = R"(  case "$prev" in
    --camera | --second-camera) COMPREPLY=($(compgen -W "synthetic file: folder:" -- "$cur")); return ;;
    --display) COMPREPLY=($(compgen -W "window openxr offscreen:" -- "$cur")); return ;;
    --world) COMPREPLY=($(compgen -W "auto camera alpha additive passthrough" -- "$cur")); return ;;
    --mode) COMPREPLY=($(compgen -W "exposure fresh" -- "$cur")); return ;;
    --completion) COMPREPLY=($(compgen -W "bash" -- "$cur")); return ;;
    --overlay) COMPREPLY=($(compgen -d -- "$cur")); return ;;
    --catalog | --calibration | --rig | --output | --log | --replay | --head-camera | --head-poses | :) COMPREPLY=($(compgen -f -- "${cur#:}")); return ;;
  esac
)";

std::string words_after(const CLI::App& command) {
  std::string words;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
    words += sub->get_name() + " ";
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) words += "--" + name + " ";
  words.pop_back();
  return words;
}

void add_cases(const CLI::App& command, const std::string& path, std::string& cases) {
  cases += "    \"" + path + "\") words=\"" + words_after(command) + "\" ;;\n";
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
    add_cases(*sub, path + " " + sub->get_name(), cases);
}

void collect_commands(const CLI::App& command, std::string& commands) {
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) {
    commands += (commands.empty() ? "" : " | ") + sub->get_name();
    collect_commands(*sub, commands);
  }
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  const std::string& name = program.get_name();
  std::string cases, commands;
  add_cases(program, name, cases);
  collect_commands(program, commands);
  return "# bash completion of " + name + "\n_" + name + "() {\n" +
         "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} path=" + name + " words= word\n" +
         values + "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n    case \"$word\" in\n      " + commands +
         ") path+=\" $word\" ;;\n    esac\n  done\n  case \"$path\" in\n" + cases +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
         "  [[ $path == \"" +
         name +
         " marker import\" && $cur != -* ]] && COMPREPLY+=($(compgen -f -- \"$cur\"))\n}\ncomplete -o filenames -F _" +
         name + " " + name + "\n";
}

}  // namespace onestroke
