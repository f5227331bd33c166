// Shell completions for commands and options; anything else completes as a file.

#include "formats.h"
#include "option_table.h"
#include "style/stages/shape.h"

namespace panache::cli {
namespace {

// In single quotes, for POSIX shells and fish, which read '"'"' the same way.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\"'\"'") : std::string(1, c);
  return out + "'";
}

// The names of the verbs of `parent`; those of the program if it is empty.
std::string words_of(const std::vector<VerbEntry>& verbs, const std::string& parent) {
  std::string words;
  for (const VerbEntry& verb : verbs) {
    if (verb.name.empty() || verb.parent() != parent) continue;
    words += (words.empty() ? "" : " ") + verb.word();
  }
  return words;
}

std::string names_of(const std::vector<VerbEntry>& verbs) { return words_of(verbs, "") + " help"; }

// The option names of `verb`: all, or only those that take a value.
std::string options_of(const VerbEntry& verb, bool with_value) {
  std::string out;
  for (const OptionEntry& option : verb.options) {
    if (with_value && option.value.empty()) continue;
    for (const std::string& name : option.names) out += (out.empty() ? "" : " ") + name;
  }
  return out;
}

// The verb as a label in a shell's `case`.
std::string label_of(const VerbEntry& verb) {
  return verb.parent().empty() ? verb.name : quoted(verb.name);
}

// A line of bash and zsh, after `start`: if the two words `words` name a nested verb, sets $verb to
// that.
std::string nested_case(const std::vector<VerbEntry>& verbs, const std::string& start,
                        const std::string& words) {
  std::string labels;
  for (const VerbEntry& verb : verbs) {
    if (!verb.parent().empty()) labels += (labels.empty() ? "" : " | ") + quoted(verb.name);
  }
  if (labels.empty()) return "";
  return start + "case " + words + " in " + labels + ") verb=" + words + " ;; esac\n";
}

// Escapes the text of a message or description for a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

// The command that lists the default model's styles, one a line.
const std::string kListStyles = std::string("panache ") + kPrintReference + " styles 2>/dev/null";

// The possible values of this kind, separated by spaces; empty for files and anything else.
std::string choices_of(const std::string& value) {
  if (value == "AXIS") return "x y z -x -y -z";
  if (value == "LOOP") return "auto on off";
  if (value == "TIMING") return "steps all off";
  std::string out;
  const auto add = [&](const std::string& word) { out += (out.empty() ? "" : " ") + word; };
  if (value == "REGION") {
    for (const char* region : kRegionNames) add(region + std::string("="));
  }
  if (value == "FORMAT") {
    for (const MotionFormat& format : formats()) {
      if (format.write) add(std::string(format.extension).substr(1));
    }
  }
  return out;
}

// The bash lines in a verb's case that complete the values of its options.
std::string bash_choices(const VerbEntry& verb) {
  std::string out;
  for (const OptionEntry& option : verb.options) {
    const std::string choices = choices_of(option.value);
    if (option.is_positional() || (choices.empty() && option.value != "STYLE")) continue;
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : " | ") + name;
    out += "        " + names + ") " +
           (choices.empty() ? "list='" + kListStyles + "'" : "choices='" + choices + "'") + " ;;\n";
  }
  return out.empty() ? "" : "      case $before in\n" + out + "      esac\n";
}

// The zsh action that completes a value of this kind.
std::string zsh_action(const std::string& value) {
  if (value == "STYLE") return "_panache_styles";
  const std::string choices = choices_of(value);
  return choices.empty() ? "_files" : "(" + choices + ")";
}

// The zsh specifications of an option, one per name.
void add_zsh_option(std::string& out, const OptionEntry& option) {
  const std::string value =
      option.value.empty() ? "" : ":" + zsh_text(option.value) + ":" + zsh_action(option.value);
  const std::string begin = " \\\n        ";
  if (option.is_positional()) {
    const std::string count = option.repeated ? "*" : option.required ? "" : ":";
    out += begin + quoted(count + value);
    return;
  }
  for (const std::string& name : option.names) {
    const std::string how = option.value.empty() ? "" : name.starts_with("--") ? "=" : "+";
    out += begin + quoted("*" + name + how + "[" + zsh_text(option.description) + "]" + value);
  }
}

// The start of a fish completion after the verb `name` and none of its nested verbs.
std::string fish_after(const std::vector<VerbEntry>& verbs, const std::string& name) {
  const std::string words = words_of(verbs, name);
  const std::string seen = "__fish_seen_subcommand_from ";
  return "complete -c panache -n '" + seen + name.substr(name.find(' ') + 1) +
         (words.empty() ? "" : "; and not " + seen + words) + "'";
}

}  // namespace

