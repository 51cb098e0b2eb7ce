/* SPDX-License-Identifier: MIT */
/* session_items.c - reads and writes lists of edits, queries and shapes. An item of such a list is an object with a
 * member whose name is the kind of the item, such as "insert". */
#include "frustum.h"
#include "array.h"
#include "session_members.h"

#include <stdlib.h>
#include <string.h>

#define MOST_MEMBERS (12 + OCTREE_QUERY_MEMBERS)

/* A type of list: edits, queries or shapes. In memory, each item of the list begins with its tick. */
struct session_items {
    int list;          /* the index of the list in session_loader.lists */
    const char *words; /* a noun with an article for error messages: "a list of edits" */
    json_name *kinds;
    /* For each kind of item, the members of its JSON object. The name of the first member is the name of the kind.
     * Null for queries: list_query_members() lists their members. */
    const json_member (*members)[2];
    size_t size, kind;   /* the size of an item, and the offset of the member `kind` in an item, in bytes */
    const void *initial; /* the item before its members are read; null: all bytes are 0 */
};

/* ---- Edits -------------------------------------------------------------------------------------------------- */

static const json_member move_members[] = {
    {"id", &json_uint64, offsetof(octree_game_body, id), .max = JSON_LARGEST_WHOLE, .required = true},
    {"position", &json_vector, offsetof(octree_game_body, position), .required = true},
    {0},
};

static const json_member edit_members[][2] = {
    [OCTREE_EDIT_INSERT] = {{"insert", &session_insert_codec, .offset = offsetof(octree_edit, body)}},
    [OCTREE_EDIT_REMOVE] = {{"remove", &json_uint64, offsetof(octree_edit, body.id), .max = JSON_LARGEST_WHOLE}},
    [OCTREE_EDIT_MOVE] = {{"move", &json_structure, offsetof(octree_edit, body), .members = move_members}},
};

static const char *edit_kind_name(int n)
{
    return (size_t)n < sizeof edit_members / sizeof edit_members[0] ? edit_members[n][0].name : NULL;
}

/* ---- Queries ------------------------------------------------------------------------------------------------ */

static bool is_player_word(const json_t *value)
{
    return json_is_string(value) && strcmp(json_string_value(value), "player") == 0;
}

/* Reads the text "player" as the target of a query, in place of a position. If the session has no player, this is an
 * error. */
static bool read_player_target(json_reader *r, const json_place *at, octree_query *query)
{
    const session_loader *s = r->context;
    query->at_player = true;
    return s->header.session.player.kind != OCTREE_PLAYER_NONE ||
           json_fail(r, at, "the session has no player: its \"player\" is null");
}

static bool read_target(json_reader *r, json_t *value, const json_place *at, void *into)
{
    octree_query *query = into;
    if (is_player_word(value))
        return read_player_target(r, at, query);
    if (!json_is_array(value))
        return json_fail_expected(r, value, at, "\"player\" or three numbers [x, y, z]");
    return json_read_vector(r, value, at, query->target);
}

static void write_target(json_writer *w, const void *from)
{
    const octree_query *query = from;
    if (query->at_player)
        json_write_string(w, "player");
    else
        json_write_numbers(w, query->target, 3);
}

static bool read_region_at_player(json_reader *r, json_t *value, const json_place *at, void *into)
{
    return is_player_word(value) ? read_player_target(r, at, into) : json_fail_expected(r, value, at, "\"player\"");
}

/* The value of "skip" is the id of a point or this word. The word skips all points that lie exactly at the target. */
static const char coincident[] = "coincident";

static bool read_skip(json_reader *r, json_t *value, const json_place *at, void *into)
{
    octree_query *query = into;
    const bool by_place = json_is_string(value) && strcmp(json_string_value(value), coincident) == 0;
    const bool has_target = octree_query_about(query->kind)->members & OCTREE_QUERY_HAS_TARGET;
    query->skip = by_place ? OCTREE_SKIP_COINCIDENT : OCTREE_SKIP_ID;
    if (by_place)
        return has_target || json_fail(r, at, "a %s has no target, so \"skip\" cannot be \"coincident\"; give an id",
                                       octree_query_about(query->kind)->region);
    if (json_is_string(value))
        return json_fail_expected(r, value, at, has_target ? "an id or \"coincident\"" : "an id");
    return json_read_whole_number(r, value, at, 0, JSON_LARGEST_WHOLE, &query->skip_id);
}

static void write_skip(json_writer *w, const void *from)
{
    const octree_query *query = from;
    if (query->skip == OCTREE_SKIP_COINCIDENT)
        json_write_string(w, coincident);
    else
        json_write_integer(w, query->skip_id);
}

static bool uses_precision(const octree_query *query)
{
    return query->answered || query->visits[OCTREE_NODE_PRUNED].count > 0;
}

/* Check the mode of a query against its members "answer" and "pruned". The table lists these members before the
 * mode, so both have been read. */
