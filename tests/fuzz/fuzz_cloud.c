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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const names[] = {"fuzz", "fuzz.ply", "fuzz.pcd", "fuzz.las"};
    cloud cloud;
    octreel_error error = {""};
    if (size == 0)
        return 0;
    if (cloud_parse(names[data[0] % 4], data + 1, size - 1, &cloud, &error))
        check_cloud(&cloud);
    else if (error.text[0] == '\0' || cloud.positions || cloud.count > 0 || cloud.skipped > 0)
        abort();
    cloud_release(&cloud);
    return 0;
}
