/* SPDX-License-Identifier: MIT */
/* command_line.c - reads the options and arguments of every command by the command's table, and reports mistakes of the
 * user. */
#include "command.h"
#include "help.h"
#include "hint.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define MOST_OPTIONS 64
/* The first of the numbers by which getopt_long() identifies options: the option in row n has the number OPTION + n.
 * These numbers are larger than any character. */
#define OPTION 1024

/* ---- The options of a command -------------------------------------------------------------------------------- */

/* Fills in the n-th of the options that every command has. Returns false if n is beyond the last. */
static bool common_option_row(size_t n, command_option *option)
{
    static const command_option rows[] = {
        {.help = "Other options:"},
        {"quiet", NULL, "print only results and errors: no progress, no notes", .read = read_quiet},
        {"help", NULL, "print this help and exit", .read = read_flag},
        {"version", NULL, "print the version and exit", .read = read_flag},
    };
    if (n >= sizeof rows / sizeof rows[0])
        return false;
    *option = rows[n];
    return true;
}

static bool is_table_end(const command_option *row)
{
    return !row->name && !row->help && !row->more;
}

bool command_option_at(const command *c, size_t n, command_option *option)
{
    for (const command_option *own = c->options; own && !is_table_end(own); own++) {
        for (size_t i = 0; own->more && own->more(i, option); i++)
            if (n-- == 0) {
                option->offset += own->offset;
                return true;
            }
        if (!own->more && n-- == 0) {
            *option = *own;
            return true;
        }
    }
    return common_option_row(n, option);
}

/* Finds the option with this letter. Returns false if the command has no such option. */
static bool find_option_by_letter(const command *c, char letter, command_option *option)
{
    for (size_t n = 0; command_option_at(c, n, option); n++)
        if (option->name && option_letter(option->name) == letter)
            return true;
    return false;
}

/* Lists the options in the form that getopt_long() needs. If a table has too many rows, which is a bug, the program
 * aborts on its first run. */
static void fill_getopt_tables(const command *c, struct option all[MOST_OPTIONS], char letters[MOST_OPTIONS])
{
    size_t count = 0, used = 1;
    command_option o;
    letters[0] = ':';
    for (size_t n = 0; command_option_at(c, n, &o); n++) {
        if (!o.name)
            continue;
        if (count + 1 == MOST_OPTIONS)
            abort();
        all[count++] = (struct option){o.name, o.value ? required_argument : no_argument, NULL, OPTION + (int)n};
        if (option_letter(o.name)) {
            letters[used++] = option_letter(o.name);
            letters[used++] = ':';
            used -= !o.value;
        }
    }
    all[count] = (struct option){NULL, 0, NULL, 0};
    memcpy(letters + used, c->negative_error ? "0123456789" : "", c->negative_error ? 11 : 1);
}

/* ---- Mistakes ------------------------------------------------------------------------------------------------ */

/* Reports an abbreviation that fits several options: "--s is ambiguous: --size, --slice". Returns false if fewer than
 * two options begin with `name`. */
static bool refuse_if_ambiguous(const command *c, const struct option *all, const char *name, size_t length)
{
    char matches[256] = "";
    size_t used = 0, found = 0;
    for (; all->name; all++)
        if (strncmp(all->name, name, length) == 0 && used < sizeof matches) {
            used += (size_t)snprintf(matches + used, sizeof matches - used, "%s--%s", found ? ", " : "", all->name);
            found++;
        }
    if (found < 2)
        return false;
    print_error("%s: --%.*s is ambiguous: %s", c->name, (int)length, name, matches);
    return true;
}

/* Returns the argument with the short option that getopt_long() read last. If getopt_long() has more letters to read in
 * the argument, it has not moved on to the next argument. */
static const char *find_last_word(int argc, char **argv, int letter)
{
    const char *before = argv[optind - 1];
    const bool moved_on = before[0] == '-' && before[1] && before[strlen(before) - 1] == letter;
    return moved_on || optind >= argc ? before : argv[optind];
}

