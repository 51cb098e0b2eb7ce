/* session_reader.c - see session_reader.h: members, values of each type, memory. */
#include "session_reader.h"
#include "array.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Members ------------------------------------------------------------------------------------------------ */

static bool is_member(const session_member *table, const char *name)
{
    while (table->name && strcmp(table->name, name) != 0)
        table++;
    return table->name;
}

/* The line is the member's, the place that of its object. */
static bool fail_unknown(session_reader *reader, const json_place *at, const session_member *table, const char *name)
{
    char where[96], reason[260];
    size_t length = (size_t)snprintf(reason, sizeof reason, "unknown member \"%.40s\"; known:", name);
    for (; table->name && length < sizeof reason; table++)
        length += (size_t)snprintf(reason + length, sizeof reason - length, "%s %s",
                                   reason[length - 1] == ':' ? "" : ",", table->name);
    return session_fail_line(reader, session_line(reader, &(json_place){at, name, 0}),
                             json_place_format(at, where, sizeof where), reason);
}

static bool check_known(session_reader *reader, json_t *object, const json_place *at, const session_member *table)
{
    for (void *i = json_object_iter(object); i; i = json_object_iter_next(object, i)) {
        const char *name = json_object_iter_key(i);
        if (!is_member(table, name))
            return fail_unknown(reader, at, table, name);
    }
    return true;
}

bool session_read_members(session_reader *reader, json_t *object, const json_place *at, const session_member *table,
                          void *into)
{
    if (!json_is_object(object))
        return session_expected(reader, object, at, "an object");
    if (!check_known(reader, object, at, table))
        return false;
    for (; table->name; table++) {
        json_t *value = json_object_get(object, table->name);
        if (!value && table->required)
            return session_fail(reader, at, "the member \"%s\" is missing", table->name);
        json_place place = {at, table->name, 0};
        if (value && !table->read(reader, value, &place, (char *)into + table->offset))
            return false;
    }
    return true;
}

int session_read_kind(session_reader *reader, json_t *object, const json_place *at,
                      const session_member kinds[][SESSION_KIND_MEMBERS], int count, const char *forms)
{
    int found = count;
    for (int kind = 0; kind < count; kind++) {
        if (!json_object_get(object, kinds[kind][0].name))
            continue;
        if (found < count) {
            session_fail(reader, at, "expected one of %s, found \"%s\" and \"%s\" together", forms,
                         kinds[found][0].name, kinds[kind][0].name);
            return count;
        }
        found = kind;
    }
    if (found == count)
        session_fail(reader, at, "expected %s", forms);
    return found;
}

bool session_read_elements(session_reader *reader, json_t *list, const json_place *at, const char *expected,
                           session_value_reader *read, void *into)
{
    if (!json_is_array(list))
        return session_expected(reader, list, at, expected);
    size_t count = json_array_size(list);
    for (size_t i = 0; i < count; i++) {
        json_place place = {at, NULL, i};
        if (!read(reader, json_array_get(list, i), &place, into))
            return false;
    }
    return true;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

bool session_read_whole(session_reader *reader, const json_t *value, const json_place *at, uint64_t min, uint64_t max,
                        uint64_t *into)
{
    double number = json_real_value(value);
    if (json_is_real(value) && number >= (double)min && number <= (double)max && (double)(uint64_t)number == number) {
        *into = (uint64_t)number;
        return true;
    }
    char what[80];
    snprintf(what, sizeof what, "a whole number from %" PRIu64 " to %" PRIu64, min, max);
    return session_expected(reader, value, at, what);
}

bool session_read_id(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    return session_read_whole(reader, value, at, 0, SESSION_ID_LIMIT - 1, into);
}

bool session_read_bool(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    if (!json_is_boolean(value))
        return session_expected(reader, value, at, "true or false");
    *(bool *)into = json_is_true(value);
    return true;
}

bool session_read_number(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    if (!json_is_real(value))
        return session_expected(reader, value, at, "a number");
    *(double *)into = json_real_value(value);
    return true;
}

bool session_read_positive(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    if (!json_is_real(value) || json_real_value(value) < 0)
        return session_expected(reader, value, at, "a number that is not negative");
    *(double *)into = json_real_value(value);
    return true;
}

bool session_read_vector(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    double *vector = into;
    if (!json_is_array(value) || json_array_size(value) != 3)
        return session_expected(reader, value, at, "three numbers [x, y, z]");
    for (size_t i = 0; i < 3; i++)
        if (!session_read_number(reader, json_array_get(value, i), &(json_place){at, NULL, i}, &vector[i]))
            return false;
    return true;
}

bool session_read_box(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    static const session_member members[] = {
        {"min", session_read_vector, offsetof(octree_box, min), true},
        {"max", session_read_vector, offsetof(octree_box, max), true},
        {0},
    };
    return session_read_members(reader, value, at, members, into);
}

/* ---- Memory ------------------------------------------------------------------------------------------------- */

void *session_append(session_reader *reader, const json_place *at, session_list *list, size_t item_size)
{
    void *grown = array_reserve(list->items, list->count + 1, &list->capacity, item_size);
    if (!grown) {
        session_fail(reader, at, "out of memory after %zu of them", list->count);
        return NULL;
    }
    list->items = grown;
    return (char *)list->items + item_size * list->count++;
}
