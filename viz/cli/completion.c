/* SPDX-License-Identifier: MIT */
/* completion.c - writes completion scripts for bash, zsh and fish.
 *
 * Scripts written by hand go stale when an option is added. These scripts are generated from the tables by which the
 * command line is read. The placeholder of an option says how its value is completed: FILE, DIR, LIST, or else one of
 * `names`. The `inputs` of a command say which file endings it takes.
 *
 * Each shell is a row of templates, which write_template() fills in. The scripts differ in form. For bash, the script
 * is a function that parses the words before the cursor itself, with a case for each command and option. For zsh's
 * _arguments and fish's complete, the script is a list of declarations, one for each option. A declaration contains the
 * first clause of the option's description.
 */
#include "completion.h"
#include "cloud.h"
#include "command.h"

#include <string.h>

/* ---- Shells -------------------------------------------------------------------------------------------------- */

/* The ways to complete the value of an option. */
typedef enum value_kind { VALUE_NONE, VALUE_ANY, VALUE_ONE, VALUE_LIST, VALUE_FILE, VALUE_FOLDER, VALUES } value_kind;

/* The templates of a shell's script. They are shell code with markers such as %c; write_marker() lists the markers. */
typedef struct shell {
    const char *name;
    /* The text at the start of the script; `summary` is repeated for each command, between `head` and `middle`. */
    const char *head, *summary, *middle;
    const char *command;               /* the start of the part for a command; the options of the command follow */
    const char *option, *short_option; /* the texts for an option without a letter and for an option with a letter */
    /* The end of the part for a command that takes files, and for a command that takes only folders. */
    const char *files, *folders;
    const char *tail;
    const char *ending, *separator; /* the text for a file ending, and the text between two file endings */
    struct {
        const char *before, *after;
    } values[VALUES];    /* the texts before and after the possible values of an option */
    const char *escaped; /* characters that need a backslash inside the shell's quotation marks */
} shell;

static const shell shells[] = {
    {
        .name = "bash",
        .head = "# Completions of octreel for bash, as octreel help --complete bash prints them.\n"
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
                "        mapfile -t COMPREPLY < <(compgen -W '%Chelp --help --version' -- \"$word\")\n"
                "        return\n"
                "    fi\n"
                "    case ${COMP_WORDS[1]} in\n"
                "        help)\n"
                "            kind=one values='%C%T'\n"
                "            ;;\n",
        .command = "        %c)\n"
                   "            options='%O'\n"
                   "            endings='%E'\n"
                   "            case $option in\n",
        .option = "                --%n)%v ;;\n",
        .short_option = "                -%l | --%n)%v ;;\n",
        .files = "            esac\n"
                 "            ;;\n",
        .folders = "            esac\n"
                   "            ;;\n",
        .tail =
            "    esac\n"
            "    case $kind in\n"
            "        one) mapfile -t COMPREPLY < <(compgen -W \"$values\" -- \"$word\") ;;\n"
            "        list) # a name behind the last comma, or behind the - that leaves it out\n"
            "            [[ $word == *,* ]] && before=${word%%,*},\n"
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
        .ending = "%e",
        .separator = " ",
        .values = {[VALUE_ANY] = {" kind=any", ""},
                   [VALUE_ONE] = {" kind=one values='", "'"},
                   [VALUE_LIST] = {" kind=list values='", "'"},
                   [VALUE_FILE] = {" kind=file", ""},
                   [VALUE_FOLDER] = {" kind=directory", ""}},
    },
    {
        .name = "zsh",
        .head = "#compdef octreel\n"
                "# Completions of octreel for zsh, as octreel help --complete zsh prints them.\n"
                "local context state state_descr line\n"
                "local -a commands\n"
                "typeset -A opt_args\n"
                "commands=(\n",
        .summary = "    '%c:%d'\n",
        .middle = "    'help:print the help of a command'\n"
                  ")\n"
                  "_arguments -C '--help[list all commands]' '--version[print the version]' '1: :->command' "
                  "'*:: :->arguments' && return\n"
                  "if [[ $state == command ]]; then\n"
                  "    _describe -t commands command commands\n"
                  "else\n"
                  "    case $words[1] in\n"
                  "        help)\n"
                  "            _arguments '1:command:(%C%T)'\n"
                  "            ;;\n",
        .command = "        %c)\n"
                   "            _arguments -s \\\n",
        .option = "                '--%n%=[%h]%v' \\\n",
        .short_option = "                '(-%l --%n)'{-%l%+,--%n%=}'[%h]%v' \\\n",
        .files = "                '*:%t:_files -g \"%E\"'\n"
                 "            ;;\n",
        .folders = "                '*:%t:_files -/'\n"
                   "            ;;\n",
        .tail = "    esac\n"
                "fi\n",
        .ending = "*.%e",
        .separator = " ",
        .values = {[VALUE_NONE] = {"", ""},
                   [VALUE_ANY] = {":%p:", ""},
                   [VALUE_ONE] = {":%p:(", ")"},
                   [VALUE_LIST] = {":%p:_sequence compadd - ", ""},
                   [VALUE_FILE] = {":%p:_files", ""},
                   [VALUE_FOLDER] = {":%p:_files -/", ""}},
        .escaped = "[]:\\",
    },
    {
        .name = "fish",
        .head = "# Completions of octreel for fish, as octreel help --complete fish prints them.\n"
                "complete -c octreel -f\n"
                "complete -c octreel -n __fish_use_subcommand -l help -d 'list all commands'\n"
                "complete -c octreel -n __fish_use_subcommand -l version -d 'print the version'\n"
                "complete -c octreel -n __fish_use_subcommand -a help -d 'print the help of a command'\n"
                "complete -c octreel -n '__fish_seen_subcommand_from help' -a '%C%T'\n",
        .command = "complete -c octreel -n __fish_use_subcommand -a %c -d '%d'\n"
                   "complete -c octreel -n '__fish_seen_subcommand_from %c' -k -a '(__fish_complete_directories)'\n"
                   "%E",
        .option = "complete -c octreel -n '__fish_seen_subcommand_from %c' -l %n%v -d '%h'\n",
        .short_option = "complete -c octreel -n '__fish_seen_subcommand_from %c' -s %l -l %n%v -d '%h'\n",
        .ending = "complete -c octreel -n '__fish_seen_subcommand_from %c' -k -a '(__fish_complete_suffix .%e)'\n",
        .separator = "",
        .values = {[VALUE_NONE] = {"", ""},
                   [VALUE_ANY] = {" -x", ""},
                   [VALUE_ONE] = {" -x -a '", "'"},
                   [VALUE_LIST] = {" -x -a '(__fish_complete_list , \"string join \\n ", "\")'"},
                   [VALUE_FILE] = {" -r -F", ""},
                   [VALUE_FOLDER] = {" -x -a '(__fish_complete_directories)'", ""}},
        .escaped = "\\",
    },
};

