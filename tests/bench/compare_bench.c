/* SPDX-License-Identifier: MIT */
/* compare_bench.c - octreel-compare-bench: what a comparison of equal pictures costs, as a multiple of reading the
 * reference with libpng and memcmp(). */
#include "measuring.h"
#include "octreel/compare.h"
#include "program.h"

#include <errno.h>
#include <getopt.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char program_name[] = "octreel-compare-bench";

enum { ROUNDS_AT_MOST = 1000 };
enum { SMOOTH, DRAWN, NOISY, PICTURES };

/* How files store the pixels. */
typedef enum storage { RGB, RGBA, PALETTE, STORAGES } storage;
static const char *const storage_names[STORAGES] = {[RGB] = "RGB", [RGBA] = "RGBA", [PALETTE] = "palette"};
static const int color_types[STORAGES] = {
    [RGB] = PNG_COLOR_TYPE_RGB, [RGBA] = PNG_COLOR_TYPE_RGB_ALPHA, [PALETTE] = PNG_COLOR_TYPE_PALETTE};

/* A picture in memory with 3 or 4 samples a pixel, and two files of it that differ in their compression only. */
typedef struct picture {
    storage storage;
    int width, height, samples;
    size_t size; /* of the pixels in bytes */
    unsigned char *pixels, *read[2];
    char files[2][80];
} picture;

/* ---- Pictures ------------------------------------------------------------------------------------------------- */

static unsigned sample_at(int content, int x, int y, int i, unsigned *random)
{
    *random = *random * 1664525u + 1013904223u;
    if (content == NOISY)
        return (unsigned)(x / 5 + y / 3 + i * 40) + (*random >> 29);
    if (content == DRAWN)
        return ((x / 40 + y / 40) % 2 ? 200u : 40u) + (unsigned)(10 * i) + (x % 40 == y % 40 ? 15u : 0);
    return (unsigned)(x / 5 + y / 3 + i * 40);
}

/* The palette of DRAWN, which has four colours, and a pixel's index in it. */
static const png_color palette[] = {{40, 50, 60}, {55, 65, 75}, {200, 210, 220}, {215, 225, 235}};

static png_byte find_index(const unsigned char *pixel)
{
    png_byte index = 0;
    while (palette[index].red != *pixel)
        index++;
    return index;
}

static void write_row(png_structp png, const picture *p, const unsigned char *row)
{
    png_byte indices[1280];
    for (int x = 0; p->storage == PALETTE && x < p->width; x++)
        indices[x] = find_index(row + x * p->samples);
    png_write_row(png, p->storage == PALETTE ? indices : row);
}

