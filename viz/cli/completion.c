/* SPDX-License-Identifier: MIT */
/* completion.c - writes completion scripts for bash, zsh and fish.
 *
 * Scripts written by hand go stale when an option is added. These are generated from the tables by which the command
 * line is read: an option's placeholder says what its value is (FILE, DIR, LIST or one of `names`), and a command's
 * `inputs` say which file endings it takes. The shells differ in one respect that shapes the code: bash runs a function
 * that must parse the words before the cursor itself, so its script is a case for each command and option; zsh's
 * _arguments and fish's complete take declarations, one for each option, with a description. So descriptions are cut to
 * their first clause. */
#include "completion.h"
#include "cloud.h"
#include "command.h"

#include <string.h>

/* ---- Values and inputs --------------------------------------------------------------------------------------- */

/* How the value of an option is completed. */
typedef enum value_kind { VALUE_NONE, VALUE_ANY, VALUE_ONE, VALUE_LIST, VALUE_FILE, VALUE_FOLDER } value_kind;

static value_kind find_value_kind(const command_option *o)
{
    if (!o->value)
        return VALUE_NONE;
    if (o->names)
        return strcmp(o->value, "LIST") == 0 ? VALUE_LIST : VALUE_ONE;
    return strncmp(o->value, "FILE", 4) == 0 ? VALUE_FILE : strcmp(o->value, "DIR") == 0 ? VALUE_FOLDER : VALUE_ANY;
}

/* File endings by kind of input. Folders are always offered too, because they lead to files. */
static const struct {
    file_kinds kind;
    const char *endings;
} kind_endings[] = {
    {FILE_KIND(SESSION), ".json"},
    {FILE_KIND(PNG), ".png"},
    {FILE_KIND(BASELINE), ".txt"},
    {FILE_KIND(CLOUD), CLOUD_ENDINGS},
};

enum { KINDS = sizeof kind_endings / sizeof kind_endings[0] };

/* Writes the endings that a command takes, each after `before`, separated by spaces. */
static void put_endings(FILE *out, const command *c, const char *before)
{
    const file_kinds kinds = c->inputs[0] | c->inputs[1];
    const char *blank = "";
    for (int i = 0; i < KINDS; i++)
        for (const char *at = kind_endings[i].endings; kinds & kind_endings[i].kind && *at;) {
            const int length = (int)strcspn(++at, ".");
            fprintf(out, "%s%s%.*s", blank, before, length, at);
            blank = " ";
            at += length;
        }
}

static void put_names(FILE *out, json_name *names)
{
    for (int i = 0; names(i); i++)
        fprintf(out, "%s%s", i ? " " : "", names(i));
}

/* Writes the names that octreel help takes. */
static void put_subjects(FILE *out)
{
    for (size_t i = 0; command_at(i); i++)
        fprintf(out, "%s ", command_at(i)->name);
    for (size_t i = 0; help_topic_at(i); i++)
        fprintf(out, "%s%s", i ? " " : "", help_topic_at(i)->name);
}

/* Write a text within '', with a backslash before each of some characters; "'\''" is every shell's quoted '. */
static void put_quoted(FILE *out, const char *text, size_t length, const char *escaped)
{
    for (size_t i = 0; i < length; i++)
        if (text[i] == '\'')
            fputs("'\\''", out);
        else
            fprintf(out, "%s%c", strchr(escaped, text[i]) ? "\\" : "", text[i]);
}

/* Returns the length of the first clause of a description. */
static size_t brief_length(const char *help)
{
    size_t length = strcspn(help, ";:(");
    const char *stop = strstr(help, ". ");
    if (stop && (size_t)(stop - help) < length)
        length = (size_t)(stop - help);
    while (length > 0 && help[length - 1] == ' ')
        length--;
    return length;
}

/* ---- bash --------------------------------------------------------------------------------------------------- */

static void put_bash_option(FILE *out, const command_option *o)
{
    static const char *const kinds[] = {[VALUE_ANY] = "any",
                                        [VALUE_ONE] = "one",
                                        [VALUE_LIST] = "list",
                                        [VALUE_FILE] = "file",
                                        [VALUE_FOLDER] = "directory"};
    const value_kind kind = find_value_kind(o);
    if (kind == VALUE_NONE)
        return;
    fputs("                ", out);
    if (option_letter(o->name))
        fprintf(out, "-%c | ", option_letter(o->name));
    fprintf(out, "--%s) kind=%s", o->name, kinds[kind]);
    if (o->names) {
        fputs(" values='", out);
        put_names(out, o->names);
        putc('\'', out);
    }
    fputs(" ;;\n", out);
}

