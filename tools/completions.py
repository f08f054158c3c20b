#!/usr/bin/env python3
"""Writes what a shell completes after `unsnarl`, from what --help says: completions.py {bash,zsh,fish} PROGRAM"""

import re
import sys

import help_text

#: Values that are files or folders, by how --help calls them.
FILE = re.compile(r"FILE|OUT|PAGE|IN\b|DIR|FOLDER|MESH|PROGRAM")
NOTE = "# Made from `unsnarl --help` by tools/completions.py."


def options_of(page):
    return [entry for group in page.groups.values() for entry in group if entry.names[0].startswith("-")]


def choices(entry):
    """The words that the value of an option is one of; none: it is something else."""
    return entry.value.split("|") if re.fullmatch(r"\w+(\|\w+)+", entry.value) else []


def first_sentence(text):
    return re.split(r"(?<=\w)[.;:] ", text)[0].rstrip(".")


def bash(pages):
    own = pages[None]
    commands = [entry.names[0] for entry in own.groups["Commands"]]
    yield NOTE
    yield "_unsnarl() {"
    yield "  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command= options= part"
    yield "  for part in \"${COMP_WORDS[@]:1:COMP_CWORD - 1}\"; do"
    yield f"    case $part in {'|'.join(commands)}) command=$part; break ;; esac"
    yield "  done"
    yield "  case $command:$previous in"
    for command in commands:
        for entry in options_of(pages[command]):
            cases = "|".join(f"{command}:{name}" for name in entry.names)
            if choices(entry):
                yield f"    {cases}) COMPREPLY=($(compgen -W '{' '.join(choices(entry))}' -- \"$word\")); return ;;"
            elif entry.value and not FILE.match(entry.value):
                yield f"    {cases}) compopt +o default; return ;;"
            elif entry.value:
                yield f"    {cases}) return ;;"
    yield "  esac"
    yield "  case $command in"
    for command in [None, *commands]:
        words = [name for entry in options_of(pages[command]) for name in entry.names]
        yield f"    '{command or ''}') options='{' '.join(words + ([] if command else commands))}' ;;"
    yield "  esac"
    yield "  if [[ $word == -* || -z $command ]]; then COMPREPLY=($(compgen -W \"$options\" -- \"$word\")); fi"
    yield "}"
    yield "complete -o default -F _unsnarl unsnarl"


def zsh(pages):
    def quoted(text):
        return text.replace("'", "'\\''")

    def described(text):
        return quoted(re.sub(r"([\[\]:\\])", r"\\\1", first_sentence(text)))

    def specification(entry):
        value = ""
        if choices(entry):
            value = f":{quoted(entry.names[-1].strip('-'))}:({' '.join(choices(entry))})"
        elif entry.value:
            action = "_files" if FILE.match(entry.value) else " "
            value = f":{quoted(entry.value.removesuffix(' ...').replace(':', '-'))}:{action}"
        often = "*" if entry.value.endswith(" ...") else ""
        names = entry.names
        if len(names) == 1:
            return f"'{often}{names[0]}[{described(entry.meaning)}]{value}'"
        return f"'({' '.join(names)})'{{{','.join(names)}}}'[{described(entry.meaning)}]{value}'"

    commands = pages[None].groups["Commands"]
    yield "#compdef unsnarl"
    yield NOTE
    yield "_unsnarl() {"
    yield "  local context state state_descr line"
    yield "  typeset -A opt_args"
    yield "  local -a commands=("
    yield from (f"    '{entry.names[0]}:{described(entry.meaning)}'" for entry in commands)
    yield "  )"
    yield "  _arguments -C \\"
    yield from (f"    {specification(entry)} \\" for entry in options_of(pages[None]))
    yield "    '1:command:->command' '*::argument:->argument'"
    yield "  case $state in"
    yield "    command) _describe command commands ;;"
    yield "    argument)"
    yield "      case $words[1] in"
    for command in (entry.names[0] for entry in commands):
        yield f"        {command}) _arguments \\"
        yield from (f"          {specification(entry)} \\" for entry in options_of(pages[command]))
        yield "          '*:file:_files' ;;"
    yield "      esac ;;"
    yield "  esac"
    yield "}"
    yield "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then _unsnarl \"$@\"; else compdef _unsnarl unsnarl; fi"


def fish(pages):
    def quoted(text):
        return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"

    def option(entry):
        words = [f"-l {n[2:]}" if n.startswith("--") else f"-s {n[1:]}" for n in entry.names]
        if choices(entry):
            words.append(f"-x -a {quoted(' '.join(choices(entry)))}")
        elif entry.value:
            words.append("-r -F" if FILE.match(entry.value) else "-x")
        return " ".join([*words, "-d", quoted(first_sentence(entry.meaning))])

    commands = pages[None].groups["Commands"]
    yield NOTE
    for entry in options_of(pages[None]):
        yield f"complete -c unsnarl -n __fish_use_subcommand {option(entry)}"
    for entry in commands:
        name, meaning = entry.names[0], quoted(first_sentence(entry.meaning))
        yield f"complete -c unsnarl -n __fish_use_subcommand -f -a {name} -d {meaning}"
    for command in (entry.names[0] for entry in commands):
        for entry in options_of(pages[command]):
            yield f"complete -c unsnarl -n '__fish_seen_subcommand_from {command}' {option(entry)}"


if __name__ == "__main__":
    shells = {"bash": bash, "zsh": zsh, "fish": fish}
    if len(sys.argv) != 3 or sys.argv[1] not in shells:
        sys.exit("usage: completions.py {bash,zsh,fish} PROGRAM")
    print("\n".join(shells[sys.argv[1]](help_text.read(sys.argv[2]))))
