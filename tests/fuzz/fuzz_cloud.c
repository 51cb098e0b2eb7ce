/* SPDX-License-Identifier: MIT */
/* fuzz_cloud.c - libFuzzer entry of the point-cloud readers: the first byte chooses the file's name, the rest is the
 * file. Build with clang -fsanitize=fuzzer,address,undefined.
 */
#include "cloud.h"
#include "support/edited_words.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

/* Headers change by words in seven of eight; LAS and what follows a header by bytes alone. */
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
    size_t made = 0;
    if (seed % 8 && size > 1 && data[0] % 4 != 3)
        made = edited_words(data + 1, size - 1, most - 1, seed, words, sizeof words / sizeof *words);
    return made ? made + 1 : LLVMFuzzerMutate(data, size, most);
}

/* A cloud holds points, all of them finite, each of a later row than the one before; why some were skipped is known. */
static void check_cloud(const cloud *cloud)
{
    if (cloud->count == 0 || (cloud->skipped > 0) != (cloud->why_skipped != NULL))
        abort();
    for (size_t i = 1; i < cloud->count; i++)
        if (cloud_row(cloud, i) <= cloud_row(cloud, i - 1) || cloud_row(cloud, i) >= cloud->count + cloud->skipped)
            abort();
    for (size_t i = 0; i < cloud->count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (!isfinite(cloud->positions[i][axis]))
                abort();
}

/* Each value is a row of the file; intensities are finite; and what a full channel is is said where there are colours.
 */
static void check_values(const cloud *cloud)
{
    const point_values *v = &cloud->values;
    const bool known = cloud->color_full == 1 || cloud->color_full == 255 || cloud->color_full == 65535;
    if (v->ids || v->first != 0 || v->count > cloud->count + cloud->skipped ||
        (v->count > 0) != (point_values_kinds(v) > 0))
        abort();
    if ((v->colors && !known) || (!v->colors && cloud->color_full != 0))
        abort();
    for (size_t row = 0; row < v->count; row++)
        if (point_values_has(v, row, POINT_INTENSITY) && !isfinite(v->intensities[row]))
            abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const names[] = {"fuzz", "fuzz.ply", "fuzz.pcd", "fuzz.las"};
    cloud cloud;
    octreel_error error = {""};
    if (size == 0)
        return 0;
    const bool parsed = cloud_parse(names[data[0] % 4], data + 1, size - 1, &cloud, &error);
    if (parsed) {
        check_cloud(&cloud);
        check_values(&cloud);
    } else if (error.text[0] == '\0' || cloud.positions || cloud.count > 0 || cloud.skipped > 0) {
        abort();
    }
    cloud_release(&cloud);
    return 0;
}
