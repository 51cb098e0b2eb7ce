/* SPDX-License-Identifier: MIT */
/* failure_campaign.c - runs octreel's commands and makes one memory allocation or one system call fail in each run, or
 * stops the command by SIGTERM before a system call.
 *
 * Mesa's own allocations and calls are left alone. A call fails with each error in turn: I/O error, full disk, too many
 * open files, interrupted call; reads and writes may also be short. In one recording by several jobs the disk is slow
 * until the jobs wait for room in their sockets.
 *
 * A command must end with status 2 and one sentence; or, if it can work without the failed part, as in a run without a
 * failure. diff must keep its verdict, but may explain it in less detail. No command may hang, or be ended by a signal
 * other than that SIGTERM. A file with a final name must be the file from before the run or the one that a run without
 * a failure writes. */
#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <limits.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "page.h"
#include "program.h"

const char program_name[] = "octreel-failure-campaign";

enum { MOST = 100000, MOST_FINDINGS = 10, VERDICT = 20 /* bytes that hold it, of what diff says */ };

#define SMALL "--size 64x36"

/* The files on which the commands work. Every run begins with a copy of them. */
static const char PREPARE[] =
    "unset CI && mkdir given && cd given && "
    "printf '0 0 0\\n1 2 3\\n4 5 6\\n7 1 2\\n' >points.xyz && "
    "printf 'ply\\nformat ascii 1.0\\nelement vertex 2\\nproperty float x\\nproperty float y\\nproperty float z\\n"
    "property uchar classification\\nend_header\\n0 0 0 2\\n1 2 3 6\\n' >classes.ply && "
    "\"$octreel\" record --keys wdn " SMALL " --jobs 1 -o film && "
    "\"$octreel\" record --keys wds " SMALL " --jobs 1 -o other && "
    "\"$octreel\" record --keys wdn " SMALL " --jobs 1 --ticks 0:2 -o chunks && "
    "\"$octreel\" record --keys wdn " SMALL " --jobs 1 --ticks 2: -o chunks && "
    "cp -r film half && rm half/frame_000002.png half/index.html && "
    "head -n 2 film/ticks.jsonl >half/ticks.jsonl && "
    "cp film/session.json session.json && "
    "\"$octreel\" accept film.baseline film --reason first --date 2026-11-22 --store pictures && "
    "printf '{\"octreel\": \"session\", \"version\": 2, \"points\": [[10, 0, 0], [0, 20, 0]], "
    "\"ticks\": 2}\\n{\"tick\": 1, \"queries\": [{\"knearest\": 2, \"at\": [0, 0, 0], "
    "\"answer\": [0]}]}\\n' >answers.json && "
    "printf '{\"octreel\": \"session\", \"version\": 2, \"points\": {\"file\": \"classes.ply\"}, \"ticks\": 1}\\n"
    "' >cloud.json && "
    "printf '{\"octreel\": \"session\", \"version\": 2, \"player\": null, "
    "\"points\": [[1, 0, 0, 1], [2, 5, 0, 2]], \"velocities\": [[2, 1, 0, 0]], \"ticks\": 2}\\n"
    "{\"tick\": 1, \"edits\": [{\"insert\": {\"id\": 3, \"position\": [9, 9, 9]}}], "
    "\"foreign_nodes\": [{\"id\": 1, \"box\": {\"min\": [0, 0, 0], \"max\": [4, 4, 4]}, \"points\": [1, 7]}, "
    "{\"id\": 2, \"parent\": 1, \"box\": {\"min\": [0, 0, 0], \"max\": [4, 5, 4]}, \"kind\": \"leaf\"}], "
    "\"pairs\": [[1, 2], [9, 3]], "
    "\"queries\": [{\"range\": {\"min\": [0, 0, 0], \"max\": [9, 9, 9]}, \"answer\": [1, 8], "
    "\"visited\": [1], \"pruned\": [2], \"hit\": []}, "
    "{\"nearest\": [0, 0, 0], \"answer\": [2]}], \"shapes\": [{\"label\": \"here\", \"at\": [1, 2, 3]}]}\\n"
    "' >nodes.json && "
    "sed 's/\"hit\": \\[\\]/\"hit\": [1]/; s/9, 9, 9]}}/9, 9, 8]}}/; s/\\[4, 5, 4\\]/[4, 4, 4]/' "
    "nodes.json >nodes_other.json && "
    "\"$octreel\" record nodes.json " SMALL " --jobs 1 -o nodes && "
    "\"$octreel\" record nodes_other.json " SMALL " --jobs 1 -o nodes_other && "
    "\"$octreel\" record nodes.json --no-frames -o ticks && "
    "\"$octreel\" record nodes_other.json --no-frames -o ticks_other && "
    "cp -r nodes changed && cp nodes/frame_000000.png changed/frame_000002.png && "
    "sed -i '2s/\"points\": *[0-9]*/\"points\":7/' changed/ticks.jsonl && rm changed/frame_000000.png && "
    "mkdir frames frames_other && cp film/*.png frames && cp other/*.png frames_other && "
    "printf 'frame_000001.png\\n' >list && printf 'a\\n' >all && "
    "printf '{\"octreel\": \"session\", \"version\": 2, \"ticks\": 3, \"points\": [%s[0, 0, 0]], "
    "\"queries\": [%s{\"radius\": 9, \"at\": [0, 0, 0]}]}\\n' "
    "\"$(printf '[%d, 0, 0, 9007199254740%d], ' $(seq 100 899))\" "
    "\"$(printf '{\"radius\": %d, \"at\": [0, 0, 0]}, ' $(seq 1001 1040))\" >long.json";