/* ---- Values and inputs --------------------------------------------------------------------------------------- */

static value_kind find_value_kind(const command_option *o)
{
    if (!o->value)
        return VALUE_NONE;
    if (o->names)
        return strcmp(o->value, "LIST") == 0 ? VALUE_LIST : VALUE_ONE;
    return strncmp(o->value, "FILE", 4) == 0 ? VALUE_FILE : strcmp(o->value, "DIR") == 0 ? VALUE_FOLDER : VALUE_ANY;
}

/* The file endings of each kind of input. Folders are always offered as well, because a file may lie in a folder. */
static const struct {
    file_kinds kind;
    const char *endings;
} kind_endings[] = {
    {FILE_KIND(SESSION), ".json"},
    {FILE_KIND(PNG), ".png"},
    {FILE_KIND(BASELINE), ".txt"},
    {FILE_KIND(CLOUD), CLOUD_ENDINGS},
};

static bool takes_files(const command *c)
{
    return (c->inputs[0] | c->inputs[1]) & ~(FILE_KIND(RECORDING) | FILE_KIND(FOLDER) | FILE_KIND(MISSING));
}

/* Returns the length of the first clause of an option's description in bytes. */
static size_t first_clause_length(const char *help)
{
    size_t length = strcspn(help, ";:(");
    const char *stop = strstr(help, ". ");
    if (stop && (size_t)(stop - help) < length)
        length = (size_t)(stop - help);
    while (length > 0 && help[length - 1] == ' ')
        length--;
    return length;
}

/* ---- Templates ----------------------------------------------------------------------------------------------- */

/* The state of writing a script: the command, option and file ending whose data replace the markers of a template. */
typedef struct script {
    FILE *out;
    const shell *shell;
    const command *command;
    command_option option;
    const char *ending; /* the file ending for %e; it is not zero-terminated, because the next file ending follows it */
} script;

static void write_template(const script *s, const char *template);

/* Writes a text for use between single quotes. A backslash is written before each character that is special to the
 * shell. A quote character in the text becomes the characters '\'', which all three shells understand. */
static void write_quoted(const script *s, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (text[i] == '\'')
            fputs("'\\''", s->out);
        else
            fprintf(s->out, "%s%c", strchr(s->shell->escaped, text[i]) ? "\\" : "", text[i]);
}

