/* SPDX-License-Identifier: MIT */
/* cloud_campaign.c - runs octreel inspect on point clouds damaged at random: from a file or a pipe; LAZ through the
 * process that decompresses it, if liblaszip is installed.
 *
 * Each cloud is read, with status 0, or refused with status 2 and one sentence of printable characters, within a time
 * and with an amount of memory that suffice for any small file; no command is ended by a signal. */
#include <getopt.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "program.h"

const char program_name[] = "octreel-cloud-campaign";

enum { SECONDS = 20, MOST_FINDINGS = 10, MOST_CHANGES = 4 };

/* AddressSanitizer reserves the whole address space. */
#ifdef OCTREEL_SANITIZED
#define LIMIT "unlimited"
#else
#define LIMIT "2000000" /* kB */
#endif

static struct {
    uint64_t seed, files;
} asked = {1, 1000};

static void read_options(int argc, char **argv)
{
    static const struct option known[] = {{"seed", required_argument, NULL, 's'},
                                          {"files", required_argument, NULL, 'f'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    for (int option; (option = getopt_long(argc, argv, "", known, NULL)) >= 0;)
        switch (option) {
        case 's':
            asked.seed = (uint64_t)parse_whole_number("--seed", optarg, 0, 1e15);
            break;
        case 'f':
            asked.files = (uint64_t)parse_whole_number("--files", optarg, 1, 1e12);
            break;
        case 'h':
            puts("usage: octreel-cloud-campaign [--seed N] [--files N]\n"
                 "Damages the point clouds of tests/fuzz/corpus/cloud at random and runs octreel inspect on each.\n"
                 "Exit status: 0 no findings, 1 findings, 2 trouble.");
            exit_with_status(EXIT_DONE);
        default:
            exit(EXIT_TROUBLE); /* getopt has said why */
        }
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
}

/* ---- Damage ---------------------------------------------------------------------------------------------------- */

static uint64_t random_state;

static uint64_t below(uint64_t limit)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (random_state >> 33) % limit;
}

typedef struct damaged {
    char bytes[16384];
    size_t size;
} damaged;

/* Write an unusual number for a count or an offset, of 1 to 8 bytes. */
static void put_extreme(damaged *d, size_t at)
{
    static const uint64_t extremes[] = {0, 1, 0x7f, 0xff, 0x7fffffff, 0xffffffff, UINT64_MAX, 1000000000000};
    const uint64_t number = extremes[below(8)];
    const size_t size = (size_t)1 << below(4);
    if (at + size <= d->size)
        memcpy(d->bytes + at, &number, size);
}

/* Copy some bytes to another place. */
static void repeat_bytes(damaged *d, size_t from, size_t at)
{
    const size_t most = d->size - from, size = 1 + (size_t)below(most < 64 ? most : 64);
    char piece[64];
    if (d->size + size > sizeof d->bytes)
        return;
    memcpy(piece, d->bytes + from, size);
    memmove(d->bytes + at + size, d->bytes + at, d->size - at);
    memcpy(d->bytes + at, piece, size);
    d->size += size;
}

static void change(damaged *d)
{
    const size_t at = (size_t)below(d->size);
    switch (below(6)) {
    case 0:
        d->size = at > 0 ? at : 1;
        break;
    case 1:
        repeat_bytes(d, (size_t)below(d->size), at);
        break;
    case 2:
        d->bytes[at] = (char)below(256);
        break;
    case 3:
        d->bytes[at] ^= (char)(1 << below(8));
        break;
    default:
        put_extreme(d, at);
    }
}

enum { NAME_SIZE = 16 };

/* The first line of a file of the corpus is the suffix of the file's name, or empty; the rest is the file. */
static damaged read_seed(const char *path, char name[NAME_SIZE])
{
    damaged d = {.size = 0};
    size_t size;
    char *bytes = file_read(path, &size);
    const size_t suffix = strcspn(bytes, "\n");
    assert_true(suffix + 1 < size && size - suffix - 1 <= sizeof d.bytes);
    snprintf(name, NAME_SIZE, "fuzz%s%.*s", suffix ? "." : "", (int)suffix, bytes);
    d.size = size - suffix - 1;
    memcpy(d.bytes, bytes + suffix + 1, d.size);
    free(bytes);
    return d;
}

/* ---- Judged ---------------------------------------------------------------------------------------------------- */

static bool is_one_line(const char *text)
{
    const char *end = text;
    while ((*end >= ' ' && *end <= '~') || (*end & 0x80))
        end++;
    return strncmp(text, "octreel: ", 9) == 0 && end[0] == '\n' && end[1] == 0;
}

/* Returns why a run is wrong; null: it is right. A note about data after the points is allowed. */
static const char *judge(const command_result *run)
{
    if (run->status == 124)
        return "takes too long";
    if (run->status != EXIT_DONE && run->status != EXIT_TROUBLE)
        return "ends with another status";
    if (run->status == EXIT_TROUBLE && *run->out)
        return "is refused and told";
    return *run->err == 0 || is_one_line(run->err)
               ? run->status == EXIT_TROUBLE && *run->err == 0 ? "is refused without a word" : NULL
               : "is told in more than a line";
}

static void damaged_cloud_is_read_or_refused(void **state)
{
    const temp_folder *own = *state;
    listing seeds = folder_list(OCTREEL_CLOUD_CORPUS);
    size_t findings = 0, read = 0;
    random_state = asked.seed;
    for (uint64_t i = 0; i < asked.files && findings < MOST_FINDINGS; i++) {
        char name[NAME_SIZE];
        damaged d = read_seed(place_below(OCTREEL_CLOUD_CORPUS, seeds.names[i % seeds.count]).path, name);
        const place file = place_in(own, name);
        for (uint64_t left = 1 + below(MOST_CHANGES); left > 0; left--)
            change(&d);
        file_write(file.path, d.bytes, d.size);
        command_result run = run_script("ulimit -v " LIMIT "; cd %s; exec timeout %d %s inspect %s --json <%s",
                                        own->name, SECONDS, octreel_program(), below(4) ? name : "-", name);
        const char *why = judge(&run);
        if (why) {
            char path[64];
            snprintf(path, sizeof path, "octreel-cloud-finding-%zu", findings++);
            file_write(path, d.bytes, d.size);
            printf("%s, called %s: %s: status %d, \"%s\"\n", path, name, why, run.status, run.err);
        }
        read += run.status == EXIT_DONE;
        command_release(&run);
    }
    printf("%llu clouds, %zu of them read, %zu findings\n", (unsigned long long)asked.files, read, findings);
    listing_release(&seeds);
    assert_int_equal(findings, 0);
    assert_true(read > 0);
}

int main(int argc, char **argv)
{
    read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(damaged_cloud_is_read_or_refused, temp_folder_make, nested_folder_remove),
    };
    exit_with_status(cmocka_run_group_tests(tests, NULL, NULL) ? EXIT_FINDING : EXIT_DONE);
}
