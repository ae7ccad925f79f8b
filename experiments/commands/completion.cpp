#include <fmt/ranges.h>

#include "commands/commands.h"
#include "cones/cone_solvers.h"
#include "harness/judges.h"
#include "scenes/choices.h"

namespace pbdcheck {
namespace {

constexpr const char* bash_script = R"bash(# bash completion of pbdcheck:  source <(pbdcheck completion bash)
_pbdcheck() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} program=${COMP_WORDS[0]} words=""
  COMPREPLY=()
  case $previous in
    -o|--output) COMPREPLY=($(compgen -d -- "$word")); return ;;
    --tier) words="quick full" ;;
    --export) words="vtk" ;;
    --law) words="@LAWS@" ;;
    --relaxation) words="@SOLVERS@" ;;
    --reference) words="@REFERENCES@" ;;
    *)
      if ((COMP_CWORD == 1)); then
        words="list simulate compare advise run verify bless cone completion --help --version"
      else
        case ${COMP_WORDS[1]} in
          list) words="@KINDS@ --json --help" ;;
          completion) words="bash" ;;
          simulate) words="--set --output --export --check --judge --help" ;;
          compare) words="--set --method --reference --at-step --until --output --help" ;;
          advise) words="--set --error --seconds --json --help" ;;
          cone) words="--law --relaxation --tolerance --json --output --help" ;;
          verify) words="--only --tier --threads --resume --json --junit --output --help" ;;
          run) words="--all --tier --threads --resume --output --help
                      $("$program" list experiments 2>/dev/null | cut -d' ' -f1)" ;;
        esac
        case ${COMP_WORDS[1]} in
          cone) COMPREPLY=($(compgen -f -- "$word")) ;;
          simulate|compare|advise) COMPREPLY=($(compgen -f -X '!*.toml' -- "$word") $(compgen -d -S / -- "$word")) ;;
        esac
      fi ;;
  esac
  COMPREPLY+=($(compgen -W "$words" -- "$word"))
}
complete -F _pbdcheck pbdcheck
)bash";

}  // namespace

int completion(const std::string& shell) {
  require_name("completion", shell, std::vector<std::string>{"bash"});
  std::string script = bash_script;
  const auto fill = [&](const std::string& placeholder, const std::vector<std::string>& words) {
    script.replace(script.find(placeholder), placeholder.size(), fmt::format("{}", fmt::join(words, " ")));
  };
  fill("@KINDS@", list_kinds());
  fill("@REFERENCES@", all_reference_names());
  fill("@LAWS@", cone_laws());
  std::vector<std::string> solvers;
  for (const auto& solver : cone_solvers()) solvers.push_back(solver.name);
  fill("@SOLVERS@", solvers);
  fmt::print("{}", script);
  return exit_done;
}

}  // namespace pbdcheck
