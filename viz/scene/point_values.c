/* SPDX-License-Identifier: MIT */
#include "point_values.h"
#include "array.h"

#include <string.h>

/* ---- Found -------------------------------------------------------------------------------------------------- */

size_t point_values_search(const point_values *v, uint64_t id)
{
    size_t first = 0, end = v->count;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        if (v->ids[middle] < id)
            first = middle + 1;
        else
            end = middle;
    }
    return first < v->count && v->ids[first] == id ? first : POINT_VALUES_NONE;
}

static point_value value_at(const point_values *v, size_t row)
{
    point_value value = {0};
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++)
        value.has[kind] = point_values_has(v, row, (point_value_kind)kind);
    if (value.has[POINT_COLOR])
        memcpy(value.color, v->colors[row], sizeof value.color);
    if (value.has[POINT_INTENSITY])
        value.intensity = v->intensities[row];
    if (value.has[POINT_CLASS])
        value.class = v->classes[row];
    return value;
}

point_value point_values_get(const point_values *v, uint64_t id)
{
    const size_t row = point_values_row(v, id);
    return row == POINT_VALUES_NONE ? (point_value){0} : value_at(v, row);
}

static unsigned bits_of(const point_value *value)
{
    unsigned bits = 0;
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++)
        bits |= (unsigned)value->has[kind] << kind;
    return bits;
}

bool point_value_is_set(const point_value *value)
{
    return bits_of(value) != 0;
}

bool point_value_same(const point_value *a, const point_value *b)
{
    return bits_of(a) == bits_of(b) && memcmp(a->color, b->color, sizeof a->color) == 0 && a->class == b->class &&
           memcmp(&a->intensity, &b->intensity, sizeof a->intensity) == 0;
}

/* ---- Made --------------------------------------------------------------------------------------------------- */

/* Room for one more item of an array that has `count`; one that is new is filled with zeros. */
static bool reserve(void *array, size_t count, size_t *room, size_t item_size)
{
    void *items;
    memcpy(&items, array, sizeof items);
    void *grown = array_reserve(items, count + 1, room, item_size);
    if (!grown)
        return false;
    if (!items)
        memset(grown, 0, *room * item_size);
    memcpy(array, &grown, sizeof grown);
    return true;
}

/* Room for `bits` in the next row. Where rows do not all have the same, what each has is kept. */
static bool reserve_row(point_values *v, unsigned bits)
{
    const unsigned before = point_values_kinds(v);
    const bool unlike = v->given || (v->count > 0 && bits != before);
    if (unlike) {
        const bool fresh = !v->given;
        if (!reserve(&v->given, v->count, &v->given_room, sizeof *v->given))
            return false;
        if (fresh)
            memset(v->given, (int)before, v->count);
    }
    const unsigned kinds = before | bits;
    return (!(kinds >> POINT_COLOR & 1) || reserve(&v->colors, v->count, &v->color_room, sizeof *v->colors)) &&
           (!(kinds >> POINT_INTENSITY & 1) ||
            reserve(&v->intensities, v->count, &v->intensity_room, sizeof *v->intensities)) &&
           (!(kinds >> POINT_CLASS & 1) || reserve(&v->classes, v->count, &v->class_room, sizeof *v->classes));
}

bool point_values_append(point_values *v, const point_value *value)
{
    const unsigned bits = bits_of(value);
    if (!reserve_row(v, bits))
        return false;
    if (v->colors)
        memcpy(v->colors[v->count], value->color, sizeof value->color);
    if (v->intensities)
        v->intensities[v->count] = value->intensity;
    if (v->classes)
        v->classes[v->count] = value->class;
    if (v->given)
        v->given[v->count] = (unsigned char)bits;
    v->count++;
    return true;
}

static void move_on(void *items, size_t item_size, size_t at, size_t count)
{
    if (items)
        memmove((char *)items + (at + 1) * item_size, (char *)items + at * item_size, (count - at) * item_size);
}

bool point_values_open_row(point_values *v, size_t at)
{
    const size_t count = v->count;
    if (!point_values_append(v, &(point_value){0}))
        return false;
    move_on(v->colors, sizeof *v->colors, at, count);
    move_on(v->intensities, sizeof *v->intensities, at, count);
    move_on(v->classes, sizeof *v->classes, at, count);
    move_on(v->given, sizeof *v->given, at, count);
    if (v->given)
        v->given[at] = 0;
    return true;
}

void point_values_drop(point_values *v, point_value_kind kind)
{
    switch (kind) {
    case POINT_COLOR:
        free(v->colors);
        v->colors = NULL;
        v->color_room = 0;
        break;
    case POINT_INTENSITY:
        free(v->intensities);
        v->intensities = NULL;
        v->intensity_room = 0;
        break;
    default:
        free(v->classes);
        v->classes = NULL;
        v->class_room = 0;
    }
    for (size_t i = 0; v->given && i < v->count; i++)
        v->given[i] &= (unsigned char)~(1U << kind);
    if (point_values_kinds(v) == 0)
        point_values_release(v);
}

/* From entries in ascending order. Dense where the holes are few. */
static bool build(point_values *v, const point_entry *entries, size_t count)
{
    const uint64_t span = entries[count - 1].id - entries[0].id;
    const bool dense = span < 2 * (uint64_t)count + 64;
    v->first = entries[0].id;
    for (size_t i = 0; i < count; i++) {
        while (dense && v->count < entries[i].id - v->first)
            if (!point_values_append(v, &(point_value){0}))
                return false;
        if (!dense && !reserve(&v->ids, v->count, &v->id_room, sizeof *v->ids))
            return false;
        if (!dense)
            v->ids[v->count] = entries[i].id;
        if (!point_values_append(v, &entries[i].value))
            return false;
    }
    return true;
}

/* Whether the entries, of a stream of points say, are the next ids after the last row. */
static bool are_next(const point_values *v, const point_entry *entries, size_t count)
{
    bool next = v->count > 0 && !v->ids;
    for (size_t i = 0; next && i < count; i++)
        next = entries[i].id == v->first + v->count + i;
    return next;
}

static bool append_all(point_values *v, const point_entry *entries, size_t count)
{
    const size_t before = v->count;
    for (size_t i = 0; i < count; i++)
        if (!point_values_append(v, &entries[i].value)) {
            v->count = before;
            return false;
        }
    return true;
}

bool point_values_add(point_values *v, const point_entry *entries, size_t count)
{
    point_values made = {0};
    size_t all = v->count + count;
    if (count == 0 || are_next(v, entries, count))
        return append_all(v, entries, count);
    point_entry *sorted = all <= SIZE_MAX / sizeof *sorted ? malloc(all * sizeof *sorted) : NULL;
    if (!sorted)
        return false;
    memcpy(sorted, entries, count * sizeof *sorted);
    all = count;
    for (size_t i = 0; i < v->count; i++) {
        const point_value value = value_at(v, i);
        if (point_value_is_set(&value))
            sorted[all++] = (point_entry){v->ids ? v->ids[i] : v->first + i, value};
    }
    qsort(sorted, all, sizeof *sorted, by_uint64);
    const bool done = build(&made, sorted, all);
    free(sorted);
    if (done) {
        point_values_release(v);
        *v = made;
    } else {
        point_values_release(&made);
    }
    return done;
}

void point_values_release(point_values *v)
{
    free(v->ids);
    free(v->colors);
    free(v->intensities);
    free(v->classes);
    free(v->given);
    *v = (point_values){0};
}