static void put_bash_command(FILE *out, const command *c)
{
    command_option o;
    fprintf(out, "        %s)\n            options='", c->name);
    for (size_t n = 0; command_option_at(c, n, &o); n++)
        if (o.name)
            fprintf(out, "%s--%s", n ? " " : "", o.name);
    fputs("'\n            endings='", out);
    put_endings(out, c, "");
    fputs("'\n            case $option in\n", out);
    for (size_t n = 0; command_option_at(c, n, &o); n++)
        if (o.name)
            put_bash_option(out, &o);
    fputs("            esac\n            ;;\n", out);
}

static void write_bash(FILE *out)
{
    fputs("# Completions of octreel for bash, as octreel help --complete bash prints them.\n"
          "_octreel()\n"
          "{\n"
          "    local word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]}\n"
          "    local options='' endings='' values='' kind='' before='' ending\n"
          "    COMPREPLY=()\n"
          "    if [[ $word == = ]]; then # --camera=\n"
          "        word=\n"
          "    elif [[ $option == = ]]; then # --camera=is\n"
          "        option=${COMP_WORDS[COMP_CWORD - 2]}\n"
          "    fi\n"
          "    if [[ $COMP_CWORD -eq 1 ]]; then\n"
          "        mapfile -t COMPREPLY < <(compgen -W '",
          out);
    for (size_t i = 0; command_at(i); i++)
        fprintf(out, "%s ", command_at(i)->name);
    fputs("help --help --version' -- \"$word\")\n"
          "        return\n"
          "    fi\n"
          "    case ${COMP_WORDS[1]} in\n"
          "        help)\n"
          "            kind=one values='",
          out);
    put_subjects(out);
    fputs("'\n            ;;\n", out);
    for (size_t i = 0; command_at(i); i++)
        put_bash_command(out, command_at(i));
    fputs("    esac\n"
          "    case $kind in\n"
          "        one) mapfile -t COMPREPLY < <(compgen -W \"$values\" -- \"$word\") ;;\n"
          "        list) # a name behind the last comma, or behind the - that leaves it out\n"
          "            [[ $word == *,* ]] && before=${word%,*},\n"
          "            word=${word##*,}\n"
          "            [[ $word == -* ]] && before+=- word=${word#-}\n"
          "            mapfile -t COMPREPLY < <(compgen -P \"$before\" -W \"$values\" -- \"$word\")\n"
          "            compopt -o nospace 2>/dev/null\n"
          "            ;;\n"
          "        directory | file)\n"
          "            mapfile -t COMPREPLY < <(compgen \"-${kind:0:1}\" -- \"$word\")\n"
          "            compopt -o filenames 2>/dev/null\n"
          "            ;;\n"
          "        '')\n"
          "            if [[ $word == -* ]]; then\n"
          "                mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
          "                return\n"
          "            fi\n"
          "            mapfile -t COMPREPLY < <(compgen -d -- \"$word\")\n"
          "            for ending in $endings; do\n"
          "                mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -X \"!*.$ending\" -- \"$word\")\n"
          "            done\n"
          "            compopt -o filenames 2>/dev/null\n"
          "            ;;\n"
          "    esac\n"
          "}\n"
          "complete -F _octreel octreel\n",
          out);
}

/* ---- zsh ---------------------------------------------------------------------------------------------------- */

#define ZSH_ESCAPED "[]:\\"

static void put_zsh_option(FILE *out, const command_option *o)
{
    const char letter = option_letter(o->name), *takes = o->value ? "=" : "";
    if (letter)
        fprintf(out, "                '(-%c --%s)'{-%c%s,--%s%s}'[", letter, o->name, letter, o->value ? "+" : "",
                o->name, takes);
    else
        fprintf(out, "                '--%s%s[", o->name, takes);
    put_quoted(out, o->help, brief_length(o->help), ZSH_ESCAPED);
    putc(']', out);
    if (o->value) {
        putc(':', out);
        put_quoted(out, o->value, strlen(o->value), ZSH_ESCAPED);
        putc(':', out);
    }
    switch (find_value_kind(o)) {
    case VALUE_ONE:
        putc('(', out);
        put_names(out, o->names);
        putc(')', out);
        break;
    case VALUE_LIST:
        fputs("_sequence compadd - ", out);
        put_names(out, o->names);
        break;
    case VALUE_FILE:
        fputs("_files", out);
        break;
    case VALUE_FOLDER:
        fputs("_files -/", out);
        break;
    default:
        break;
    }
    fputs("' \\\n", out);
}

static void put_zsh_command(FILE *out, const command *c)
{
    command_option o;
    fprintf(out, "        %s)\n            _arguments -s \\\n", c->name);
    for (size_t n = 0; command_option_at(c, n, &o); n++)
        if (o.name)
            put_zsh_option(out, &o);
    fputs("                '*:", out);
    put_quoted(out, c->takes, strcspn(c->takes, ","), ZSH_ESCAPED);
    fputs(":_files", out);
    if ((c->inputs[0] | c->inputs[1]) & ~(FILE_KIND(RECORDING) | FILE_KIND(FOLDER) | FILE_KIND(MISSING))) {
        fputs(" -g \"", out);
        put_endings(out, c, "*.");
        fputs("\"'\n            ;;\n", out);
    } else {
        fputs(" -/'\n            ;;\n", out);
    }
}

