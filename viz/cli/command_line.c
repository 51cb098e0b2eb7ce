/* SPDX-License-Identifier: MIT */
/* command_line.c - one loop over the options for all commands. */
#include "command_line.h"
#include "hint.h"

#include <limits.h>
#include <string.h>

#define MOST_OPTIONS 64
#define OWN_OPTION 1024 /* the first of getopt's numbers for a command's own */

/* Numbers beyond letters, which are what getopt says of short options. */
enum { OPTION_JSON = VIEW_OPTION - 4, OPTION_HELP };

static void list_options(const command_line *line, struct option all[MOST_OPTIONS])
{
    static const struct option drawing[] = {{"context", required_argument, NULL, OPTION_CONTEXT},
                                            {"any-renderer", no_argument, NULL, OPTION_ANY_RENDERER}};
    size_t count = 0;
    for (const command_option *own = line->options; own && own->name; own++)
        all[count++] = (struct option){own->name, own->read == read_flag ? no_argument : required_argument, NULL,
                                       OWN_OPTION + (int)(own - line->options)};
    if (line->queries)
        count += list_query_options(all + count);
    if (line->view)
        count += list_view_options(all + count);
    if (line->renderer) {
        all[count++] = drawing[0];
        all[count++] = drawing[1];
    }
    if (line->json)
        all[count++] = (struct option){"json", no_argument, NULL, OPTION_JSON};
    all[count++] = (struct option){"help", no_argument, NULL, OPTION_HELP};
    all[count] = (struct option){NULL, 0, NULL, 0};
}

static int print_help(const command_line *line)
{
    hint_write_commands(stdout, line->help);
    if (line->queries)
        print_query_options(stdout);
    if (line->view)
        print_view_options(stdout);
    if (line->renderer)
        print_renderer_options(stdout);
    if (line->more_help)
        hint_write_commands(stdout, line->more_help);
    return EXIT_DONE;
}

/* getopt's number for -o; 0 where the command has none. */
static int find_output(const command_line *line)
{
    for (const command_option *own = line->options; own && own->name; own++)
        if (strcmp(own->name, "output") == 0)
            return OWN_OPTION + (int)(own - line->options);
    return 0;
}

static bool read_own(const command_line *line, int option)
{
    const command_option *own = &line->options[option - OWN_OPTION];
    return own->read(own, optarg, (char *)line->arguments + own->offset);
}

static bool read_option(const command_line *line, int option)
{
    if (line->view && take_view_option(line->view, option))
        return true;
    if (is_query_option(option))
        return read_query(line->queries, option, optarg);
    switch (option) {
    case OPTION_CONTEXT:
        return read_context(optarg, line->renderer);
    case OPTION_ANY_RENDERER:
        return line->renderer->any_renderer = true;
    case OPTION_JSON:
        return *line->json = true;
    case 'o':
        return read_own(line, find_output(line));
    default: /* a digit, as in -10 */
        return option >= OWN_OPTION ? read_own(line, option) : refuse("%s", line->no_negative);
    }
}

/* ---- What does not fit --------------------------------------------------------------------------------------- */

/* "--s could be --size or --slice"; false where fewer than two options begin so. */
static bool tell_ambiguous(const command_line *line, const struct option *all, const char *name, size_t length)
{
    char could[256] = "";
    size_t used = 0, found = 0;
    for (; all->name; all++)
        if (strncmp(all->name, name, length) == 0 && used < sizeof could) {
            used += (size_t)snprintf(could + used, sizeof could - used, "%s--%s", found ? ", " : "", all->name);
            found++;
        }
    if (found < 2)
        return false;
    trouble("%s: --%.*s could be each of %s", line->name, (int)length, name, could);
    return true;
}

static const struct option *find_option(const struct option *all, int number)
{
    while (all->name && all->val != number)
        all++;
    return all->name ? all : NULL;
}

/* An option that getopt does not know, or whose value is missing or too much. */
static int refuse_option(const command_line *line, const struct option *all, bool missing, const char *typed)
{
    char meant[HINT_TEXT];
    const bool letter = optopt > 0 && optopt < 128;
    const struct option *known = find_option(all, letter ? find_output(line) : optopt);
    if (missing)
        return trouble("%s%s takes a value, and has none; %s %s --help tells more", letter ? "-" : "--",
                       letter ? (char[]){(char)optopt, 0} : known->name, hint_program(), line->name);
    if (letter)
        return trouble("%s has no option -%c; %s %s --help lists all", line->name, optopt, hint_program(), line->name);
    if (optopt)
        return trouble("--%s takes no value", known->name);
    const char *name = typed + 2;
    const size_t length = strcspn(name, "=");
    hint h = hint_for(name, length);
    if (tell_ambiguous(line, all, name, length))
        return EXIT_TROUBLE;
    for (const struct option *o = all; o->name; o++)
        hint_offer(&h, o->name);
    return trouble("%s has no option --%.*s%s%s %s --help lists all", line->name, (int)length, name,
                   hint_text(&h, "--", meant), hint_program(), line->name);
}

