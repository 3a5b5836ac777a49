/* Prints `cleave help --completion SHELL`: a script that completes commands, options, input files, and keys after -s,
 * from the tables of commands and of keys. */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "scene/scene.h"

/* Writes the options of the command c to `out`, each after a blank: those in the text of its usage, then --help. */
static void options_of(FILE *out, const struct command *c)
{
    for (const char *at = c->words; *at; at++) {
        const bool begins = *at == '-' && (at == c->words || strchr("[| ", at[-1]));
        if (!begins) continue;
        const size_t length = strcspn(at, " ]|");
        fprintf(out, " %.*s", (int)length, at);
        at += length - 1;
    }
    fputs(" --help", out);
}

/* Writes to `out` a `case` statement for the shell that assigns the options of the command in the shell variable
 * `command` to the shell variable `options`. */
static void cases_print(FILE *out)
{
    fputs("    case \"$command\" in\n", out);
    for (int k = 0; k < commands_count; k++) {
        fprintf(out, "        %s) options='", commands[k].name);
        options_of(out, &commands[k]);
        fputs("' ;;\n", out);
    }
    fputs("        *) options= ;;\n    esac\n", out);
}

static void names_print(FILE *out)
{
    for (int k = 0; k < commands_count; k++) fprintf(out, "%s%s", k ? " " : "", commands[k].name);
}

/* Texts of the completion scripts: `head` for both shells, bash and zsh; for each shell the beginning of its function,
 * and the rest of the function after the lists of words. */
static const char head[] = "# Completion of cleave, for %s; made by `cleave help --completion %s`.\n"
                           "_cleave_keys='\n";

static const char words_of_bash[] =
    "_cleave() {\n"
    "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} options\n"
    "    COMPREPLY=()\n";
static const char rest_of_bash[] =
    "    if [ \"$COMP_CWORD\" = 1 ]; then COMPREPLY=($(compgen -W \"$commands --help\" -- \"$word\")); return; fi\n"
    "    case $before in\n"
    "        -s) compopt -o nospace 2>/dev/null; COMPREPLY=($(compgen -S = -W \"$_cleave_keys\" -- \"$word\")); return "
    ";;\n"
    "        -o) COMPREPLY=($(compgen -d -- \"$word\")); return ;;\n"
    "        -t|-j|--of|--budget|--levels|--runs) return ;;\n"
    "    esac\n"
    "    case $word in -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")); return ;; esac\n"
    "    case $command in\n"
    "        help) COMPREPLY=($(compgen -W \"scene units expression run theory trust $_cleave_keys\" -- \"$word\")) "
    ";;\n"
    "        compare|report) COMPREPLY=($(compgen -d -- \"$word\")) ;;\n"
    "        new) COMPREPLY=($(compgen -W \"$kinds\" -- \"$word\")) ;;\n"
    "        export)\n"
    "            COMPREPLY=($(compgen -f -X '!*.yaml' -W 'lammps exodus' -- \"$word\") $(compgen -d -- \"$word\")) ;;\n"
    "        *) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -f -X '!*.yaml' -- \"$word\") $(compgen -d -- "
    "\"$word\")) ;;\n"
    "    esac\n"
    "}\n"
    "complete -F _cleave cleave\n";

static const char words_of_zsh[] =
    "_cleave() {\n"
    "    local word=$words[CURRENT] before=$words[CURRENT-1] command=$words[2] options\n";
static const char rest_of_zsh[] =
    "    if (( CURRENT == 2 )); then compadd -- ${=commands} --help; return; fi\n"
    "    case $before in\n"
    "        -s) compadd -S = -- ${=_cleave_keys}; return ;;\n"
    "        -o) _files -/; return ;;\n"
    "        -t|-j|--of|--budget|--levels|--runs) return ;;\n"
    "    esac\n"
    "    case $word in -*) compadd -- ${=options}; return ;; esac\n"
    "    case $command in\n"
    "        help) compadd -- scene units expression run theory trust ${=_cleave_keys} ;;\n"
    "        compare|report) _files -/ ;;\n"
    "        new) compadd -- ${=kinds} ;;\n"
    "        export) compadd -- lammps exodus; _files -g '*.yaml' ;;\n"
    "        *) _files -g '*.yaml' ;;\n"
    "    esac\n"
    "}\n"
    "compdef _cleave cleave\n";

status completion_print_shell_script(FILE *out, const char *shell)
{
    const bool bash = !strcmp(shell, "bash");
    if (!bash && strcmp(shell, "zsh") != 0)
        return status_set(REFUSED, "%.40s is not a supported shell; use cleave help --completion bash or zsh", shell);
    if (!bash) fputs("#compdef cleave\n", out);
    fprintf(out, head, shell, shell);
    scene_print_override_keys(out);
    fputs("'\n", out);
    fputs(bash ? words_of_bash : words_of_zsh, out);
    fputs("    local commands='", out);
    names_print(out);
    fputs("' kinds='", out);
    command_new_print_names_of_scene_kinds(out);
    fputs("'\n", out);
    cases_print(out);
    fputs(bash ? rest_of_bash : rest_of_zsh, out);
    return OK;
}
