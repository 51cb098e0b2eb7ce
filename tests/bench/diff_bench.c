/* SPDX-License-Identifier: MIT */
/* diff_bench.c - octreel-diff-bench: compares octreel diff with cmp, odiff and ImageMagick on the same pictures, in
 * turn. */
#include "png_read.h"
#include "png_write.h"
#include "measuring.h"
#include "program.h"
#include "run_program.h"

#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char program_name[] = "octreel-diff-bench";

enum { ROUNDS_AT_MOST = 99, ARGUMENTS = 24, PATH_ROOM = 512 };

/* A program that compares, and the exit status by which it says "different". */
typedef struct contender {
    const char *name, *program;
    const char *before[4], *behind[2]; /* arguments before the two files, and behind them */
    int different;
    bool there;
    double ms[ROUNDS_AT_MOST], cpu[ROUNDS_AT_MOST];
    long peak_kb;
    int status;
} contender;

enum { OCTREEL, CMP, ODIFF, MAGICK, CONTENDERS };

typedef struct bench {
    contender of[CONTENDERS];
    char folder[64];
    int rounds;
    bool quick, failed;
} bench;

static void print_help(void)
{
    printf(
        "octreel-diff-bench - octreel diff, timed beside cmp, odiff (npm odiff-bin) and ImageMagick's compare, where\n"
        "those are installed: whole programs, in turn, on the same frames\n\n"
        "Each time is a median: by the clock on the wall / of the processors, in all threads.\n\n"
        "usage: octreel-diff-bench [OPTION ...]\n\n"
        "      --odiff PATH  the odiff binary, not npm's wrapper script (default: odiff)\n"
        "      --rounds N    run each N times and take the median (default 15; at most %d)\n"
        "      --quick       use small frames: times are meaningless, verdicts are still checked\n"
        "  -h, --help\n\n"
        "Exit status: 0 done, 1 a verdict of octreel diff is wrong, 2 trouble.\n",
        ROUNDS_AT_MOST);
}

/* ---- Frames --------------------------------------------------------------------------------------------------- */

static char *path_in(const bench *b, const char *name, char path[PATH_ROOM])
{
    snprintf(path, PATH_ROOM, "%s/%s", b->folder, name);
    return path;
}

static bool run_quietly(const char *const *argv)
{
    program_run run;
    if (run_program(argv, &run) && run.status == 0)
        return true;
    fprintf(stderr, "octreel-diff-bench: %s %s failed\n", argv[0], argv[1]);
    return false;
}

/* The default session, or its first ticks with these keys. */
static bool record(const bench *b, const char *name, const char *keys, const char *size, const char *aa)
{
    char path[PATH_ROOM];
    const char *const argv[] = {
        OCTREEL_PROGRAM,        "record", "-o", path_in(b, name, path), "--size", size, "--aa", aa,
        keys ? "--keys" : NULL, keys,     NULL};
    return run_quietly(argv);
}

static bool copy(const bench *b, const char *from, const char *to)
{
    char source[PATH_ROOM], target[PATH_ROOM];
    const char *const argv[] = {"cp", "-r", path_in(b, from, source), path_in(b, to, target), NULL};
    return run_quietly(argv);
}

/* Shift the background, which is on every line, by 32 levels of green. */
static bool shift_palette(const bench *b, const char *from, const char *to)
{
    char source[PATH_ROOM], target[PATH_ROOM];
    image picture;
    octreel_error error = {""};
    bool ok = image_read_png(path_in(b, from, source), &picture, &error);
    if (ok) {
        picture.palette.colors[0].g = (uint8_t)(picture.palette.colors[0].g + 32);
        ok = image_write_png(&picture, path_in(b, to, target), NULL, 0, &error);
        image_release(&picture);
    }
    if (!ok)
        fprintf(stderr, "octreel-diff-bench: %s\n", error.text);
    return ok;
}

/* ---- Measuring ------------------------------------------------------------------------------------------------ */

static double median_of(const double *values, int rounds)
{
    double sorted[ROUNDS_AT_MOST];
    memcpy(sorted, values, (size_t)rounds * sizeof *sorted);
    return median(sorted, (size_t)rounds);
}

static void run_once(contender *c, const char *x, const char *y, int round)
{
    const char *argv[ARGUMENTS];
    int count = 0;
    program_run run = {.status = -1};
    argv[count++] = c->program;
    for (int i = 0; i < 4 && c->before[i]; i++)
        argv[count++] = c->before[i];
    argv[count++] = x;
    argv[count++] = y;
    for (int i = 0; i < 2 && c->behind[i]; i++)
        argv[count++] = c->behind[i];
    argv[count] = NULL;
    c->there = c->there && run_program(argv, &run);
    c->ms[round] = run.ms;
    c->cpu[round] = run.cpu;
    c->peak_kb = run.peak_kb;
    c->status = run.status;
}

/* Print one line: the compared pictures, and the time and verdict of each program. Octreel's verdict must be right. */
static void compare(bench *b, const char *what, const char *x, const char *y, bool differs, unsigned who)
{
    char of_x[PATH_ROOM], of_y[PATH_ROOM];
    for (int round = 0; round < b->rounds; round++)
        for (int i = 0; i < CONTENDERS; i++)
            if ((who >> i & 1) && b->of[i].there)
                run_once(&b->of[i], path_in(b, x, of_x), path_in(b, y, of_y), round);
    printf("%-42s", what);
    for (int i = 0; i < CONTENDERS; i++) {
        const contender *c = &b->of[i];
        if ((who >> i & 1) && c->there)
            printf("  %s %.1f/%.1f ms %s", c->name, median_of(c->ms, b->rounds), median_of(c->cpu, b->rounds),
                   c->status == 0              ? "same"
                   : c->status == c->different ? "different"
                                               : "trouble");
    }
    printf("; octreel's peak %ld kB\n", b->of[OCTREEL].peak_kb);
    fflush(stdout);
    if (b->of[OCTREEL].status != (differs ? b->of[OCTREEL].different : 0)) {
        fprintf(stderr, "octreel-diff-bench: octreel's verdict is wrong: %s\n", what);
        b->failed = true;
    }
}

