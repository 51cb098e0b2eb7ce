/* SPDX-License-Identifier: MIT */
/* test_cli_completion.c - bash, zsh and fish complete every command, option and value, and the files that a command
 * takes. Tests of a shell that is not installed are skipped. */
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "view_options.h"

static const char *const commands[] = {"record", "play", "join",    "film", "verify",
                                       "audit",  "pick", "inspect", "diff", "accept"};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

/* A shell, and the texts before the name of a command and around an option in its script. */
typedef struct shell {
    const char *name, *file, *command, *option;
} shell;

static const shell bash = {"bash", "octreel", "        %s)\n", "--%s "};
static const shell zsh = {"zsh", "_octreel", "        %s)\n", "--%s"};
static const shell fish = {"fish", "octreel.fish", "__fish_seen_subcommand_from %s' -k", " -l %s "};

static void assert_has(const char *text, const char *format, const char *name, const shell *s, const char *command)
{
    char wanted[80];
    snprintf(wanted, sizeof wanted, format, name);
    if (!strstr(text, wanted))
        fail_msg("%s completes no %s of %s", s->name, name, command);
}

/* The test fails unless the completions of a command have all options that --help lists. */
static void assert_has_options(const shell *s, const char *completions, const char *command)
{
    char begin[80], name[40];
    size_t found = 0;
    snprintf(begin, sizeof begin, s->command, command);
    const char *part = strstr(completions, begin);
    command_result help = run_octreel(NULL, "help %s", command);
    assert_non_null(part);
    for (const char *line = help.out; *line; line += strcspn(line, "\n") + 1)
        if (strlen(line) > 8 && strncmp(line + 6, "--", 2) == 0 && sscanf(line + 8, "%39[a-z-]", name) == 1) {
            if (strcmp(name, "version") != 0) /* the last one has no blank behind it */
                assert_has(part, s->option, name, s, command);
            found++;
        }
    assert_true(found >= 3);
    command_release(&help);
}

static void every_option_is_completed(void **state)
{
    static const shell *const shells[] = {&bash, &zsh, &fish};
    (void)state;
    for (size_t i = 0; i < sizeof shells / sizeof shells[0]; i++) {
        command_result completions = run_octreel(NULL, "help --complete %s", shells[i]->name);
        assert_done(&completions);
        for (size_t c = 0; c < COMMANDS; c++)
            assert_has_options(shells[i], completions.out, commands[c]);
        command_release(&completions);
    }
    command_result none = run_octreel(NULL, "help --complete zish");
    assert_trouble(&none, "did you mean zsh?");
}

/* A line, and some of the completions of its last word; with "!", texts that must not be completed. */
typedef struct completed {
    const char *line, *offered[4];
} completed;

#define EVERYWHERE                                                                                                     \
    {"octreel re", {"record", "!verify"}}, {"octreel help se", {"session", "!record"}},                                \
        {"octreel record --came", {"--camera", "--camera-from", "!--size"}},                                           \
        {"octreel record --camera o", {"orbit", "!iso"}}, {"octreel diff --max", {"--max-pixels", "--max-delta"}},     \
        {"octreel verify --context ", {"osmesa", "egl"}}, {"octreel inspect --full g", {"grow", "!refuse"}},           \
        {"octreel record -o ", {"!s.json"}}, {"octreel record s", {"s.json"}},                                         \
        {"octreel record --every ", {"!s.json"}},                                                                      \
    {                                                                                                                  \
        "octreel record -",                                                                                            \
        {                                                                                                              \
            "--quiet", "--json", "--help", "--version"                                                                 \
        }                                                                                                              \
    }

/* Whether a line occurs in a part of a text; the name of a folder may end in a slash. */
static bool has_line(const char *text, const char *end, const char *line)
{
    const size_t length = strlen(line);
    for (const char *at = text; at < end; at += strcspn(at, "\n") + 1) {
        const size_t room = strcspn(at, "\n");
        if (strncmp(at, line, length) == 0 && (room == length || (room == length + 1 && at[length] == '/')))
            return true;
    }
    return false;
}

static void assert_completed(const shell *s, const completed *row, const char *offered, const char *end)
{
    for (size_t i = 0; i < 4 && row->offered[i]; i++) {
        const bool wanted = row->offered[i][0] != '!';
        if (has_line(offered, end, row->offered[i] + !wanted) != wanted)
            fail_msg("%s: \"%s\" is completed to %.*s", s->name, row->line, (int)(end - offered), offered);
    }
}