/* A value that is an option: the option before it has none. */
static bool is_option(const char *value)
{
    return (strncmp(value, "--", 2) == 0 && value[2]) || strcmp(value, "-o") == 0 || strcmp(value, "-h") == 0;
}

static int read_options(const command_line *line, int argc, char **argv, bool *has_output)
{
    const char *letters = line->no_negative ? ":h0123456789" : find_output(line) ? ":o:h" : ":h";
    const int output = find_output(line);
    struct option all[MOST_OPTIONS];
    list_options(line, all);
    optind = 1;
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, letters, all, NULL)) != -1;) {
        if (option == 'h' || option == OPTION_HELP)
            return print_help(line);
        if (option == '?' || option == ':')
            return refuse_option(line, all, option == ':', argv[optind - 1]);
        if (optarg && optarg == argv[optind - 1] && is_option(optarg))
            return trouble("%s takes a value, and \"%s\" is an option", argv[optind - 2], optarg);
        if (!read_option(line, option))
            return EXIT_TROUBLE;
        *has_output = *has_output || option == 'o' || (output && option == output);
    }
    return COMMAND_GO_ON;
}

static int refuse_surplus(const command_line *line, const char *word, bool has_output)
{
    const int output = find_output(line);
    const file_kinds kind = 1u << file_kind_of(word);
    const bool no_output = word[0] == '-' || kind & (line->inputs[0] | FILE_KIND(RECORDING));
    if (output && !has_output && !no_output && is_meant_for(line->options[output - OWN_OPTION].read, word))
        return trouble("%s takes %s, not also \"%s\", did you mean -o %s?", line->name, line->takes, word, word);
    if (line->several)
        return trouble("%s takes %s, not also \"%s\"; for several: for f in %s; do %s %s \"$f\" -o \"$f.png\"; done",
                       line->name, line->takes, word, line->several, hint_program(), line->name);
    return trouble("%s takes %s, not also \"%s\"; %s %s --help tells more", line->name, line->takes, word,
                   hint_program(), line->name);
}

/* A file of a recording stands for its folder where that is taken. */
static bool refuse_part(const command_line *line, const char *path, file_kind kind)
{
    const char *slash = strrchr(path, '/');
    char folder[PATH_MAX] = ".";
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", slash > path ? (int)(slash - path) : 1, path);
    return file_kind_of(folder) == KIND_RECORDING &&
           !refuse("%s is %s, and %s takes %s: %s", path, file_kind_rows[kind].words, line->name, line->takes, folder);
}

/* Folders are no stream, nor is what may be made. */
static bool check_standard_input(const command_line *line, file_kinds taken)
{
    const file_kinds files = FILE_KIND(SESSION) | FILE_KIND(CLOUD) | FILE_KIND(PNG) | FILE_KIND(DIGESTS);
    return (taken & files && !(taken & FILE_KIND(MISSING)) && !line->no_standard_input) ||
           refuse("\"-\" is standard input, and %s takes %s; ./- is a file or folder of that name", line->name,
                  line->takes);
}

static bool check_input(const command_line *line, const char *path, file_kinds taken)
{
    if (file_is_standard(path))
        return check_standard_input(line, taken);
    const file_kind kind = file_kind_of(path);
    const file_kind_row *row = &file_kind_rows[kind];
    if (kind == KIND_UNKNOWN || taken >> kind & 1)
        return true;
    if (kind == KIND_MISSING)
        return refuse("%s: there is no such file or folder", path);
    if (taken == FILE_KIND(RECORDING) && kind != KIND_FOLDER && refuse_part(line, path, kind))
        return false;
    return refuse("%s is %s, and %s takes %s; %s%s%s%s%s", path, row->words, line->name, line->takes,
                  row->command ? hint_program() : "", row->command ? " " : "", row->command ? row->command : "",
                  row->command ? " " : "", row->use);
}

static bool check_inputs(const command_line *line, char **paths, int count)
{
    if (count > 1 && line->inputs[1] && file_is_standard(paths[0]) && file_is_standard(paths[1]))
        return refuse("standard input can be read once, and \"-\" names it twice");
    for (int i = 0; i < count && i < 2; i++)
        if (line->inputs[i] && !check_input(line, paths[i], line->inputs[i]))
            return false;
    return true;
}

int command_line_read(const command_line *line, int argc, char **argv)
{
    bool has_output = false;
    const int status = read_options(line, argc, argv, &has_output);
    const int count = argc - optind;
    if (status != COMMAND_GO_ON)
        return status;
    if (count > line->most)
        return refuse_surplus(line, argv[optind + line->most], has_output);
    if (count < line->least)
        return trouble("%s takes %s; %s %s --help tells more", line->name, line->takes, hint_program(), line->name);
    if (!check_names(line->name, argv + optind, count) || (line->renderer && !check_renderer(line->renderer)))
        return EXIT_TROUBLE;
    return check_inputs(line, argv + optind, count) ? COMMAND_GO_ON : EXIT_TROUBLE;
}