/* Reports a long option that is typed with one dash, such as "-size". Returns false if the word is no such option. */
static bool refuse_single_dash(const command *c, const struct option *all, const char *word)
{
    const size_t length = word[0] == '-' ? strcspn(word + 1, "=") : 0;
    for (; length > 1 && all->name; all++)
        if (strlen(all->name) == length && strncmp(all->name, word + 1, length) == 0) {
            print_error("%s: unknown option -%s, did you mean --%s? %s %s --help lists all options", c->name, all->name,
                        all->name, hint_program_name(), c->name);
            return true;
        }
    return false;
}

/* Reports one of three mistakes: an unknown option, an option without its value, or a value for an option that takes
 * none. */
static int refuse_option(const command *c, const struct option *all, bool missing, int argc, char **argv)
{
    char meant[HINT_TEXT];
    const char *typed = argv[optind - 1];
    const bool letter = optopt > 0 && optopt < 128;
    command_option known = {.name = NULL};
    if (!letter && optopt)
        command_option_at(c, (size_t)(optopt - OPTION), &known);
    if (missing)
        return print_error("%s%s needs a value; see %s %s --help", letter ? "-" : "--",
                           letter ? (char[]){(char)optopt, 0} : known.name, hint_program_name(), c->name);
    if (letter && refuse_single_dash(c, all, find_last_word(argc, argv, optopt)))
        return EXIT_TROUBLE;
    if (letter)
        return print_error("%s: unknown option -%c; %s %s --help lists all options", c->name, optopt,
                           hint_program_name(), c->name);
    if (optopt)
        return print_error("--%s takes no value", known.name);
    const char *name = typed + 2;
    const size_t length = strcspn(name, "=");
    hint h = hint_create(name, length);
    if (refuse_if_ambiguous(c, all, name, length))
        return EXIT_TROUBLE;
    for (const struct option *o = all; o->name; o++)
        hint_add_candidate(&h, o->name);
    return print_error("%s: unknown option --%.*s%s%s %s --help lists all options", c->name, (int)length, name,
                       hint_format(&h, "--", meant), hint_program_name(), c->name);
}

/* Returns whether the value of an option looks like an option. The user then probably forgot the value. */
static bool looks_like_option(const char *value)
{
    return (strncmp(value, "--", 2) == 0 && value[2]) ||
           (value[0] == '-' && value[1] && !value[2] && strchr("ohq", value[1]));
}

/* Finds the option that getopt_long() returned as `number`. Returns false if `number` is a digit, because the argument
 * is then a negative number. */
static bool find_option(const command *c, int number, command_option *option)
{
    return number >= OPTION ? command_option_at(c, (size_t)(number - OPTION), option)
                            : find_option_by_letter(c, (char)number, option);
}

/* Reads one option. Returns COMMAND_GO_ON or the exit status. */
static int read_option(const command *c, const command_option *o, char **argv, void *arguments)
{
    if (strcmp(o->name, "help") == 0)
        return help_print(stdout, c);
    if (strcmp(o->name, "version") == 0)
        return version_print();
    if (optarg && optarg == argv[optind - 1] && looks_like_option(optarg))
        return print_error("%s needs a value, but the next argument is the option %s", argv[optind - 2], optarg);
    return o->read(o, optarg, (char *)arguments + o->offset) ? COMMAND_GO_ON : EXIT_TROUBLE;
}

static int read_options(const command *c, int argc, char **argv, void *arguments, bool *has_output)
{
    struct option all[MOST_OPTIONS];
    char letters[MOST_OPTIONS];
    int status = COMMAND_GO_ON;
    fill_getopt_tables(c, all, letters);
    optind = 1;
    opterr = 0;
    for (int number; status == COMMAND_GO_ON && (number = getopt_long(argc, argv, letters, all, NULL)) != -1;) {
        command_option option;
        if (number == '?' || number == ':')
            return refuse_option(c, all, number == ':', argc, argv);
        if (!find_option(c, number, &option))
            return print_error("%s", c->negative_error);
        /* "-output x" reads as the option -o with the value "utput" */
        if (optarg && number < OPTION && optarg == argv[optind - 1] + 2 && refuse_single_dash(c, all, argv[optind - 1]))
            return EXIT_TROUBLE;
        *has_output = *has_output || option_letter(option.name) == 'o';
        status = read_option(c, &option, argv, arguments);
    }
    return status;
}