/* The commands; each runs in a copy of the folder. With "-slow" the disk is slow, and only calls after that count. A
 * tick of long.json has a longer line than a socket has room for. */
static const struct {
    const char *name, *line;
} commands[] = {
    {"record", "record session.json " SMALL " --jobs 1 -o new >times"},
    {"record-jobs", "record session.json " SMALL " --jobs 2 -o new >times"},
    {"record-jobs-long", "record long.json " SMALL " --fill integers --jobs 2 -o new >times"},
    {"record-jobs-slow", "record long.json " SMALL " --fill integers --jobs 2 -o new >times"},
    {"record-aa", "record session.json " SMALL " --aa 2 --jobs 1 -o new >times"},
    {"record-replace", "record session.json --keys s " SMALL " --replace --jobs 1 -o film >times"},
    {"record-resume", "record --resume --jobs 1 -o half >times"},
    {"record-no-frames", "record session.json --no-frames -o new >times"},
    {"record-stream", "record - " SMALL " -o new <session.json >times"},
    {"record-cloud", "record cloud.json " SMALL " --jobs 1 -o new >times"},
    {"record-chunk", "record session.json --camera-from film --ticks 1:3 --jobs 1 -o new >times"},
    {"record-nodes", "record nodes.json " SMALL " --diagram beside --jobs 1 --json -o new >times"},
    {"verify", "verify film"},
    {"verify-changed", "verify changed"},
    {"verify-ticks", "verify ticks"},
    {"verify-json", "verify --json film"},
    {"inspect", "inspect points.xyz " SMALL " -o tree.png"},
    {"inspect-json", "inspect points.xyz " SMALL " --json -o tree.png"},
    {"inspect-classes", "inspect classes.ply --json"},
    {"inspect-asked", "inspect classes.ply " SMALL " --nodes nodes.csv --node root --nearest 0,0,0,2 "
                      "--radius 1,1,1,3 --range 0,0,0,2,2,2 -o tree.png"},
    {"inspect-asked-json", "inspect classes.ply --json --node root --nearest 0,0,0 --radius 1,1,1,3"},
    {"diff", "diff film other"},
    {"diff-nodes", "diff nodes nodes_other -o evidence"},
    {"diff-nodes-json", "diff nodes nodes_other --each --json"},
    {"diff-ticks", "diff ticks ticks_other --json"},
    {"diff-layers", "diff film other --ignore-layer nodes,text --antialias --max-delta 0.1"},
    {"diff-folders", "diff frames frames_other -o evidence"},
    {"diff-reports", "diff film other --json --junit diff.xml --markdown diff.md -o evidence"},
    {"audit", "audit answers.json"},
    {"audit-json", "audit nodes.json --json"},
    {"audit-reports", "audit nodes --html audit.html --junit audit.xml"},
    {"join", "join chunks >times"},
    {"film", "film film -o moving.png"},
    {"pick", "pick film/frame_000001.png 32 18"},
    {"pick-json", "pick nodes/frame_000001.png 32 18 --json"},
    {"play-cloud", "play cloud.json -o page.html"},
    {"play", "play session.json -o page.html"},
    {"accept", "accept film other"},
    {"accept-from", "accept film other --from list --json"},
    {"accept-new", "accept new film"},
    {"accept-one", "accept one.baseline film/frame_000001.png --reason why --date 2026-11-23"},
    {"accept-baseline", "accept film.baseline other --variant --reason why --date 2026-11-23 --store pictures"},
    {"diff-baseline", "diff film.baseline other --store pictures -o evidence"},
    {"help", "help session"},
    {"manual", "help --man record"},
    {"diff-flip", "diff film other --flip 0.001 --ignore 0,0,9,9 -o evidence"},
    {"accept-interactive", "accept film.baseline other --interactive --reason why --date 2026-11-23 <all"},
    {"diff-comment", "diff film other -o evidence --comment comment"},
};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