static void write_file(const picture *p, const char *path, int level, int filters)
{
    FILE *file = fopen(path, "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!file || !info || setjmp(png_jmpbuf(png)) != 0)
        stop_with_error("%s: cannot be written: %s", path, strerror(errno));
    png_init_io(png, file);
    png_set_compression_level(png, level);
    png_set_filter(png, 0, filters);
    png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height, 8, color_types[p->storage],
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (p->storage == PALETTE)
        png_set_PLTE(png, info, palette, sizeof palette / sizeof *palette);
    png_write_info(png, info);
    for (int y = 0; y < p->height; y++)
        write_row(png, p, p->pixels + (size_t)y * (size_t)(p->width * p->samples));
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    if (fclose(file) != 0)
        stop_with_error("%s: cannot be written: %s", path, strerror(errno));
}

static picture make_picture(const char *folder, int content, storage storage, bool quick)
{
    picture p = {.storage = storage, .width = quick ? 64 : 1280, .height = quick ? 36 : 720};
    const int samples = p.samples = storage == RGBA ? 4 : 3;
    unsigned random = 1;
    p.size = (size_t)(p.width * p.height * samples);
    p.pixels = resize_memory(NULL, p.size);
    p.read[0] = resize_memory(NULL, p.size);
    p.read[1] = resize_memory(NULL, p.size);
    for (size_t n = 0; n < p.size; n++) {
        const int i = (int)n % samples, at = (int)n / samples;
        p.pixels[n] = (unsigned char)(i == 3 ? 255 : sample_at(content, at % p.width, at / p.width, i, &random));
    }
    for (int i = 0; i < 2; i++) {
        snprintf(p.files[i], sizeof p.files[i], "%s/%d.png", folder, i);
        write_file(&p, p.files[i], i ? 9 : 6, i ? PNG_FILTER_UP : PNG_ALL_FILTERS);
    }
    return p;
}

/* ---- What is timed -------------------------------------------------------------------------------------------- */

/* Read one of the files as a program without this library would, into p->read. */
static void read_file(const picture *p, int which)
{
    const char *path = p->files[which];
    FILE *file = fopen(path, "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!file || !info || setjmp(png_jmpbuf(png)) != 0)
        stop_with_error("%s: cannot be read: %s", path, strerror(errno));
    png_init_io(png, file);
    png_read_info(png, info);
    if (p->storage == PALETTE)
        png_set_palette_to_rgb(png);
    for (int y = 0; y < p->height; y++)
        png_read_row(png, p->read[which] + (size_t)y * (size_t)(p->width * p->samples), NULL);
    png_read_end(png, info);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
}

static bool compare_pixels_by_hand(const picture *p)
{
    read_file(p, 0);
    return memcmp(p->read[0], p->pixels, p->size) == 0;
}

static bool compare_files_by_hand(const picture *p)
{
    read_file(p, 0);
    read_file(p, 1);
    return memcmp(p->read[0], p->read[1], p->size) == 0;
}

static bool compare_pixels_to_file(const picture *p)
{
    const octreel_pixels pixels =
        octreel_make_pixels(p->pixels, p->width, p->height, p->samples == 4 ? OCTREEL_RGBA8 : OCTREEL_RGB8);
    return octreel_compare_pixels_to_file(&pixels, p->files[0], NULL, NULL) == OCTREEL_VERDICT_SAME;
}

static bool compare_files(const picture *p)
{
    return octreel_compare_files(p->files[1], p->files[0], NULL, NULL) == OCTREEL_VERDICT_SAME;
}

static bool compare_equal_files(const picture *p)
{
    return octreel_compare_files(p->files[0], p->files[0], NULL, NULL) == OCTREEL_VERDICT_SAME;
}

typedef bool comparer(const picture *p);

/* Each way of comparing, and the same work by hand. */
static const struct {
    const char *name;
    comparer *compare, *by_hand;
} ways[] = {
    {"pixels and a file", compare_pixels_to_file, compare_pixels_by_hand},
    {"files, equal pixels", compare_files, compare_files_by_hand},
    {"files, equal bytes", compare_equal_files, compare_files_by_hand},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

static double time_once(comparer *compare, const picture *p)
{
    const double start = processor_time();
    if (!compare(p))
        stop_with_error("pictures that are equal were found to differ");
    return (processor_time() - start) * 1e-6;
}

/* Time the two in turn. Prints medians, and the median of the ratios of the rounds. */
static void measure(const char *content, const picture *p, int way, int rounds)
{
    static double ours[ROUNDS_AT_MOST], theirs[ROUNDS_AT_MOST], ratios[ROUNDS_AT_MOST];
    double sum = 0;
    for (int i = 0; i < rounds; i++) {
        theirs[i] = time_once(ways[way].by_hand, p);
        ours[i] = time_once(ways[way].compare, p);
        ratios[i] = ours[i] / theirs[i];
        sum += ours[i];
    }
    const size_t count = (size_t)rounds;
    printf("%-8s %-8s %-20s %10.2f %10.2f %8.2f %12.1f\n", content, storage_names[p->storage], ways[way].name,
           median(theirs, count), median(ours, count), median(ratios, count), sum / rounds);
}

static void measure_all(const char *folder, int rounds, bool quick)
{
    static const char *const names[PICTURES] = {[SMOOTH] = "smooth", [DRAWN] = "drawn", [NOISY] = "noisy"};
    printf("%-8s %-8s %-20s %10s %10s %8s %12s\n", "picture", "file", "compared", "libpng ms", "octreel ms", "ratio",
           "s for 1,000");
    for (int content = SMOOTH; content < PICTURES; content++) {
        for (storage storage = RGB; storage < STORAGES; storage++) {
            if (storage == PALETTE && content != DRAWN)
                continue; /* it has too many colours */
            picture p = make_picture(folder, content, storage, quick);
            for (int way = 0; way < WAYS; way++)
                measure(names[content], &p, way, rounds);
            free(p.pixels);
            free(p.read[0]);
            free(p.read[1]);
            unlink(p.files[0]);
            unlink(p.files[1]);
        }
    }
}

static void print_help(void)
{
    printf(
        "octreel-compare-bench - comparisons of equal pictures of 1280x720 by liboctreel-compare, in turn with "
        "reading\n"
        "the same files with libpng and memcmp()\n\n"
        "Times are processor times of one comparison: the medians. The ratio is the median of the rounds' ratios.\n\n"
        "usage: octreel-compare-bench [OPTION ...]\n\n"
        "      --rounds N  time each N times (default 31; at most %d)\n"
        "      --quick     use small pictures: times are meaningless, verdicts are still checked\n"
        "  -h, --help\n\n"
        "Exit status: 0 done, 2 a verdict is wrong, or trouble.\n",
        ROUNDS_AT_MOST);
}

int main(int argc, char **argv)
{
    static const struct option options[] = {{"rounds", required_argument, NULL, 'r'},
                                            {"quick", no_argument, NULL, 'q'},
                                            {"help", no_argument, NULL, 'h'},
                                            {NULL, 0, NULL, 0}};
    char folder[] = "compare_bench_XXXXXX";
    int rounds = 31;
    bool quick = false;
    for (int option; (option = getopt_long(argc, argv, "h", options, NULL)) != -1;) {
        if (option == '?')
            return EXIT_TROUBLE; /* getopt has said why */
        if (option == 'h') {
            print_help();
            exit_with_status(EXIT_DONE);
        }
        if (option == 'r')
            rounds = (int)parse_whole_number("--rounds", optarg, 1, ROUNDS_AT_MOST);
        quick = quick || option == 'q';
    }
    if (!mkdtemp(folder))
        stop_with_error("cannot create a folder for the pictures: %s", strerror(errno));
    measure_all(folder, rounds, quick);
    rmdir(folder);
    exit_with_status(EXIT_DONE);
}
