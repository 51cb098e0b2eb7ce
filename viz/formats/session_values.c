/* SPDX-License-Identifier: MIT */
/* session_values.c - reads and writes colours, intensities and classes of points, either as members of a point's
 * object or as columns of its row. */
#include "array.h"
#include "number.h"
#include "session_members.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- One value ---------------------------------------------------------------------------------------------- */

static bool read_color(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const char *text = json_string_value(value);
    unsigned char *color = into;
    if (!text || *text != '#' || strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6)
        return json_fail_expected(r, value, at, "a colour \"#rrggbb\"");
    const unsigned long packed = strtoul(text + 1, NULL, 16);
    for (int i = 0; i < 3; i++)
        color[i] = (unsigned char)(packed >> (16 - 8 * i));
    return true;
}

static void write_color(json_writer *w, const void *from)
{
    const unsigned char *color = from;
    char text[8];
    snprintf(text, sizeof text, "#%02x%02x%02x", color[0], color[1], color[2]);
    json_write_string(w, text);
}

static bool read_intensity(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const double number = json_real_value(value);
    if (!json_is_real(value))
        return json_fail_expected(r, value, at, "a number");
    if (fabs(number) > FLT_MAX)
        return json_fail(r, at, "the intensity does not fit into a float");
    *(float *)into = (float)number;
    return true;
}

static void write_intensity(json_writer *w, const void *from)
{
    json_write_number(w, widen_float_as_printed(*(const float *)from));
}

static bool read_point_class(json_reader *r, json_t *value, const json_place *at, void *into)
{
    uint64_t whole;
    uint16_t *class = into;
    if (!json_read_whole_number(r, value, at, 0, UINT16_MAX, &whole))
        return false;
    *class = (uint16_t)whole;
    return true;
}

static void write_point_class(json_writer *w, const void *from)
{
    json_write_integer(w, *(const uint16_t *)from);
}

/* ---- Values by id ------------------------------------------------------------------------------------------- */

static const hash_map_item_type listed_by_id = {sizeof(point_entry), hash_map_hash_id, hash_map_ids_equal};
static const hash_map_item_type plain_by_id = {sizeof(uint64_t), hash_map_hash_id, hash_map_ids_equal};

static point_value find_point_value(const session_values *s, uint64_t id)
{
    const uint32_t listed = hash_map_find(&s->ids, &listed_by_id, s->listed, &id);
    return listed == HASH_MAP_NONE ? point_values_get(&s->made, id) : s->listed[listed].value;
}

static bool add_listed_value(session_values *s, uint64_t id, const point_value *value)
{
    if (!array_grow(&s->listed, s->ids.count + 1, &s->room, sizeof *s->listed))
        return false;
    s->listed[s->ids.count] = (point_entry){id, *value};
    return hash_map_add(&s->ids, &listed_by_id, s->listed);
}

bool session_set_value(json_reader *r, const json_place *at, uint64_t id, const point_value *value)
{
    session_values *s = &((session_loader *)r->context)->values;
    if (!point_value_has_any(value))
        return true;
    const point_value before = find_point_value(s, id);
    if (!point_value_has_any(&before))
        return add_listed_value(s, id, value) || json_fail(r, at, "out of memory");
    return point_value_equals(&before, value) ||
           json_fail(r, at,
                     "the point with the id %" PRIu64 " had another color, intensity or class before; an id keeps its "
                     "values through the session",
                     id);
}

/* Stores the id of a point that was inserted without values. */
static bool add_valueless_id(session_values *s, uint64_t id)
{
    if (hash_map_find(&s->plain_ids, &plain_by_id, s->plain, &id) != HASH_MAP_NONE)
        return true;
    if (!array_grow(&s->plain, s->plain_ids.count + 1, &s->plain_room, sizeof *s->plain))
        return false;
    s->plain[s->plain_ids.count] = id;
    return hash_map_add(&s->plain_ids, &plain_by_id, s->plain);
}

/* Set the values of an inserted point. If the id was used before without values, it cannot get values later. The
 * reason: a session may be drawn while it is being written. Then the frame of a tick is drawn before the next tick
 * is read, so a later tick must not change this frame. */
static bool set_inserted_value(json_reader *r, const json_place *at, uint64_t id, const point_value *value)
{
    session_loader *s = r->context;
    session_values *values = &s->values;
    const point_value before = find_point_value(values, id);
    if (point_value_has_any(&before))
        return session_set_value(r, at, id, value);
    if (!point_value_has_any(value))
        return add_valueless_id(values, id) || json_fail(r, at, "out of memory");
    if (!session_map_bodies(r, at))
        return false;
    if (session_find_body(s, id) != HASH_MAP_NONE ||
        hash_map_find(&values->plain_ids, &plain_by_id, values->plain, &id) != HASH_MAP_NONE)
        return json_fail(r, at,
                         "the point with the id %" PRIu64
                         " had no color, intensity or class before, so it cannot have any "
                         "now; insert the point with another id",
                         id);
    return session_set_value(r, at, id, value);
}

bool session_merge_listed_values(json_reader *r)
{
    session_values *s = &((session_loader *)r->context)->values;
    if (s->ids.count == 0)
        return true;
    if (!point_values_add_entries(&s->made, s->listed, s->ids.count))
        return json_fail(r, NULL, "out of memory for the colours, intensities and classes of points");
    hash_map_clear(&s->ids);
    return true;
}

void session_release_values(session_values *values)
{
    free(values->listed);
    free(values->plain);
    hash_map_release(&values->ids);
    hash_map_release(&values->plain_ids);
    hash_map_release(&values->body_ids);
}

