/* SPDX-License-Identifier: MIT */
/* point_values.c - builds and searches the table of values of points; see point_values.h. */
#include "point_values.h"
#include "array.h"

#include <string.h>

/* ---- Finding ------------------------------------------------------------------------------------------------ */

const point_value *point_values_find_row(const point_values *v, uint64_t id)
{
    size_t first = 0, end = v ? v->count : 0;
    if (end > 0 && !v->ids)
        return id - v->first < v->count ? &v->rows[id - v->first] : NULL;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        if (v->ids[middle] < id)
            first = middle + 1;
        else
            end = middle;
    }
    return v && first < v->count && v->ids[first] == id ? &v->rows[first] : NULL;
}

point_value point_values_get(const point_values *v, uint64_t id)
{
    const point_value *found = point_values_find_row(v, id);
    return found ? *found : (point_value){0};
}

static unsigned find_value_kinds(const point_value *value)
{
    unsigned bits = 0;
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++)
        bits |= (unsigned)value->has[kind] << kind;
    return bits;
}

bool point_value_has_any(const point_value *value)
{
    return find_value_kinds(value) != 0;
}

_Static_assert(sizeof(point_value) == 12, "point_value_equals() compares bytes: no padding");

bool point_value_equals(const point_value *a, const point_value *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

/* ---- Building ----------------------------------------------------------------------------------------------- */

bool point_values_append_row(point_values *v, const point_value *value)
{
    if (!array_grow(&v->rows, v->count + 1, &v->room, sizeof *v->rows))
        return false;
    v->rows[v->count++] = *value;
    v->kinds |= find_value_kinds(value);
    return true;
}

bool point_values_insert_empty_row(point_values *v, size_t at)
{
    if (!point_values_append_row(v, &(point_value){0}))
        return false;
    memmove(v->rows + at + 1, v->rows + at, (v->count - 1 - at) * sizeof *v->rows);
    v->rows[at] = (point_value){0};
    return true;
}

/* Build a table from entries in ascending order of their ids. If the ids have few gaps, the table also gets empty rows
 * for the ids in the gaps, and needs no list of ids. */
static bool build_rows(point_values *v, const point_entry *entries, size_t count)
{
    const uint64_t span = entries[count - 1].id - entries[0].id;
    const bool dense = span < 2 * (uint64_t)count + 64;
    bool ok = true;
    v->first = entries[0].id;
    for (size_t i = 0; ok && i < count; i++) {
        while (ok && dense && v->count < entries[i].id - v->first)
            ok = point_values_append_row(v, &(point_value){0});
        ok = ok && (dense || array_grow(&v->ids, v->count + 1, &v->id_room, sizeof *v->ids)) &&
             point_values_append_row(v, &entries[i].value);
        if (ok && !dense)
            v->ids[i] = entries[i].id;
    }
    return ok;
}

/* Returns whether the ids of the entries continue the ids of the table's rows without a gap, as in a stream of
 * points. */
static bool do_ids_continue_rows(const point_values *v, const point_entry *entries, size_t count)
{
    bool next = v->count > 0 && !v->ids;
    for (size_t i = 0; next && i < count; i++)
        next = entries[i].id == v->first + v->count + i;
    return next;
}

static bool append_entries(point_values *v, const point_entry *entries, size_t count)
{
    if (!array_grow(&v->rows, v->count + count, &v->room, sizeof *v->rows))
        return false;
    for (size_t i = 0; i < count; i++)
        point_values_append_row(v, &entries[i].value);
    return true;
}

bool point_values_add_entries(point_values *v, const point_entry *entries, size_t count)
{
    point_values made = {0};
    size_t all = v->count + count;
    if (count == 0 || do_ids_continue_rows(v, entries, count))
        return append_entries(v, entries, count);
    point_entry *sorted = all <= SIZE_MAX / sizeof *sorted ? malloc(all * sizeof *sorted) : NULL;
    if (!sorted)
        return false;
    memcpy(sorted, entries, count * sizeof *sorted);
    all = count;
    for (size_t i = 0; i < v->count; i++)
        if (point_value_has_any(&v->rows[i]))
            sorted[all++] = (point_entry){v->ids ? v->ids[i] : v->first + i, v->rows[i]};
    qsort(sorted, all, sizeof *sorted, compare_uint64);
    const bool done = build_rows(&made, sorted, all);
    free(sorted);
    point_values_release(done ? v : &made);
    if (done)
        *v = made;
    return done;
}

void point_values_release(point_values *v)
{
    free(v->rows);
    free(v->ids);
    *v = (point_values){0};
}
