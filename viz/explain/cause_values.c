/* SPDX-License-Identifier: MIT */
/* cause_values.c - compares colours, intensities and classes point by point; see cause_compare.h. */
#include "array.h"
#include "cause_compare.h"
#include "number.h"

#include <stdlib.h>

/* Return the ids of all points that occur in a session, in ascending order, or null if memory runs out. If an edit
 * inserts a point again, its id occurs twice. */
static uint64_t *list_ids(const octree_session *session, size_t *count)
{
    uint64_t *ids = malloc((session->body_count + session->edit_count + 1) * sizeof *ids);
    *count = 0;
    for (size_t i = 0; ids && i < session->body_count; i++)
        ids[(*count)++] = session->bodies[i].id;
    for (size_t i = 0; ids && i < session->edit_count; i++)
        if (session->edits[i].kind == OCTREE_EDIT_INSERT)
            ids[(*count)++] = session->edits[i].body.id;
    if (ids)
        qsort(ids, *count, sizeof *ids, compare_uint64);
    return ids;
}

static json_t *make_json_value(const point_value *value, point_value_kind kind)
{
    if (!value->has[kind])
        return NULL;
    if (kind == POINT_COLOR)
        return json_sprintf("#%02x%02x%02x", value->color[0], value->color[1], value->color[2]);
    return kind == POINT_INTENSITY ? json_real(widen_float_as_printed(value->intensity)) : json_integer(value->class);
}

static void compare_value(cause_facts *facts, uint64_t id, const point_value *a, const point_value *b)
{
    static const char *const where[] = {
        [POINT_COLOR] = "points.color", [POINT_INTENSITY] = "points.intensity", [POINT_CLASS] = "points.class"};
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++) {
        json_t *const x = make_json_value(a, (point_value_kind)kind), *const y =
                                                                          make_json_value(b, (point_value_kind)kind);
        if (!cause_values_are_equal(x, y, true))
            cause_add_fact(facts, where[kind], "", CAUSE_OTHER,
                           (cause_fact){CAUSE_NO_TICK, id, json_incref(x), json_incref(y)});
        json_decref(x);
        json_decref(y);
    }
}

/* A point that only one session has is skipped here, because the comparison of points reports it. */
void cause_compare_values(const session_file *a, const session_file *b, cause_facts *facts)
{
    size_t a_count, b_count;
    if (point_values_kinds(&a->values) == 0 && point_values_kinds(&b->values) == 0)
        return;
    uint64_t *as = list_ids(&a->session, &a_count), *bs = list_ids(&b->session, &b_count);
    facts->out_of_memory |= !as || !bs;
    for (size_t i = 0, j = 0; as && bs && i < a_count && j < b_count;) {
        const uint64_t x = as[i], y = bs[j];
        if (x == y && (i == 0 || as[i - 1] != x)) {
            const point_value before = point_values_get(&a->values, x), now = point_values_get(&b->values, y);
            if (!point_value_equals(&before, &now))
                compare_value(facts, x, &before, &now);
        }
        i += x <= y;
        j += y <= x;
    }
    free(as);
    free(bs);
}
