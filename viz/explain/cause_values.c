/* SPDX-License-Identifier: MIT */
/* cause_values.c - compares colours, intensities and classes point by point; see cause_compare.h. */
#include "cause_compare.h"
#include "number.h"

#include <stdlib.h>

/* The ids of all points that a session ever has, in ascending order. */
typedef struct id_list {
    uint64_t *ids;
    size_t count;
} id_list;

static int by_id(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static bool list_ids(const octree_session *session, id_list *list)
{
    list->ids = malloc((session->body_count + session->edit_count + 1) * sizeof *list->ids);
    if (!list->ids)
        return false;
    for (size_t i = 0; i < session->body_count; i++)
        list->ids[list->count++] = session->bodies[i].id;
    for (size_t i = 0; i < session->edit_count; i++)
        if (session->edits[i].kind == OCTREE_EDIT_INSERT)
            list->ids[list->count++] = session->edits[i].body.id;
    qsort(list->ids, list->count, sizeof *list->ids, by_id);
    return true;
}

static json_t *value_of(const point_value *value, point_value_kind kind)
{
    if (!value->has[kind])
        return NULL;
    if (kind == POINT_COLOR)
        return json_sprintf("#%02x%02x%02x", value->color[0], value->color[1], value->color[2]);
    return kind == POINT_INTENSITY ? json_real(number_from_float(value->intensity)) : json_integer(value->class);
}

static void compare_value(cause_facts *facts, uint64_t id, const point_value *a, const point_value *b)
{
    static const char *const where[] = {
        [POINT_COLOR] = "points.color", [POINT_INTENSITY] = "points.intensity", [POINT_CLASS] = "points.class"};
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++) {
        json_t *const x = value_of(a, (point_value_kind)kind), *const y = value_of(b, (point_value_kind)kind);
        if (!cause_same(x, y, true))
            cause_add(facts, where[kind], "", CAUSE_OTHER, (cause_fact){CAUSE_NO_TICK, id, x, y});
        json_decref(x);
        json_decref(y);
    }
}

/* Compare the points of ids in both lists. A list may hold an id twice, since an id may be inserted again. */
static void compare_shared(const id_list *a, const id_list *b, const point_values *before, const point_values *now,
                           cause_facts *facts)
{
    for (size_t i = 0, j = 0; i < a->count && j < b->count;) {
        const uint64_t x = a->ids[i], y = b->ids[j];
        if (x == y) {
            const point_value was = point_values_get(before, x), is = point_values_get(now, x);
            if (!point_value_same(&was, &is))
                compare_value(facts, x, &was, &is);
        }
        while (i < a->count && x <= y && a->ids[i] == x)
            i++;
        while (j < b->count && y <= x && b->ids[j] == y)
            j++;
    }
}

void cause_compare_values(const session_file *a, const session_file *b, cause_facts *facts)
{
    id_list as = {0}, bs = {0};
    if (point_values_kinds(&a->values) == 0 && point_values_kinds(&b->values) == 0)
        return;
    if (list_ids(&a->session, &as) && list_ids(&b->session, &bs))
        compare_shared(&as, &bs, &a->values, &b->values, facts);
    else
        facts->out_of_memory = true;
    free(as.ids);
    free(bs.ids);
}