static void assert_all_completed(void **state, const shell *s, const completed *rows, size_t count)
{
    const temp_folder *own = *state;
    char lines[2048] = "";
    if (!is_program_installed(s->name)) {
        print_message("%s is not installed: its completions are not tested\n", s->name);
        skip();
    }
    for (size_t i = 0; i < count; i++)
        snprintf(lines + strlen(lines), sizeof lines - strlen(lines), "%s\n", rows[i].line);
    file_write_text(place_in(own, "lines").path, lines);
    file_write_text(place_in(own, "s.json").path, "");
    file_write_text(place_in(own, "my cloud.ply").path, "");
    command_result said =
        run_script("cd %s && mkdir 'a folder' && %s help --complete %s >%s && "
                   "HOME=$PWD timeout 60 %s %s %s.%s ./%s <lines",
                   own->name, octreel_program(), s->name, s->file, s->name, s == &fish ? "--no-config" : "",
                   shell_quote(OCTREEL_COMPLETE).text, s->name, s->file);
    assert_done(&said);
    const char *at = said.out;
    for (size_t i = 0; i < count; i++) {
        const char *end = strncmp(at, "--\n", 3) == 0 ? at : strstr(at, "\n--\n");
        assert_non_null(end);
        end += end > at;
        assert_completed(s, &rows[i], at, end);
        at = end + 3;
    }
    command_release(&said);
}

#define COUNT(rows) (sizeof(rows) / sizeof((rows)[0]))

static void bash_completes_commands_options_and_files(void **state)
{
    static const completed rows[] = {
        EVERYWHERE,
        {"octreel record --camera=o", {"orbit", "!iso"}},
        {"octreel record --camera=", {"orbit", "iso"}},
        {"octreel record --layers nodes,-te", {"nodes,-text"}},
        {"octreel record --layers nodes,vis", {"nodes,visited", "nodes,visit-heat"}},
        {"octreel inspect ", {"my cloud.ply", "a folder", "!s.json"}},
        {"octreel verify ", {"a folder", "!s.json"}},
    };
    assert_all_completed(state, &bash, rows, COUNT(rows));
}

/* zsh completes only on a terminal, and a chroot may have none. */
static void skip_without_terminals(void)
{
    const int one = open("/dev/ptmx", O_RDWR | O_NOCTTY);
    if (one < 0) {
        print_message("no pseudoterminal can be opened: completions of zsh are not tested\n");
        skip();
    }
    close(one);
}

static void zsh_completes_commands_options_and_files(void **state)
{
    static const completed rows[] = {
        EVERYWHERE,
        {"octreel record --camera=o", {"orbit", "!iso"}},
        {"octreel record --layers nodes,vis", {"visited", "visit-heat"}},
        {"octreel inspect m", {"my\\ cloud.ply"}},
        {"octreel verify ", {"a\\ folder", "!s.json"}},
    };
    skip_without_terminals();
    assert_all_completed(state, &zsh, rows, COUNT(rows));
}

static void fish_completes_commands_options_and_files(void **state)
{
    static const completed rows[] = {
        EVERYWHERE,
        {"octreel record --camera=o", {"--camera=orbit"}},
        {"octreel record --layers nodes,vis", {"nodes,visited", "nodes,visit-heat"}},
        {"octreel inspect ", {"my cloud.ply", "a folder"}},
        {"octreel verify ", {"a folder", "!s.json"}},
    };
    assert_all_completed(state, &fish, rows, COUNT(rows));
}

/* fish completes one ending for each declaration. */
static void fish_completes_each_file_ending(void **state)
{
    static const char *const declared[] = {
        "'__fish_seen_subcommand_from inspect' -k -a '(__fish_complete_suffix .ply)'",
        "'__fish_seen_subcommand_from pick' -k -a '(__fish_complete_suffix .png)'"};
    command_result completions = run_octreel(NULL, "help --complete fish");
    (void)state;
    for (size_t i = 0; i < sizeof declared / sizeof declared[0]; i++)
        assert_non_null(strstr(completions.out, declared[i]));
    command_release(&completions);
}

static void every_value_of_a_view_option_is_completed(void **state)
{
    (void)state;
    for (const shell *const *s = (const shell *const[]){&bash, &zsh, &fish, NULL}; *s; s++) {
        command_result completions = run_octreel(NULL, "help --complete %s", (*s)->name);
        for (size_t i = 0; view_option_at(i); i++)
            for (int n = 0; view_option_at(i)->member.names && view_option_at(i)->member.names(n); n++)
                assert_has(completions.out, "%s", view_option_at(i)->member.names(n), *s, view_option_at(i)->name);
        command_release(&completions);
    }
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_option_is_completed),
        cmocka_unit_test(every_value_of_a_view_option_is_completed),
        cmocka_unit_test(fish_completes_each_file_ending),
        IN_FOLDER(bash_completes_commands_options_and_files),
        IN_FOLDER(zsh_completes_commands_options_and_files),
        IN_FOLDER(fish_completes_commands_options_and_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