/* Reports that there are more arguments than the command takes. If the first surplus argument could be an output file,
 * suggests the option -o. */
static int refuse_surplus_argument(const command *c, const char *word, bool has_output)
{
    command_option output;
    const file_kinds kind = 1u << file_kind_of(word);
    const bool no_output = word[0] == '-' || kind & (c->inputs[0] | FILE_KIND(RECORDING));
    if (!has_output && !no_output && find_option_by_letter(c, 'o', &output) && fits_output_option(output.read, word))
        return print_error("%s: unexpected argument \"%s\", did you mean -o %s?", c->name, word, word);
    if (c->files_pattern)
        return print_error("%s: unexpected argument \"%s\"; for several files: "
                           "for f in %s; do %s %s \"$f\" -o \"$f.png\"; done",
                           c->name, word, c->files_pattern, hint_program_name(), c->name);
    return print_error("%s: unexpected argument \"%s\": it takes %s; see %s %s --help", c->name, word, c->takes,
                       hint_program_name(), c->name);
}

/* Reports that the user gave a file of a recording instead of the recording's folder, and names the folder. Returns
 * false if the path is not a file of a recording. */
static bool refuse_if_in_recording(const command *c, const char *path, file_kind kind)
{
    char *folder = path_parent_folder(path);
    const bool found = folder && file_kind_of(folder) == KIND_RECORDING;
    if (found)
        print_error("%s is %s, but %s takes %s: use %s", path, file_kind_rows[kind].name, c->name, c->takes, folder);
    free(folder);
    return found;
}

/* Checks that the command can read the input from standard input: that it takes a file, and that the file must
 * exist. */
static bool check_standard_input(const command *c, file_kinds taken)
{
    const file_kinds files = FILE_KIND(SESSION) | FILE_KIND(CLOUD) | FILE_KIND(PNG) | FILE_KIND(BASELINE);
    return (taken & files && !(taken & FILE_KIND(MISSING)) && !c->refuses_standard_input) ||
           print_refusal("\"-\" is standard input, but %s takes %s; for a file or folder named -, write ./-", c->name,
                         c->takes);
}

static bool check_input(const command *c, const char *path, file_kinds taken)
{
    if (file_is_standard_stream(path))
        return check_standard_input(c, taken);
    const file_kind kind = file_kind_of(path);
    const file_kind_row *row = &file_kind_rows[kind];
    if (kind == KIND_UNKNOWN || taken >> kind & 1)
        return true;
    if (kind == KIND_MISSING)
        return print_refusal("%s: no such file or folder", path);
    if (taken == FILE_KIND(RECORDING) && kind != KIND_FOLDER && refuse_if_in_recording(c, path, kind))
        return false;
    return print_refusal("%s is %s, but %s takes %s; %s%s%s%s%s", path, row->name, c->name, c->takes,
                         row->command ? hint_program_name() : "", row->command ? " " : "",
                         row->command ? row->command : "", row->command ? " " : "", row->use);
}

static bool check_inputs(const command *c, char **paths, int count)
{
    if (count > 1 && c->inputs[1] && file_is_standard_stream(paths[0]) && file_is_standard_stream(paths[1]))
        return print_refusal("\"-\" is given twice, but standard input can be read only once");
    for (int i = 0; i < count && i < 2; i++)
        if (c->inputs[i] && !check_input(c, paths[i], c->inputs[i]))
            return false;
    return true;
}

int command_read_arguments(const command *c, void *arguments, int argc, char **argv)
{
    bool has_output = false;
    const int status = read_options(c, argc, argv, arguments, &has_output);
    const int count = argc - optind;
    if (status != COMMAND_GO_ON)
        return status;
    if (count > c->max_arguments)
        return refuse_surplus_argument(c, argv[optind + c->max_arguments], has_output);
    if (count < c->min_arguments)
        return print_error("%s needs %s; see %s %s --help", c->name, c->takes, hint_program_name(), c->name);
    if (!check_names_not_empty(c->name, argv + optind, count))
        return EXIT_TROUBLE;
    return check_inputs(c, argv + optind, count) ? COMMAND_GO_ON : EXIT_TROUBLE;
}