/* A kind of failure: its name, the variable of its number for the preloaded library, and its errors. */
static const struct family {
    const char *name, *variable;
    int errors[4], error_count;
} families[] = {
    {"memory", "FAIL_MEMORY", {ENOMEM}, 1},
    {"calls", "FAIL_CALL", {EIO, ENOSPC, EMFILE, EINTR}, 4},
    {"signals", "FAIL_SIGNAL", {0}, 1},
};

enum { FAMILIES = sizeof families / sizeof families[0] };

/* The options: of all allocations and calls of a command, number `first` and each `every`-th up to `last` fails. With
 * `sites` it is the first allocation or call of each call site, by one error; with `quick` a single one for each
 * command. */
static struct {
    uint64_t first, last, every;
    const char *only, *of; /* command and family; null: all */
    bool sites, quick;
} asked = {1, MOST, 1, NULL, NULL, false, false};

static void read_options(int argc, char **argv)
{
    static const struct option known[] = {{"first", required_argument, NULL, 'f'},
                                          {"last", required_argument, NULL, 'l'},
                                          {"every", required_argument, NULL, 'e'},
                                          {"command", required_argument, NULL, 'c'},
                                          {"of", required_argument, NULL, 'o'},
                                          {"sites", no_argument, NULL, 's'},
                                          {"quick", no_argument, NULL, 'q'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    for (int option; (option = getopt_long(argc, argv, "", known, NULL)) >= 0;)
        switch (option) {
        case 'f':
            asked.first = (uint64_t)parse_whole_number("--first", optarg, 1, MOST);
            break;
        case 'l':
            asked.last = (uint64_t)parse_whole_number("--last", optarg, 1, MOST);
            break;
        case 'e':
            asked.every = (uint64_t)parse_whole_number("--every", optarg, 1, MOST);
            break;
        case 'c':
            asked.only = optarg;
            break;
        case 'o':
            asked.of = optarg;
            break;
        case 's':
            asked.sites = true;
            break;
        case 'q':
            asked.quick = true;
            break;
        case 'h':
            puts("usage: octreel-failure-campaign [--of memory|calls|signals] [--command NAME]\n"
                 "                                [--first N] [--last N] [--every N | --sites | --quick]\n"
                 "Runs octreel's commands and makes one memory allocation or system call fail in each run, or stops "
                 "the\n"
                 "command: it must report the failure or work without, and must leave no damaged file.\n"
                 "  --of FAMILY     fail only allocations (memory) or system calls (calls), or only send SIGTERM "
                 "(signals)\n"
                 "  --first N       begin with the N-th allocation or call; default 1\n"
                 "  --last N        end with the N-th; default all\n"
                 "  --every N       then fail each N-th; default 1\n"
                 "  --sites         fail each call site once\n"
                 "  --quick         fail one allocation or one call of each command\n"
                 "  --command NAME  run only this command\n"
                 "Exit status: 0 no findings, 1 findings, 2 trouble. The commands:");
            for (size_t i = 0; i < COMMANDS; i++)
                printf("  %-18s octreel %s\n", commands[i].name, commands[i].line);
            exit_with_status(EXIT_DONE);
        default:
            exit(EXIT_TROUBLE); /* getopt has said why */
        }
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
}

/* ---- One run --------------------------------------------------------------------------------------------------- */

/* Run a line of octreel in "<folder>/run", a new copy of "<folder>/given". The n-th call of the kind fails; 0: none
 * fails; ULONG_MAX: none fails, and "<folder>/sites" lists the first call of each site. */
static command_result run_one(const char *folder, const char *environment, const char *line, const char *variable,
                              uint64_t n, int error)
{
    return run_script(
        "unset CI; cd %s && rm -rf run failed && cp -r given run && cd run && FAILED=../failed %s %s=%" PRIu64
        " FAIL_ERROR=%d %s LD_PRELOAD=../failing.so %s %s",
        folder, n == ULONG_MAX ? "FAIL_SITES=../sites" : "", variable, n, error, environment, octreel_program(), line);
}

static bool ends_with(const char *text, const char *end)
{
    const size_t length = strlen(text), part = strlen(end);
    return length >= part && strcmp(text + length - part, end) == 0;
}

static command_result run_command(const char *folder, size_t command, const char *variable, uint64_t n, int error)
{
    const char *environment = ends_with(commands[command].name, "-slow") ? "FAIL_SLOW=1" : "";
    return run_one(folder, environment, commands[command].line, variable, n, error);
}

/* Whether a file may have any contents: an unfinished file, a file that the next command removes, and files with the
 * renderer or times. */
static bool may_be_anything(const char *name)
{
    return *name == '.' || strcmp(name, "times") == 0 || strcmp(name, "octreel-replaced") == 0 ||
           ends_with(name, ".part") || ends_with(name, ".live") || strstr(name, ".part.") ||
           strstr(name, ".json.ticks_") || strcmp(name, "renderer.json") == 0;
}

/* Whether a file is acceptable. `whole` is the file of a run without a failure, or null. Logs, pages and reports may be
 * shorter than it, and so may the session of a stream, whose digest frames contain. */
static bool is_whole_so_far(const char *name, const char *bytes, size_t size, const char *whole)
{
    if (ends_with(name, ".png"))
        return size > 12 && memcmp(bytes + size - 8, "IEND", 4) == 0;
    if (ends_with(name, ".xml"))
        return ends_with(bytes, "</testsuites>\n");
    if (ends_with(name, ".md"))
        return ends_with(bytes, "\n");
    if (strcmp(name, "session.json") == 0)
        return ends_with(bytes, "}\n");
    if (ends_with(name, ".jsonl"))
        return *bytes == 0 || (whole && ends_with(bytes, "\n") && strncmp(bytes, whole, strlen(bytes)) == 0);
    return ends_with(name, ".html") && ends_with(bytes, "</html>\n");
}

static bool is_same(const char *path, const char *bytes, size_t size)
{
    size_t there = 0;
    char *other = file_exists(path) ? file_read(path, &there) : NULL;
    const bool same = other && there == size && memcmp(other, bytes, size) == 0;
    free(other);
    return same;
}

/* Returns the first file in the folder that is neither as before nor as after a run without a failure; "" if there is
 * none. */
static place find_torn(const char *folder, const char *below)
{
    place torn = {""};
    char run[600], given[600], whole[600];
    snprintf(run, sizeof run, "%s/run%s", folder, below);
    snprintf(given, sizeof given, "%s/given%s", folder, below);
    snprintf(whole, sizeof whole, "%s/whole%s", folder, below);
    listing names = folder_list(run);
    for (size_t i = 0; i < names.count && !*torn.path; i++) {
        const char *name = names.names[i];
        const place file = place_below(run, name), done = place_below(whole, name);
        char deeper[600];
        snprintf(deeper, sizeof deeper, "%s/%s", below, name);
        if (may_be_anything(name))
            continue;
        if (is_real_folder(file.path)) {
            torn = find_torn(folder, deeper);
            continue;
        }
        size_t size;
        char *bytes = file_read(file.path, &size);
        char *expected = file_exists(done.path) ? file_read(done.path, NULL) : NULL;
        if (!is_same(place_below(given, name).path, bytes, size) && !is_same(done.path, bytes, size) &&
            !is_whole_so_far(name, bytes, size, expected))
            snprintf(torn.path, sizeof torn.path, "%s", deeper + 1);
        free(bytes);
        free(expected);
    }
    listing_release(&names);
    return torn;
}

/* ---- Judged ---------------------------------------------------------------------------------------------------- */

static bool is_one_sentence(const char *said)
{
    const char *end = strchr(said, '\n');
    return strncmp(said, "octreel: ", 9) == 0 && end && end[1] == 0;
}

/* Whether two runs printed the same, except for the name of the context, if one replaced another. */
static bool is_same_output(const command_result *run, const command_result *without)
{
    static const char member[] = "\"drawn_now\": \"";
    const char *drawer = strstr(run->out, member), *usual = strstr(without->out, member);
    if (!drawer || !usual || !strstr(run->err, "drawing with "))
        return strcmp(run->out, without->out) == 0;
    return drawer - run->out == usual - without->out &&
           memcmp(run->out, without->out, (size_t)(drawer - run->out)) == 0 &&
           strcmp(strchr(drawer, ','), strchr(usual, ',')) == 0;
}

/* Returns why a run is wrong; null: it is right. `without` is the run without a failure. */
static const char *judge(const command_result *run, const command_result *without, const char *torn,
                         bool may_be_stopped)
{
    if (run->status >= 128 && !(may_be_stopped && run->status == 128 + SIGTERM))
        return "was ended by a signal";
    if (*torn)
        return "left a file that is neither the old one nor a whole new one";
    if (run->status >= 128)
        return NULL;
    if (run->status == EXIT_FINDING && without->status == EXIT_FINDING)
        return strncmp(run->out, without->out, VERDICT) == 0 ? NULL : "gave another verdict";
    if (run->status == without->status)
        return ends_with(run->err, without->err) && is_same_output(run, without) ? NULL : "said something else";
    if (run->status != EXIT_TROUBLE)
        return "found what it could not find";
    return is_one_sentence(run->err) ? NULL : "did not say one sentence";
}

/* Print the command and its output. */
static void tell(const char *folder, const char *name, const char *variable, uint64_t n, int error,
                 const command_result *run, const char *why)
{
    char path[600];
    snprintf(path, sizeof path, "%s/failed", folder);
    char *calls = file_read(path, NULL);
    printf("%s: with %s=%" PRIu64 " and \"%s\" it %s: status %d, \"%s\"\n%s", name, variable, n, strerror(error), why,
           run->status, run->err, calls);
    fflush(stdout);
    free(calls);
}

/* Returns whether the command made n calls. */
static bool fail_one(const char *folder, size_t command, const struct family *family, uint64_t n, int error,
                     const command_result *without, size_t *findings)
{
    char failed[600];
    command_result run = run_command(folder, command, family->variable, n, error);
    snprintf(failed, sizeof failed, "%s/failed", folder);
    const bool there = file_exists(failed);
    const place torn = there ? find_torn(folder, "") : (place){""};
    const bool may_be_stopped = strcmp(family->name, "signals") == 0;
    const char *why = there ? judge(&run, without, torn.path, may_be_stopped) : NULL;
    if (why && (*findings)++ < MOST_FINDINGS)
        tell(folder, *torn.path ? torn.path : commands[command].name, family->variable, n, error, &run, why);
    command_release(&run);
    return there;
}

static int error_by_turns(const struct family *family, size_t turn)
{
    return family->errors[turn % (size_t)family->error_count];
}

/* Let the first call of each site fail, with one error after the other. Returns the number of runs. */
static size_t fail_sites(const char *folder, size_t command, const struct family *family, const command_result *without,
                         size_t *findings)
{
    size_t runs = 0;
    char path[600];
    snprintf(path, sizeof path, "%s/sites", folder);
    remove(path);
    command_result counted = run_command(folder, command, family->variable, ULONG_MAX, 0);
    command_release(&counted);
    char *sites = file_read(path, NULL), *end = sites;
    for (uint64_t n; (n = strtoull(end, &end, 10)) > 0; runs++)
        fail_one(folder, command, family, n, error_by_turns(family, runs + command), without, findings);
    free(sites);
    return runs;
}

/* Returns the number of wrong runs. */
static size_t fail_each(const char *folder, size_t command, const struct family *family)
{
    size_t findings = 0, runs = 0;
    command_result without = run_command(folder, command, family->variable, 0, 0);
    const command_result kept = run_script("cd %s && rm -rf whole && mv run whole", folder);
    assert_int_equal(kept.status, 0);
    assert_true(without.status <= 1);
    bool there = !asked.sites && !asked.quick;
    if (asked.sites)
        runs = fail_sites(folder, command, family, &without, &findings);
    if (asked.quick)
        runs = fail_one(folder, command, family, asked.first + command % 8, error_by_turns(family, command / FAMILIES),
                        &without, &findings);
    for (uint64_t n = asked.first; n <= asked.last && there; n += asked.every)
        for (int i = 0; i < family->error_count && there; i++, runs += there)
            there = fail_one(folder, command, family, n, family->errors[i], &without, &findings);
    printf("%-18s %5zu failures of %-6s %zu findings\n", commands[command].name, runs, family->name, findings);
    assert_true(runs > 0 || asked.first > MOST);
    fflush(stdout);
    command_release(&without);
    return findings;
}

/* Paths with blanks cannot be preloaded: the library is copied, and named relative to the folder of the run. */
static void prepare(const temp_folder *own)
{
    const shell_word library = shell_quote(OCTREEL_FAILING);
    command_result made =
        run_script("octreel=%s; cd %s && cp %s failing.so && %s", octreel_program(), own->name, library.text, PREPARE);
    if (made.status != 0)
        fail_msg("%s", made.err);
    command_release(&made);
}

/* Whether a command is tested with a kind of failure: without WebAssembly no page can be made, and a quick campaign
 * takes one kind per command in turn. */
static bool is_asked(size_t command, const struct family *family)
{
    return (!asked.quick || family == &families[command % FAMILIES]) &&
           (!asked.only || strcmp(asked.only, commands[command].name) == 0) &&
           (!asked.of || strcmp(asked.of, family->name) == 0) &&
           (page_can_play() || strncmp(commands[command].line, "play", 4) != 0);
}

static void failed_call_is_an_error_and_leaves_whole_files(void **state)
{
    const temp_folder *own = *state;
    size_t findings = 0;
    prepare(own);
    for (size_t of = 0; of < FAMILIES; of++)
        for (size_t i = 0; i < COMMANDS; i++)
            if (is_asked(i, &families[of]))
                findings += fail_each(own->name, i, &families[of]);
    assert_int_equal(findings, 0);
}

/* llvmpipe would wait for the first missing thread forever. */
static void work_is_done_if_threads_cannot_be_started(void **state)
{
    static const char *const lines[] = {"verify film", "inspect points.xyz " SMALL " --fill gl -o tree.png",
                                        "diff film film"};
    const temp_folder *own = *state;
    prepare(own);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        command_result with = run_one(own->name, "", lines[i], "FAIL_THREAD", 0, 0);
        for (uint64_t n = 1; n <= 2; n++) {
            command_result without = run_one(own->name, "", lines[i], "FAIL_THREAD", n, 0);
            assert_true(file_exists(place_in(own, "failed").path) || n > 1 || i == 2);
            assert_int_equal(without.status, 0);
            assert_string_equal(without.out, with.out);
            command_release(&without);
        }
        command_release(&with);
    }
}

static int make_folder(void **state)
{
    return temp_folder_make(state);
}

int main(int argc, char **argv)
{
    read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(failed_call_is_an_error_and_leaves_whole_files, make_folder,
                                        nested_folder_remove),
        cmocka_unit_test_setup_teardown(work_is_done_if_threads_cannot_be_started, make_folder, nested_folder_remove),
    };
    exit_with_status(cmocka_run_group_tests(tests, NULL, NULL) ? EXIT_FINDING : EXIT_DONE);
}