static const unsigned everybody = (1u << CONTENDERS) - 1;

static bool compare_pairs(bench *b, const char *size, const char *aa)
{
    const char *kind = strcmp(aa, "1") == 0 ? "indexed" : "RGB";
    char x[PATH_ROOM / 2], y[PATH_ROOM / 2], z[PATH_ROOM / 2], fx[PATH_ROOM / 2], fy[PATH_ROOM / 2], fz[PATH_ROOM / 2];
    char what[PATH_ROOM];
    snprintf(x, sizeof x, "%s_%s_x", size, kind);
    snprintf(y, sizeof y, "%s_%s_y", size, kind);
    snprintf(z, sizeof z, "%s_%s_z", size, kind);
    if (!record(b, x, "dd", size, aa) || !record(b, y, "ww", size, aa) || !copy(b, x, z))
        return false;
    snprintf(fx, sizeof fx, "%.200s/frame_000002.png", x);
    snprintf(fy, sizeof fy, "%.200s/frame_000002.png", y);
    snprintf(fz, sizeof fz, "%.200s/frame_000002.png", z);
    snprintf(what, sizeof what, "identical, %s, %s", size, kind);
    compare(b, what, fx, fz, false, everybody);
    snprintf(what, sizeof what, "different, %s, %s", size, kind);
    compare(b, what, fx, fy, true, everybody);
    return true;
}

/* Compare all frames of the default session, three of them replaced; then only these three. */
static bool compare_folders(bench *b)
{
    static const char *const pairs[][2] = {
        {"film_a/frame_000010.png", "film_b/frame_000011.png"},
        {"film_a/frame_000120.png", "film_b/frame_000121.png"},
        {"film_a/frame_000230.png", "film_b/frame_000231.png"},
    };
    if (!record(b, "film_a", NULL, b->quick ? "64x36" : "1280x720", "1") || !copy(b, "film_a", "film_b"))
        return false;
    compare(b, "two equal recordings of 253 frames", "film_a", "film_b", false, 1u << OCTREEL);
    compare(b, "one of the three pairs alone", pairs[0][0], pairs[0][1], true, 1u << OCTREEL);
    for (int i = 0; i < 3; i++) {
        char replaced[PATH_ROOM / 2];
        snprintf(replaced, sizeof replaced, "film_b/%s", strchr(pairs[i][0], '/') + 1);
        if (!copy(b, pairs[i][1], replaced))
            return false;
    }
    compare(b, "the same with three of them different", "film_a", "film_b", true, 1u << OCTREEL);
    if (!shift_palette(b, "film_a/frame_000000.png", "shifted.png"))
        return false;
    compare(b, "a palette change of 32 levels of green", "film_a/frame_000000.png", "shifted.png", true, everybody);
    return true;
}

static void tell_who_is_missing(const bench *b)
{
    for (int i = 0; i < CONTENDERS; i++)
        if (!b->of[i].there)
            printf("%s is left out: there is no %s\n", b->of[i].name, b->of[i].program);
}

static bool run_all(bench *b)
{
    static const char *const sizes[2][2] = {{"1280x720", "3840x2160"}, {"160x90", "320x180"}};
    bool ok = true;
    for (int i = 0; ok && i < 2; i++)
        ok = compare_pairs(b, sizes[b->quick][i], "1") && compare_pairs(b, sizes[b->quick][i], "2");
    return ok && compare_folders(b);
}

int main(int argc, char **argv)
{
    static const struct option options[] = {{"odiff", required_argument, NULL, 'o'},
                                            {"rounds", required_argument, NULL, 'r'},
                                            {"quick", no_argument, NULL, 'q'},
                                            {"help", no_argument, NULL, 'h'},
                                            {NULL, 0, NULL, 0}};
    bench b = {.of = {[OCTREEL] = {.name = "octreel", .program = OCTREEL_PROGRAM, .before = {"diff"}, .different = 1},
                      [CMP] = {.name = "cmp", .program = "cmp", .before = {"-s"}, .different = 1},
                      [ODIFF] = {.name = "odiff", .program = "odiff", .different = 22},
                      [MAGICK] = {.name = "ImageMagick",
                                  .program = "compare",
                                  .before = {"-metric", "AE"},
                                  .behind = {"null:"},
                                  .different = 1}},
               .rounds = 15};
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        if (option == 'h') {
            print_help();
            exit_with_status(EXIT_DONE);
        }
        if (option == '?')
            return EXIT_TROUBLE; /* getopt has said why */
        if (option == 'o')
            b.of[ODIFF].program = optarg;
        if (option == 'r')
            b.rounds = (int)parse_whole_number("--rounds", optarg, 1, ROUNDS_AT_MOST);
        b.quick |= option == 'q';
    }
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
    for (int i = 0; i < CONTENDERS; i++)
        b.of[i].there = program_exists(b.of[i].program);
    tell_who_is_missing(&b);
    strcpy(b.folder, "diff_bench_XXXXXX");
    if (!mkdtemp(b.folder))
        stop_with_error("cannot create a folder for the frames: %s", strerror(errno));
    const bool ok = run_all(&b);
    const char *const clean_up[] = {"rm", "-r", b.folder, NULL};
    exit_with_status(run_quietly(clean_up) && ok ? (b.failed ? EXIT_FINDING : EXIT_DONE) : EXIT_TROUBLE);
}
