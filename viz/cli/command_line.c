/* SPDX-License-Identifier: MIT */
/* command_line.c - one loop over the options for all commands. */
#include "command_line.h"

#include <string.h>

#define MOST_OPTIONS 64
#define OWN_OPTION 1024 /* the first of getopt's numbers for a command's own */

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
        all[count++] = (struct option){"json", no_argument, NULL, 'j'};
    all[count++] = (struct option){"help", no_argument, NULL, 'h'};
    all[count] = (struct option){NULL, 0, NULL, 0};
}

static int print_help(const command_line *line)
{
    fputs(line->help, stdout);
    if (line->queries)
        print_query_options(stdout);
    if (line->view)
        print_view_options(stdout);
    if (line->renderer)
        print_renderer_options(stdout);
    if (line->more_help)
        fputs(line->more_help, stdout);
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
    case 'j':
        return *line->json = true;
    case '?': /* getopt has said what is wrong */
        fprintf(stderr, "octreel %s --help tells what it takes\n", line->name);
        return false;
    case 'o':
        return read_own(line, find_output(line));
    default: /* a digit, as in -10 */
        return option >= OWN_OPTION ? read_own(line, option) : refuse("%s", line->no_negative);
    }
}

int command_line_read(const command_line *line, int argc, char **argv)
{
    const char *letters = line->no_negative ? "h0123456789" : find_output(line) ? "o:h" : "h";
    struct option all[MOST_OPTIONS];
    list_options(line, all);
    optind = 1;
    for (int option; (option = getopt_long(argc, argv, letters, all, NULL)) != -1;) {
        if (option == 'h')
            return print_help(line);
        if (!read_option(line, option))
            return EXIT_TROUBLE;
    }
    const int count = argc - optind;
    if (count > line->most)
        return trouble("%s takes %s, not also \"%s\"; octreel %s --help tells more", line->name, line->takes,
                       argv[optind + line->most], line->name);
    if (count < line->least)
        return trouble("%s takes %s; octreel %s --help tells more", line->name, line->takes, line->name);
    if (!check_names(line->name, argv + optind, count) || (line->renderer && !check_renderer(line->renderer)))
        return EXIT_TROUBLE;
    return COMMAND_GO_ON;
}
