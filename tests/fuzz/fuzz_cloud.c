/* SPDX-License-Identifier: MIT */
/* fuzz_cloud.c - libFuzzer entry of the point cloud readers. The first line of an input is the suffix of the file name,
 * such as "ply", or empty; the rest is the file. Inputs of the corpus therefore stay valid when a format is added. */
#include "cloud.h"
#include "support/edited_words.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

enum { LONGEST_SUFFIX = 8 };

/* The length of the first line with its line end; 0 if it is no suffix, or that of LAZ, which another process reads. */
static size_t measure_head(const uint8_t *data, size_t size)
{
    size_t length = 0;
    while (length < size && length < LONGEST_SUFFIX && data[length] >= 'a' && data[length] <= 'z')
        length++;
    const bool is_suffix = length < size && data[length] == '\n' && !(length == 3 && memcmp(data, "laz", 3) == 0);
    return is_suffix ? length + 1 : 0;
}

/* Seven of eight inputs change word by word, for the headers of text formats; the others, and LAS, change byte by byte.
 * The suffix changes in one of 64. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    static const char *const words[] = {
        "VERSION", "FIELDS",     "SIZE",
        "TYPE",    "COUNT",      "WIDTH",
        "HEIGHT",  "VIEWPOINT",  "POINTS",
        "DATA",    "ascii",      "binary",
        "F",       "U",          "I",
        "x",       "y",          "z",
        "rgb",     "rgba",       "red",
        "green",   "blue",       "_",
        "label",   "intensity",  "binary_compressed",
        "ply",     "format",     "1.0",
        "vertex",  "comment",    "list",
        "element", "property",   "binary_little_endian",
        "uchar",   "ushort",     "int",
        "float",   "double",     "char",
        "face",    "r",          "binary_big_endian",
        "g",       "obj_info",   "end_header",
        "//",      "# .PCD v.7", "class",
        "\r",
    };
    const size_t head = measure_head(data, size);
    size_t made = 0;
    if (head == 0 || head == size || seed % 64 == 0)
        return LLVMFuzzerMutate(data, size, most);
    if (seed % 8 && !(head == 4 && memcmp(data, "las", 3) == 0))
        made = edited_words(data + head, size - head, most - head, seed, words, sizeof words / sizeof *words);
    return head + (made ? made : LLVMFuzzerMutate(data + head, size - head, most - head));
}

/* A cloud that was read has points, all of them finite and in the order of their rows. If points were skipped, the
 * reason is given. */
static void check_cloud(const cloud *cloud)
{
    if (cloud->count == 0 || (cloud->skipped > 0) != (cloud->why_skipped != NULL))
        abort();
    for (size_t i = 1; i < cloud->count; i++)
        if (cloud_row_number(cloud, i) <= cloud_row_number(cloud, i - 1) ||
            cloud_row_number(cloud, i) >= cloud->count + cloud->skipped)
            abort();
    for (size_t i = 0; i < cloud->count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (!isfinite(cloud->positions[i][axis]))
                abort();
}

/* There is at most one value per row. Intensities are finite. The largest value of a colour channel is known if and
 * only if points have colours. */
static void check_values(const cloud *cloud)
{
    const point_values *v = &cloud->values;
    const bool known = cloud->color_full == 1 || cloud->color_full == 255 || cloud->color_full == 65535;
    if (v->ids || v->first != 0 || v->count > cloud->count + cloud->skipped ||
        (v->count > 0) != (point_values_kinds(v) > 0))
        abort();
    const bool colored = point_values_kinds(v) >> POINT_COLOR & 1;
    if ((colored && !known) || (!colored && cloud->color_full != 0))
        abort();
    for (size_t row = 0; row < v->count; row++)
        if (v->rows[row].has[POINT_INTENSITY] && !isfinite(v->rows[row].intensity))
            abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    cloud cloud;
    octreel_error error = {""};
    char name[8 + LONGEST_SUFFIX];
    const size_t head = measure_head(data, size);
    if (head == 0)
        return 0;
    snprintf(name, sizeof name, "fuzz%s%.*s", head > 1 ? "." : "", (int)head - 1, (const char *)data);
    const bool parsed = cloud_parse(name, data + head, size - head, &cloud, &error);
    if (parsed) {
        check_cloud(&cloud);
        check_values(&cloud);
    } else if (error.text[0] == '\0' || cloud.positions || cloud.count > 0 || cloud.skipped > 0) {
        abort();
    }
    cloud_release(&cloud);
    return 0;
}