static bool check_mode(json_reader *r, const json_place *at, void *structure)
{
    return uses_precision(structure) ||
           json_fail(r, at, "\"mode\" needs an \"answer\" or \"pruned\", and this query has neither");
}

static bool has_mode(const void *structure)
{
    return uses_precision(structure) && ((const octree_query *)structure)->precision != OCTREE_DOUBLES;
}

/* Return whether the epsilon of a query is written. Neither 0 nor -0 is written. */
static bool has_epsilon(const void *structure)
{
    return ((const octree_query *)structure)->epsilon > 0;
}

JSON_NAMES(query_name, octree_query_name, octree_query_kind)

JSON_NAMES(bounds_name, octree_bounds_name, octree_bounds)

static bool read_direction(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const double *direction = into;
    return json_read_vector(r, value, at, into) && (direction[0] != 0 || direction[1] != 0 || direction[2] != 0 ||
                                                    json_fail(r, at, "the direction of a ray must not be [0, 0, 0]"));
}

static bool read_extents(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const double *half = into;
    return json_read_vector(r, value, at, into) &&
           ((half[0] >= 0 && half[1] >= 0 && half[2] >= 0) || json_fail(r, at, "a half extent must not be negative"));
}

static void write_direction(json_writer *w, const void *from)
{
    json_write_numbers(w, from, 3);
}

/* Make the table row of one member of a query. If the member is a target, its value is a position or the text
 * "player". An optional member is written if it is not 0; a count is always written, because 1 is its default. */
static json_member make_query_member(const octree_query_member_traits *member)
{
    static const json_codec direction = {read_direction, write_direction}, extents = {read_extents, write_direction};
    static const json_member rows[] = {
        [OCTREE_MEMBER_BOX] = {.codec = &json_box},
        [OCTREE_MEMBER_POSITION] = {.codec = &json_vector},
        [OCTREE_MEMBER_DIRECTION] = {.codec = &direction},
        [OCTREE_MEMBER_COUNT] = {.codec = &json_size, .max = UINT32_MAX},
        [OCTREE_MEMBER_LENGTH] = {.codec = &json_nonnegative, .nonzero_size = sizeof(double)},
        [OCTREE_MEMBER_BOUNDS] = {.codec = &json_choice, .names = bounds_name, .nonzero_size = sizeof(octree_bounds)},
        [OCTREE_MEMBER_FRUSTUM] = {.codec = &json_frustum},
        [OCTREE_MEMBER_EXTENTS] = {.codec = &extents, .nonzero_size = sizeof(double[3])}};
    static const json_codec target = {read_target, write_target};
    json_member row = rows[member->type];
    row.name = member->key;
    row.offset = row.nonzero = member->in_query;
    row.required = !member->optional;
    if (row.required)
        row.nonzero_size = 0;
    if (member->bit == OCTREE_QUERY_HAS_TARGET) {
        row.codec = &target;
        row.offset = 0;
    }
    return row;
}

static const json_member region_at_player = {"at", JSON_CODEC(read_region_at_player, write_target),
                                             JSON_IF(octree_query, at_player)};

JSON_NAMES(precision_name, octree_precision_name, octree_precision)

#define QUERY(member) offsetof(octree_query, member)
#define VISITS(name, kind)                                                                                             \
    {                                                                                                                  \
        name, &json_ids, QUERY(visits[kind]), JSON_IF(octree_query, visits[kind].count)                                \
    }

/* The members that all kinds of queries have. */
static const json_member general_members[] = {
    {"skip", JSON_CODEC(read_skip, write_skip), .offset = 0, JSON_IF(octree_query, skip)},
    {"epsilon", &json_nonnegative, QUERY(epsilon), .is_set = has_epsilon},
    {"answer", &json_ids, QUERY(answer), .given = QUERY(answered)},
    VISITS("visited", OCTREE_NODE_VISITED),
    VISITS("pruned", OCTREE_NODE_PRUNED),
    VISITS("hit", OCTREE_NODE_HIT),
    {"mode", &json_choice, QUERY(precision), .names = precision_name, .is_set = has_mode, .check = check_mode},
};

/* Fill the table with the members of a kind of query, in the order of octree_query_member_at(). If the kind has no
 * target, its region can be relative to the player. */
static void list_query_members(int kind, json_member table[MOST_MEMBERS])
{
    const octree_query_traits *about = octree_query_about((octree_query_kind)kind);
    size_t count = 1;
    for (size_t i = 0; i < OCTREE_QUERY_MEMBERS; i++) {
        const octree_query_member_traits *member = octree_query_member_at(i);
        if (member->bit == about->named_by) {
            table[0] = make_query_member(member);
            table[0].name = about->name;
        } else if (about->members & member->bit) {
            table[count++] = make_query_member(member);
        }
    }
    if (!(about->members & OCTREE_QUERY_HAS_TARGET))
        table[count++] = region_at_player;
    memcpy(table + count, general_members, sizeof general_members);
}