std::string bash_completion(const std::vector<VerbEntry>& verbs) {
  std::string out =
      "# bash completion for panache. Generated from the options of the program.\n"
      "_panache() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} verb=${COMP_WORDS[1]} options values verbs\n"
      "  local before=${COMP_WORDS[COMP_CWORD - 1]} choices list\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    COMPREPLY=($(compgen -W '" +
      names_of(verbs) + " " + options_of(verbs.front(), false) +
      "' -- \"$current\"))\n"
      "    return\n"
      "  fi\n" +
      nested_case(verbs, "  ((COMP_CWORD == 2)) || ", "\"$verb ${COMP_WORDS[2]}\"") +
      "  case $verb in\n"
      "    help)\n"
      "      ((COMP_CWORD > 2)) || COMPREPLY=($(compgen -W '" +
      names_of(verbs) +
      "' -- \"$current\"))\n"
      "      return\n"
      "      ;;\n";
  for (const VerbEntry& verb : verbs) {
    if (verb.name.empty()) continue;
    const std::string words = words_of(verbs, verb.name);
    out += "    " + label_of(verb) + ")\n      options='" + options_of(verb, false) +
           "'\n      values='" + options_of(verb, true) + "'\n";
    if (!words.empty()) out += "      ((COMP_CWORD > 2)) || verbs='" + words + "'\n";
    out += bash_choices(verb) + "      ;;\n";
  }
  // With an empty reply, "-o default" completes file names.
  return out +
         "    *) return ;;\n"
         "  esac\n"
         "  if [[ $choices ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$choices\" -- \"$current\"))\n"
         "  elif [[ $list ]]; then\n"
         "    local IFS=$'\\n'\n"
         "    COMPREPLY=($(compgen -S = -W \"$(eval \"$list\")\" -- \"$current\"))\n"
         "    COMPREPLY=(\"${COMPREPLY[@]// /\\\\ }\")\n"
         "    compopt -o nospace 2>/dev/null\n"
         "  fi\n"
         "  [[ \" $values \" != *\" $before \"* ]] || return\n"
         "  [[ $current != -* ]] || verbs=$options\n"
         "  COMPREPLY=($(compgen -W \"$verbs\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _panache panache\n";
}

std::string zsh_completion(const std::vector<VerbEntry>& verbs) {
  std::string commands;
  std::string cases;
  for (const VerbEntry& verb : verbs) {
    if (verb.name.empty()) continue;
    if (verb.parent().empty()) {
      commands += "    " + quoted(verb.name + ":" + verb.description) + "\n";
    }
    cases += "    " + label_of(verb) + ")\n      _arguments";
    for (const OptionEntry& option : verb.options) add_zsh_option(cases, option);
    const std::string words = words_of(verbs, verb.name);
    if (!words.empty()) cases += " \\\n        " + quoted("::command:(" + words + ")");
    cases += "\n      ;;\n";
  }
  std::string own;
  for (const OptionEntry& option : verbs.front().options) add_zsh_option(own, option);
  return "#compdef panache\n"
         "# zsh completion for panache. Generated from the options of the program.\n"
         "_panache_styles() {\n"
         "  local -a names=(\"${(@f)$(" +
         kListStyles +
         ")}\")\n"
         "  compadd -S = -a names\n"
         "}\n"
         "_panache() {\n"
         "  local -a commands=(\n" +
         commands +
         "    'help:Show the help of a command'\n"
         "  )\n"
         "  if ((CURRENT == 2)); then\n"
         "    _describe command commands\n"
         "    _arguments" +
         own +
         "\n    return\n"
         "  fi\n"
         "  local verb=$words[2]\n" +
         nested_case(verbs, "  ((CURRENT == 3)) || ", "\"$verb $words[3]\"") +
         "  [[ $verb != *' '* ]] || { shift words; ((CURRENT--)); }\n"
         "  shift words\n"
         "  ((CURRENT--))\n"
         "  case $verb in\n" +
         cases +
         "    help) ((CURRENT > 2)) || _describe command commands ;;\n"
         "  esac\n"
         "}\n"
         "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n"
         "  _panache \"$@\"\n"
         "else\n"
         "  compdef _panache panache\n"
         "fi\n";
}

std::string fish_completion(const std::vector<VerbEntry>& verbs) {
  std::string out = "# fish completion for panache. Generated from the options of the program.\n";
  const std::string start = "complete -c panache -n __fish_use_subcommand";
  for (const VerbEntry& verb : verbs) {
    if (verb.name.empty()) continue;
    out += (verb.parent().empty() ? start : fish_after(verbs, verb.parent())) + " -f -a " +
           verb.word() + " -d " + quoted(verb.description) + "\n";
  }
  out += start + " -f -a help -d 'Show the help of a command'\n";
  out +=
      "complete -c panache -n '__fish_seen_subcommand_from help' -f -a '" + names_of(verbs) + "'\n";
  for (const VerbEntry& verb : verbs) {
    const std::string when = verb.name.empty() ? start : fish_after(verbs, verb.name);
    for (const OptionEntry& option : verb.options) {
      if (option.is_positional()) continue;
      out += when;
      for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        out += (is_long ? " -l " : " -s ") + name.substr(is_long ? 2 : 1);
      }
      const std::string choices =
          option.value == "STYLE" ? "(" + kListStyles + ")" : choices_of(option.value);
      out += option.value.empty() ? "" : choices.empty() ? " -r" : " -x -a " + quoted(choices);
      out += " -d " + quoted(option.description) + "\n";
    }
  }
  return out;
}

}  // namespace panache::cli
