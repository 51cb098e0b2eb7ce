/* SPDX-License-Identifier: MIT */
/* main.c - octreel's command line: a table of commands, and help on each. */
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
    &command_record, &command_play,    &command_join, &command_verify, &command_audit,
    &command_pick,   &command_inspect, &command_diff, &command_accept,
};

const command *command_at(size_t n)
{
    return n < sizeof commands / sizeof commands[0] ? commands[n] : NULL;
}

static const help_topic topics[] = {
    {"session", "what a session file holds: a world, points, keys, edits, queries", session_text},
    {"recording", "what the folder of a recording holds: frames, ticks, the view", recording_text},
    {"baseline", "what a baseline holds: accepted digests and why, and where their pictures are", baseline_text},
};

const help_topic *help_topic_at(size_t n)
{
    return n < sizeof topics / sizeof topics[0] ? &topics[n] : NULL;
}

const command command_octreel = {
    .name = "octreel",
    .line = "an octree you can watch",
    .usage = "COMMAND [OPTION ...]",
    .about = "Film a tree of points: every tick of a session becomes one PNG frame, drawn without a display. Look at "
             "how a point cloud subdivides, ask what is at a pixel, compare frames and say why they differ, and judge "
             "the answers of other spatial indices.\n",
    .more = "octreel help --man NAME writes the manual of a command or a kind of file for man(1), and octreel help "
            "--complete SHELL what bash, zsh and fish complete by; both are installed with the program.\n",
    .statuses = {"done", "a finding", "trouble; stopped by a signal, that signal's (130 for Ctrl-C)"},
    .examples = "octreel record -o flight\n"
                "octreel inspect scan.pcd -o cloud.png\n"
                "octreel diff reference frames -o evidence\n",
};

const command *find_command(const char *name)
{
    for (size_t i = 0; command_at(i); i++)
        if (strcmp(name, command_at(i)->name) == 0)
            return command_at(i);
    return NULL;
}

const help_topic *find_help_topic(const char *name)
{
    for (size_t i = 0; help_topic_at(i); i++)
        if (strcmp(name, help_topic_at(i)->name) == 0)
            return help_topic_at(i);
    return NULL;
}

/* `help`: on what help was asked for. */
static int report_unknown_word(const char *word, bool help)
{
    static const char *const other_words[] = {"help", "--help", "--version"};
    char meant[HINT_TEXT];
    hint h = hint_for(word, strlen(word));
    for (size_t i = 0; command_at(i); i++)
        hint_offer(&h, command_at(i)->name);
    for (size_t i = 0; help && help_topic_at(i); i++)
        hint_offer(&h, help_topic_at(i)->name);
    for (size_t i = 0; !help && i < sizeof other_words / sizeof other_words[0]; i++)
        hint_offer(&h, other_words[i]);
    const file_kind kind = help ? KIND_UNKNOWN : file_kind_of(word);
    if (file_kind_rows[kind].command)
        return print_error("there is no command \"%s\", which is %s; %s %s %s", word, file_kind_rows[kind].name,
                           hint_program_name(), file_kind_rows[kind].command, file_kind_rows[kind].use);
    if (!help && *word == '-' && !h.name)
        return print_error("a command comes first, and \"%s\" is an option; %s help lists them", word,
                           hint_program_name());
    return print_error("there is no %s \"%s\"%s%s help lists all", help ? "help on" : "command", word,
                       hint_text(&h, "", meant), hint_program_name());
}

/* The manual of octreel, a command or a topic, for man(1). */
static int print_manual(const char *name)
{
    const help_topic *topic = find_help_topic(name);
    const command *found = strcmp(name, command_octreel.name) == 0 ? &command_octreel : find_command(name);
    if (topic)
        manual_write_topic(stdout, topic);
    else if (found)
        manual_write(stdout, found);
    return topic || found ? EXIT_DONE : report_unknown_word(name, true);
}

static int print_completions(const char *shell)
{
    char known[64], meant[HINT_TEXT];
    hint h = hint_for(shell, strlen(shell));
    for (int i = 0; completion_shell(i); i++)
        hint_offer(&h, completion_shell(i));
    if (completion_write(stdout, shell))
        return EXIT_DONE;
    return print_error("there are no completions for \"%s\"%sthere are those of %s", shell, hint_text(&h, "", meant),
                       json_list_names(completion_shell, known, sizeof known));
}

/* On nothing, a command or a topic. */
static int help(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "--man") == 0)
        return print_manual(argv[2]);
    if (argc == 3 && strcmp(argv[1], "--complete") == 0)
        return print_completions(argv[2]);
    if (argc == 1)
        return help_print(stdout, &command_octreel);
    if (argc > 2)
        return print_error("help takes one command, not also \"%s\"", argv[2]);
    const help_topic *topic = find_help_topic(argv[1]);
    const command *found = find_command(argv[1]);
    if (topic)
        prose_print(stdout, topic->text);
    else if (!found)
        return report_unknown_word(argv[1], true);
    else
        help_print(stdout, found);
    return EXIT_DONE;
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        help_print(stderr, &command_octreel);
        return EXIT_TROUBLE;
    }
    if (strcmp(argv[1], "help") == 0 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
        return help(argc - 1, argv + 1);
    if (strcmp(argv[1], "--version") == 0)
        return version_print();
    if (strcmp(argv[1], "digest") == 0)
        return print_error("octreel digest was removed; use octreel accept BASELINE FRAMES");
    const command *found = find_command(argv[1]);
    return found ? found->run(argc - 1, argv + 1) : report_unknown_word(argv[1], false);
}

static void report_context_fallback(const char *name, const char *instead_of, const char *why)
{
    note("%s draws, since %s does not: %s", name, instead_of, why);
}

/* Output that could not be written is a failure, whatever the command returned. */
int main(int argc, char **argv)
{
    hint_set_program(argc > 0 ? argv[0] : NULL);
    draw_context_set_report(report_context_fallback);
    json_watch_memory();
    const int status = run(argc, argv);
    if (fflush(stdout) == 0 && !ferror(stdout))
        return status;
    return print_error("what there is to say cannot be written to standard output");
}