/* ---- Shapes ------------------------------------------------------------------------------------------------- */

static bool read_segment(json_reader *r, json_t *value, const json_place *at, void *into)
{
    octree_shape *shape = into;
    if (json_array_size(value) != 2)
        return json_fail_expected(r, value, at, "two positions [[x, y, z], [x, y, z]]");
    return json_read_vector(r, json_array_get(value, 0), &(json_place){at, NULL, 0}, shape->at) &&
           json_read_vector(r, json_array_get(value, 1), &(json_place){at, NULL, 1}, shape->to);
}

static void write_segment(json_writer *w, const void *from)
{
    const octree_shape *shape = from;
    json_write_begin_array(w);
    json_write_numbers(w, shape->at, 3);
    json_write_numbers(w, shape->to, 3);
    json_write_end_array(w);
}

/* The members of each kind of shape. The name of the first member is the name of the kind. If a shape is a box, `at`
 * and `to` are its corners. */
_Static_assert(offsetof(octree_shape, to) - offsetof(octree_shape, at) == offsetof(octree_box, max), "not like a box");
static const json_member shape_members[OCTREE_SHAPE_KINDS][2] = {
    [OCTREE_SHAPE_BOX] = {{"box", &json_box, offsetof(octree_shape, at), .required = true}},
    [OCTREE_SHAPE_SEGMENT] = {{"segment", JSON_CODEC(read_segment, write_segment), .required = true}},
    [OCTREE_SHAPE_POINT] = {{"point", &json_vector, offsetof(octree_shape, at), .required = true}},
    [OCTREE_SHAPE_LABEL] = {{"label", &json_label, offsetof(octree_shape, text), .size = OCTREE_SHAPE_TEXT,
                             .about = "a label", .required = true},
                            {"at", &json_vector, offsetof(octree_shape, at), .required = true}},
};

JSON_NAMES(shape_name, octree_shape_name, octree_shape_kind)

/* ---- Lists -------------------------------------------------------------------------------------------------- */

#define ITEM(type) sizeof(type), offsetof(type, kind)

const session_items session_edits = {SESSION_EDITS, "a list of edits", edit_kind_name,
                                     edit_members,  ITEM(octree_edit), NULL};
static const octree_query initial_query = {.k = 1};

const session_items session_queries = {SESSION_QUERIES,    "a list of queries", query_name, NULL,
                                       ITEM(octree_query), &initial_query};
const session_items session_shapes = {SESSION_SHAPES, "a list of shapes", shape_name,
                                      shape_members,  ITEM(octree_shape), NULL};

static void list_item_members(const session_items *type, int kind, json_member table[MOST_MEMBERS])
{
    if (type->members)
        memcpy(table, type->members[kind], sizeof type->members[kind]);
    else
        list_query_members(kind, table);
}

void *session_append_item(json_reader *r, const json_place *at, session_list *list, size_t item_size)
{
    if (!array_grow(&list->items, list->count + 1, &list->room, item_size)) {
        json_fail(r, at, "out of memory after %zu items", list->count);
        return NULL;
    }
    return (char *)list->items + item_size * list->count++;
}

static bool read_item(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const session_items *type = into;
    session_loader *s = r->context;
    session_list *list = s->tick == OCTREE_EVERY_TICK ? &s->header_lists[type->list] : &s->lists[type->list];
    json_member table[MOST_MEMBERS] = {0};
    const int kind = json_read_kind(r, value, at, type->kinds);
    char *item = kind < 0 ? NULL : session_append_item(r, at, list, type->size);
    if (!item)
        return false;
    memset(item, 0, type->size);
    if (type->initial)
        memcpy(item, type->initial, type->size);
    memcpy(item, &s->tick, sizeof s->tick);
    memcpy(item + type->kind, &kind, sizeof kind);
    list_item_members(type, kind, table);
    return json_read_members(r, value, at, table, item);
}

static bool read_items(json_reader *r, json_t *value, const json_place *at, void *into)
{
    session_loader *s = r->context;
    const session_items *type = r->row->about;
    (void)into;
    if (type->list == SESSION_EDITS && s->tick == 0)
        return json_fail(r, at, "edits are not allowed in tick 0; put these points into the header's \"points\"");
    return json_read_elements(r, value, at, type->words, read_item, (void *)type);
}

static void write_items(json_writer *w, const void *from)
{
    const session_items *type = w->row->about;
    const json_counted_array list = json_get_counted_array(from);
    json_write_begin_array(w);
    for (size_t i = 0; i < list.count; i++) {
        const char *item = (const char *)list.items + i * type->size;
        json_member table[MOST_MEMBERS] = {0};
        int kind;
        memcpy(&kind, item + type->kind, sizeof kind);
        list_item_members(type, kind, table);
        json_write_object(w, table, item);
    }
    json_write_end_array(w);
}

const json_codec session_items_codec = {read_items, write_items};