/* Writes the shell code that completes the option's value, from a list of words or from files. */
static void write_value(const script *s)
{
    const value_kind kind = find_value_kind(&s->option);
    write_template(s, s->shell->values[kind].before);
    for (int i = 0; s->option.names && s->option.names(i); i++)
        fprintf(s->out, "%s%s", i ? " " : "", s->option.names(i));
    write_template(s, s->shell->values[kind].after);
}

/* Writes the file endings that the command takes. */
static void write_endings(script s)
{
    const file_kinds kinds = s.command->inputs[0] | s.command->inputs[1];
    bool begun = false;
    for (size_t i = 0; i < sizeof kind_endings / sizeof kind_endings[0]; i++)
        for (s.ending = kind_endings[i].endings; kinds & kind_endings[i].kind && *s.ending;) {
            s.ending++;
            fputs(begun ? s.shell->separator : "", s.out);
            write_template(&s, s.shell->ending);
            s.ending += strcspn(s.ending, ".");
            begun = true;
        }
}

static void write_option_names(const script *s)
{
    command_option o;
    for (size_t n = 0; command_option_at(s->command, n, &o); n++)
        if (o.name)
            fprintf(s->out, "%s--%s", n ? " " : "", o.name);
}

static void write_command_names(FILE *out)
{
    for (size_t i = 0; command_at(i); i++)
        fprintf(out, "%s ", command_at(i)->name);
}

static void write_topic_names(FILE *out)
{
    for (size_t i = 0; help_topic_at(i); i++)
        fprintf(out, "%s%s", i ? " " : "", help_topic_at(i)->name);
}

static void write_marker(const script *s, char marker)
{
    const command *c = s->command;
    const command_option *o = &s->option;
    switch (marker) {
    case 'C': /* the names of all commands, each followed by a space */
        write_command_names(s->out);
        break;
    case 'T': /* the names of all help topics */
        write_topic_names(s->out);
        break;
    case 'c': /* data of the command: %c its name, %d its description, %t its arguments */
        fputs(c->name, s->out);
        break;
    case 'd':
        write_quoted(s, c->line, strlen(c->line));
        break;
    case 't':
        write_quoted(s, c->takes, strcspn(c->takes, ","));
        break;
    case 'O': /* lists for the command: %O the names of all its options, %E all its file endings */
        write_option_names(s);
        break;
    case 'E':
        write_endings(*s);
        break;
    case 'e': /* %e is one file ending of the command */
        fprintf(s->out, "%.*s", (int)strcspn(s->ending, "."), s->ending);
        break;
    /* Data of the option: %n name, %l letter, %p placeholder, %h description, %v code that completes its value. */
    case 'n':
        fputs(o->name, s->out);
        break;
    case 'l':
        putc(option_letter(o->name), s->out);
        break;
    case 'p':
        write_quoted(s, o->value, strlen(o->value));
        break;
    case 'h':
        write_quoted(s, o->help, first_clause_length(o->help));
        break;
    case 'v':
        write_value(s);
        break;
    case '+': /* %+ is "+" and %= is "=" if the option takes a value; otherwise both are empty */
    case '=':
        fputs(o->value ? (char[]){marker, 0} : "", s->out);
        break;
    default: /* any other character, such as the second % of %%, is printed unchanged */
        putc(marker, s->out);
    }
}

/* Writes a template with its markers filled in. A null template writes nothing. */
static void write_template(const script *s, const char *template)
{
    for (const char *at = template ? template : ""; *at; at++)
        if (*at == '%')
            write_marker(s, *++at);
        else
            putc(*at, s->out);
}

static void write_command_completions(script s)
{
    write_template(&s, s.shell->command);
    for (size_t n = 0; command_option_at(s.command, n, &s.option); n++)
        if (s.option.name && s.shell->values[find_value_kind(&s.option)].before)
            write_template(&s, option_letter(s.option.name) ? s.shell->short_option : s.shell->option);
    write_template(&s, takes_files(s.command) ? s.shell->files : s.shell->folders);
}

static void write_whole_script(script s)
{
    write_template(&s, s.shell->head);
    for (size_t i = 0; (s.command = command_at(i)); i++)
        write_template(&s, s.shell->summary);
    write_template(&s, s.shell->middle);
    for (size_t i = 0; (s.command = command_at(i)); i++)
        write_command_completions(s);
    write_template(&s, s.shell->tail);
}

const char *completion_shell_name(int n)
{
    return n < (int)(sizeof shells / sizeof shells[0]) ? shells[n].name : NULL;
}

bool completion_write(FILE *out, const char *shell)
{
    const int found = json_find_name(completion_shell_name, shell);
    if (found >= 0)
        write_whole_script((script){.out = out, .shell = &shells[found]});
    return found >= 0;
}