static void write_zsh(FILE *out)
{
    fputs("#compdef octreel\n"
          "# Completions of octreel for zsh, as octreel help --complete zsh prints them.\n"
          "local context state state_descr line\n"
          "local -a commands\n"
          "typeset -A opt_args\n"
          "commands=(\n",
          out);
    for (size_t i = 0; command_at(i); i++) {
        fprintf(out, "    '%s:", command_at(i)->name);
        put_quoted(out, command_at(i)->line, strlen(command_at(i)->line), ":\\");
        fputs("'\n", out);
    }
    fputs("    'help:print the help of a command'\n"
          ")\n"
          "_arguments -C '--help[list all commands]' '--version[print the version]' '1: :->command' '*:: :->arguments' "
          "&& "
          "return\n"
          "if [[ $state == command ]]; then\n"
          "    _describe -t commands command commands\n"
          "else\n"
          "    case $words[1] in\n"
          "        help)\n"
          "            _arguments '1:command:(",
          out);
    put_subjects(out);
    fputs(")'\n            ;;\n", out);
    for (size_t i = 0; command_at(i); i++)
        put_zsh_command(out, command_at(i));
    fputs("    esac\nfi\n", out);
}

/* ---- fish --------------------------------------------------------------------------------------------------- */

#define FISH_ESCAPED "\\"

static void begin_fish(FILE *out, const char *command)
{
    fprintf(out, "complete -c octreel -n '__fish_seen_subcommand_from %s'", command);
}

static void end_fish(FILE *out, const char *words, size_t length)
{
    fputs(" -d '", out);
    put_quoted(out, words, length, FISH_ESCAPED);
    fputs("'\n", out);
}

static void put_fish_option(FILE *out, const command *c, const command_option *o)
{
    begin_fish(out, c->name);
    if (option_letter(o->name))
        fprintf(out, " -s %c", option_letter(o->name));
    fprintf(out, " -l %s", o->name);
    switch (find_value_kind(o)) {
    case VALUE_NONE:
        break;
    case VALUE_ANY:
        fputs(" -x", out);
        break;
    case VALUE_ONE:
        fputs(" -x -a '", out);
        put_names(out, o->names);
        putc('\'', out);
        break;
    case VALUE_LIST:
        fputs(" -x -a '(__fish_complete_list , \"string join \\n ", out);
        put_names(out, o->names);
        fputs("\")'", out);
        break;
    case VALUE_FILE:
        fputs(" -r -F", out);
        break;
    case VALUE_FOLDER:
        fputs(" -x -a '(__fish_complete_directories)'", out);
        break;
    }
    end_fish(out, o->help, brief_length(o->help));
}

static void put_fish_command(FILE *out, const command *c)
{
    command_option o;
    fprintf(out, "complete -c octreel -n __fish_use_subcommand -a %s", c->name);
    end_fish(out, c->line, strlen(c->line));
    begin_fish(out, c->name);
    fputs(" -k -a '(__fish_complete_directories)'\n", out);
    for (int i = 0; i < KINDS; i++)
        for (const char *at = kind_endings[i].endings; (c->inputs[0] | c->inputs[1]) & kind_endings[i].kind && *at;) {
            const int length = (int)strcspn(at, " ");
            begin_fish(out, c->name);
            fprintf(out, " -k -a '(__fish_complete_suffix .%.*s)'\n", length, at);
            at += length + (at[length] == ' ');
        }
    for (size_t n = 0; command_option_at(c, n, &o); n++)
        if (o.name)
            put_fish_option(out, c, &o);
}

static void write_fish(FILE *out)
{
    fputs("# Completions of octreel for fish, as octreel help --complete fish prints them.\n"
          "complete -c octreel -f\n"
          "complete -c octreel -n __fish_use_subcommand -l help -d 'list all commands'\n"
          "complete -c octreel -n __fish_use_subcommand -l version -d 'print the version'\n"
          "complete -c octreel -n __fish_use_subcommand -a help -d 'print the help of a command'\n"
          "complete -c octreel -n '__fish_seen_subcommand_from help' -a '",
          out);
    put_subjects(out);
    fputs("'\n", out);
    for (size_t i = 0; command_at(i); i++)
        put_fish_command(out, command_at(i));
}

/* ---- All of them -------------------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    void (*write)(FILE *out);
} shells[] = {{"bash", write_bash}, {"zsh", write_zsh}, {"fish", write_fish}};

const char *completion_shell(int n)
{
    return n < (int)(sizeof shells / sizeof shells[0]) ? shells[n].name : NULL;
}

bool completion_write(FILE *out, const char *shell)
{
    for (int i = 0; completion_shell(i); i++)
        if (strcmp(shells[i].name, shell) == 0) {
            shells[i].write(out);
            return true;
        }
    return false;
}
