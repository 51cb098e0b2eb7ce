/* SPDX-License-Identifier: MIT */
/* fuzz_cloud.c - libFuzzer entry of the point-cloud readers: the first byte chooses the file's name, the rest is the
 * file. Build with clang -fsanitize=fuzzer,address,undefined.
 */
#include "cloud.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
