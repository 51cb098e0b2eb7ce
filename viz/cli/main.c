/* SPDX-License-Identifier: MIT */
/* main.c - the program octreel: a table of commands and help topics, and `octreel help`. */
#include "command.h"
#include "completion.h"
#include "context.h"
#include "file_kind.h"
#include "help.h"
#include "hint.h"
#include "json_read.h"
#include "manual.h"
#include "prose.h"
#include "texts.h"

#include <stdio.h>
#include <string.h>

static const command *const commands[] = {
    &command_record, &command_play, &command_join,    &command_film, &command_verify,
    &command_audit,  &command_pick, &command_inspect, &command_diff, &command_accept,
};

const command *command_at(size_t n)
{
    return n < sizeof commands / sizeof commands[0] ? commands[n] : NULL;
}

static const help_topic topics[] = {
    {"session", "the session file: a world, points, keys, edits, queries", session_text},
    {"recording", "the folder of a recording: frames, ticks, view options", recording_text},
    {"baseline", "the baseline file: accepted digests, their reasons, and the folder of stored pictures",
     baseline_text},
};

const help_topic *help_topic_at(size_t n)
{
    return n < sizeof topics / sizeof topics[0] ? &topics[n] : NULL;
}

const command command_octreel = {
    .name = "octreel",
    .line = "an octree you can watch",
    .usage = "COMMAND [OPTION ...]",
    .about = "Film an octree while points move through it, one PNG frame for each tick, drawn without a display. Show "
             "how a point cloud subdivides. Compare frames and say why they differ. Check the answers of your own "
             "spatial index against exact ones.\n",
    .more = "octreel help --man NAME prints the manual of a command or file for man(1). octreel help --complete SHELL "
            "prints the completions for bash, zsh or fish. Both are installed with the program.\n",
    .statuses = {"done", "a difference or a wrong answer was found",
                 "error; a command stopped by a signal ends with that signal (130 for Ctrl-C)"},
    .examples = "# film the example; then open flight/index.html in a browser\n"
                "octreel record -o flight\n"
                "# draw the octree of a point cloud\n"
                "octreel inspect scan.pcd -o cloud.png\n"
                "# compare frames with a reference; then open evidence/report.html\n"
                "octreel diff reference frames -o evidence\n",
};

static const command *find_command(const char *name)
{
    for (size_t i = 0; command_at(i); i++)
        if (strcmp(name, command_at(i)->name) == 0)
            return command_at(i);
    return NULL;
}

static const help_topic *find_help_topic(const char *name)
{
    for (size_t i = 0; help_topic_at(i); i++)
        if (strcmp(name, help_topic_at(i)->name) == 0)
            return help_topic_at(i);
    return NULL;
}

/* Reports an unknown command and suggests the most similar one. With `help`, reports an unknown help topic and suggests
 * the most similar topic or command. */
static int report_unknown_word(const char *word, bool help)
{
    static const char *const other_words[] = {"help", "--help", "--version"};
    char meant[HINT_TEXT];
    hint h = hint_create(word, strlen(word));
    for (size_t i = 0; command_at(i); i++)
        hint_add_candidate(&h, command_at(i)->name);
    for (size_t i = 0; help && help_topic_at(i); i++)
        hint_add_candidate(&h, help_topic_at(i)->name);
    for (size_t i = 0; !help && i < sizeof other_words / sizeof other_words[0]; i++)
        hint_add_candidate(&h, other_words[i]);
    const file_kind kind = help ? KIND_UNKNOWN : file_kind_of(word);
    if (file_kind_rows[kind].command)
        return print_error("unknown command \"%s\": it is %s; %s %s %s", word, file_kind_rows[kind].name,
                           hint_program_name(), file_kind_rows[kind].command, file_kind_rows[kind].use);
    if (!help && *word == '-' && !h.name)
        return print_error("expected a command before the option \"%s\"; %s help lists all commands", word,
                           hint_program_name());
    return print_error("unknown %s \"%s\"%s%s help lists all %s", help ? "help topic" : "command", word,
                       hint_format(&h, "", meant), hint_program_name(), help ? "topics" : "commands");
}

/* Prints the help of a command or topic. With `manual`, prints the manual page in roff, the format that man(1) reads.
 */
static int print_help(const char *name, bool manual)
{
    const help_topic *topic = find_help_topic(name);
    const command *found = manual && strcmp(name, command_octreel.name) == 0 ? &command_octreel : find_command(name);
    if (topic && manual)
        manual_write_topic(stdout, topic);
    else if (topic)
        prose_print(stdout, topic->text);
    else if (found && manual)
        manual_write(stdout, found);
    else if (found)
        help_print(stdout, found);
    return topic || found ? EXIT_DONE : report_unknown_word(name, true);
}

static int print_completions(const char *shell)
{
    char known[64], meant[HINT_TEXT];
    hint h = hint_create(shell, strlen(shell));
    for (int i = 0; completion_shell_name(i); i++)
        hint_add_candidate(&h, completion_shell_name(i));
    if (completion_write(stdout, shell))
        return EXIT_DONE;
    return print_error("no completions for the shell \"%s\"%ssupported: %s", shell, hint_format(&h, "", meant),
                       json_list_names(completion_shell_name, known, sizeof known));
}

/* Runs `octreel help [COMMAND | TOPIC]`, `octreel help --man NAME` or `octreel help --complete SHELL`. */
static int run_help(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "--man") == 0)
        return print_help(argv[2], true);
    if (argc == 3 && strcmp(argv[1], "--complete") == 0)
        return print_completions(argv[2]);
    if (argc == 1)
        return help_print(stdout, &command_octreel);
    if (argc > 2)
        return print_error("help: unexpected argument \"%s\": it takes one command or topic", argv[2]);
    return print_help(argv[1], false);
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        help_print(stderr, &command_octreel);
        return EXIT_TROUBLE;
    }
    if (strcmp(argv[1], "help") == 0 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
        return run_help(argc - 1, argv + 1);
    if (strcmp(argv[1], "--version") == 0)
        return version_print();
    if (strcmp(argv[1], "digest") == 0)
        return print_error("octreel digest was removed; use octreel accept BASELINE FRAMES");
    const command *found = find_command(argv[1]);
    return found ? found->run(argc - 1, argv + 1) : report_unknown_word(argv[1], false);
}

static void report_context_fallback(const char *name, const char *instead_of, const char *why)
{
    print_note("drawing with %s, because %s does not work: %s", name, instead_of, why);
}

/* The program fails if standard output cannot be written completely, even if the command succeeded. */
int main(int argc, char **argv)
{
    static char line[1 << 16];
    /* Buffer whole lines, so that the lines of parallel processes do not mix. */
    setvbuf(stderr, line, _IOLBF, sizeof line);
    hint_set_program(argc > 0 ? argv[0] : NULL);
    draw_context_set_report(report_context_fallback);
    json_detect_failed_allocations();
    const int status = run(argc, argv);
    if (fflush(stdout) == 0 && !ferror(stdout))
        return status;
    return print_error("cannot write to standard output");
}