/* ---- Points as objects -------------------------------------------------------------------------------------- */

/* A body and its values, which are the members of its JSON object. */
typedef struct valued_body {
    octree_game_body body;
    point_value value;
} valued_body;

#define POINT(member) offsetof(valued_body, member)
#define VALUE(kind, field) .offset = POINT(value.field), .given = POINT(value.has[kind])

enum { FIRST_VALUE = 4 };

static bool check_half(json_reader *r, const json_place *at, void *structure)
{
    const double *half = ((const valued_body *)structure)->body.half;
    for (int i = 0; i < 3; i++)
        if (half[i] < 0)
            return json_fail(r, at, "a half extent must not be negative; correct its coordinate %c", "xyz"[i]);
    return true;
}

/* The rows of a body's members. The row of a point_value_kind has the index FIRST_VALUE + kind. */
const json_member session_body_members[] = {
    {"id", &json_uint64, POINT(body.id), .max = JSON_LARGEST_WHOLE},
    {"position", &json_vector, POINT(body.position), .required = true},
    {"velocity", &json_vector, POINT(body.velocity), JSON_IF(valued_body, body.velocity)},
    {"half", &json_vector, POINT(body.half), JSON_IF(valued_body, body.half), .check = check_half},
    [FIRST_VALUE + POINT_COLOR] = {"color", JSON_CODEC(read_color, write_color), VALUE(POINT_COLOR, color)},
    {"intensity", JSON_CODEC(read_intensity, write_intensity), VALUE(POINT_INTENSITY, intensity)},
    {"class", JSON_CODEC(read_point_class, write_point_class), VALUE(POINT_CLASS, class)},
    {0},
};

static bool read_body_and_values(json_reader *r, json_t *value, const json_place *at, bool inserted,
                                 octree_game_body *body)
{
    valued_body valued = {.body = *body};
    if (!json_read_members(r, value, at, session_body_members, &valued))
        return false;
    if (inserted && !json_object_get(value, "id"))
        return json_fail(r, at, "the member \"id\" is missing");
    *body = valued.body;
    return (inserted ? set_inserted_value : session_set_value)(r, at, body->id, &valued.value);
}

static bool read_body(json_reader *r, json_t *value, const json_place *at, void *into)
{
    return read_body_and_values(r, value, at, false, into);
}

static bool read_inserted_body(json_reader *r, json_t *value, const json_place *at, void *into)
{
    return read_body_and_values(r, value, at, true, into);
}

static void write_body(json_writer *w, const void *from)
{
    valued_body valued = {.body = *(const octree_game_body *)from};
    valued.value = point_values_get(w->context, valued.body.id);
    json_write_object(w, session_body_members, &valued);
}

const json_codec session_body_codec = {read_body, write_body};
const json_codec session_insert_codec = {read_inserted_body, write_body};

/* ---- Points as rows ----------------------------------------------------------------------------------------- */

static const char *value_kind_name(int n)
{
    return n < POINT_VALUE_KINDS ? session_body_members[FIRST_VALUE + n].name : NULL;
}

static bool read_column_names(json_reader *r, json_t *list, const json_place *at, void *into)
{
    session_values *values = &((session_loader *)r->context)->values;
    const size_t count = json_array_size(list);
    unsigned seen = 0;
    (void)into;
    if (!json_is_array(list) || count == 0)
        return json_fail_expected(r, list, at, "a list of \"color\", \"intensity\" and \"class\"");
    for (size_t i = 0; i < count; i++) {
        json_t *name = json_array_get(list, i);
        const json_place place = {at, NULL, i};
        const int kind = json_find_name(value_kind_name, json_string_value(name));
        if (kind < 0)
            return json_fail_expected(r, name, &place, "one of \"color\", \"intensity\" and \"class\"");
        if (seen >> kind & 1)
            return json_fail(r, &place, "\"%s\" occurs twice", value_kind_name(kind));
        seen |= 1U << kind;
        values->columns[values->column_count++] = kind;
    }
    return true;
}

static void write_column_names(json_writer *w, const void *from)
{
    (void)from;
    json_write_begin_array(w);
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++)
        if (point_values_kinds(w->context) >> kind & 1)
            json_write_string(w, value_kind_name(kind));
    json_write_end_array(w);
}

bool session_has_columns(const void *header)
{
    return point_values_kinds(((const session_header *)header)->values) != 0;
}

const json_codec session_columns_codec = {read_column_names, write_column_names};

bool session_read_column_value(json_reader *r, json_t *value, const json_place *at, point_value_kind kind,
                               point_value *into)
{
    const json_member *row = &session_body_members[FIRST_VALUE + kind];
    if (json_is_null(value))
        return true;
    into->has[kind] = true;
    return row->codec->read(r, value, at, (char *)into + (row->offset - POINT(value)));
}

/* A point without values gets no columns, so that its row is short. */
void session_write_column_values(json_writer *w, uint64_t id)
{
    const unsigned kinds = point_values_kinds(w->context);
    const point_value value = kinds ? point_values_get(w->context, id) : (point_value){0};
    if (!point_value_has_any(&value))
        return;
    for (int kind = 0; kind < POINT_VALUE_KINDS; kind++) {
        const json_member *row = &session_body_members[FIRST_VALUE + kind];
        if (value.has[kind])
            row->codec->write(w, (const char *)&value + (row->offset - POINT(value)));
        else if (kinds >> kind & 1)
            json_write_null(w);
    }
}
