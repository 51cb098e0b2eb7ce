/* SPDX-License-Identifier: MIT */
/* frustum.c - half-spaces in sessions and ticks. */
#include "frustum.h"
#include "octree/query.h"

/* A half-space is read and written as four numbers. */
_Static_assert(offsetof(octree_half_space, offset) == sizeof(double[3]), "not four numbers");

static bool read_half_space(json_reader *r, const json_t *value, const json_place *at, octree_half_space *space)
{
    const double *normal = space->normal;
    if (json_array_size(value) != 4)
        return json_fail_expected(r, value, at, "a half-space [nx, ny, nz, offset]");
    return json_read_numbers(r, value, at, 0, 3, space->normal) &&
           json_read_numbers(r, value, at, 3, 1, &space->offset) &&
           (normal[0] != 0 || normal[1] != 0 || normal[2] != 0 ||
            json_fail(r, at, "the normal of a half-space must not be [0, 0, 0]"));
}

static bool read_frustum(json_reader *r, json_t *value, const json_place *at, void *into)
{
    octree_frustum *frustum = into;
    frustum->count = json_array_size(value);
    if (frustum->count < 1 || frustum->count > OCTREE_FRUSTUM_HALF_SPACES)
        return json_fail_expected(r, value, at, "a list of 1 to 8 half-spaces [nx, ny, nz, offset]");
    for (size_t i = 0; i < frustum->count; i++)
        if (!read_half_space(r, json_array_get(value, i), &(json_place){at, NULL, i}, &frustum->half_spaces[i]))
            return false;
    return true;
}

static void write_frustum(json_writer *w, const void *from)
{
    const octree_frustum *frustum = from;
    json_write_begin_array(w);
    for (size_t i = 0; i < frustum->count; i++)
        json_write_numbers(w, frustum->half_spaces[i].normal, 4);
    json_write_end_array(w);
}

const json_codec json_frustum = {read_frustum, write_frustum};
