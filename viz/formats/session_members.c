/* SPDX-License-Identifier: MIT */
/* session_members.c - the tables of the members of the header and of a tick's object, and the codecs of the world,
 * the tree, the player, keys, ticks and gaps. */
#include "octree/octree.h"
#include "session_members.h"

#include <inttypes.h>
#include <string.h>

static session_loader *get_loader(const json_reader *r)
{
    return r->context;
}

/* ---- World and tree ----------------------------------------------------------------------------------------- */

static double find_default_box_size(double step)
{
    return 0.6 * step;
}

/* Places the player at the centre of the world. The corners are halved before they are added, which avoids overflow
 * in any world. The rounded sum of the halves still lies in the world. */
static void set_default_player(octree_player *player, const octree_box *world)
{
    double longest = 0;
    for (int i = 0; i < 3; i++) {
        const double half = world->max[i] / 2 - world->min[i] / 2;
        longest = half > longest ? half : longest;
        player->position[i] = world->min[i] / 2 + world->max[i] / 2;
    }
    player->step = longest / 20;
    player->box_size = find_default_box_size(player->step);
}

void session_set_world(session_loader *s, const octree_box *world)
{
    octree_session *session = &s->header.session;
    session->tree.world = *world;
    set_default_player(&session->player, world);
}

static bool check_world(json_reader *r, const json_place *at, void *structure)
{
    octree_session *session = &((session_header *)structure)->session;
    const octree_box *world = &session->tree.world;
    for (int i = 0; i < 3; i++)
        if (world->min[i] == world->max[i])
            return json_fail(r, at, "min must be below max on every axis, but is not on %c", "xyz"[i]);
    set_default_player(&session->player, world);
    return true;
}

static const char *full_leaf_rule_name(int n)
{
    static const char *const names[] = {[OCTREE_REFUSE] = "refuse", [OCTREE_GROW] = "grow"};
    return (size_t)n < sizeof names / sizeof names[0] ? names[n] : NULL;
}

static const json_member tree_members[] = {
    {"capacity", &json_size, offsetof(octree_def, leaf_capacity), .min = 1, .max = UINT32_MAX},
    {"depth", &json_size, offsetof(octree_def, max_depth), .max = OCTREE_MAX_DEPTH},
    {"full", &json_choice, offsetof(octree_def, full_leaf), .names = full_leaf_rule_name},
    {0},
};

/* ---- Player ------------------------------------------------------------------------------------------------- */

static bool check_position(json_reader *r, const json_place *at, void *structure)
{
    const session_loader *s = get_loader(r);
    const octree_box *world = &s->header.session.tree.world;
    const char *world_note = s->points.count > 0 ? " that was computed from the points" : "";
    const double *position = ((const octree_player *)structure)->position;
    for (int i = 0; i < 3; i++)
        if (position[i] < world->min[i] || position[i] > world->max[i])
            return json_fail(r, at, "the player is outside the world%s; correct its coordinate %c", world_note,
                             "xyz"[i]);
    return true;
}

/* Sets the box of the player to its default size, which follows from the player's step. The member "box_size" is read
 * later and replaces the default. */
static bool set_default_box_size(json_reader *r, const json_place *at, void *structure)
{
    octree_player *player = structure;
    (void)r, (void)at;
    player->box_size = find_default_box_size(player->step);
    return true;
}

static bool read_player_is_body(json_reader *r, json_t *value, const json_place *at, void *into)
{
    *(octree_player_kind *)into = json_is_true(value) ? OCTREE_PLAYER_BODY : OCTREE_PLAYER_KEYS;
    return json_is_boolean(value) || json_fail_expected(r, value, at, "true or false");
}

static void write_body_member(json_writer *w, const void *from)
{
    (void)from;
    json_write_bool(w, true);
}

#define ID "id", &json_uint64, offsetof(octree_player, id), .max = JSON_LARGEST_WHOLE
#define BODY                                                                                                           \
    "body", JSON_CODEC(read_player_is_body, write_body_member), .offset = offsetof(octree_player, kind),               \
                                                                JSON_IF(octree_player, kind)
#define BOX_SIZE "box_size", &json_nonnegative, .offset = offsetof(octree_player, box_size)
#define SWEEP "sweep", &json_bool, .offset = offsetof(octree_player, sweep), JSON_IF(octree_player, sweep)

/* The members of a player that is one of the bodies. The player is the body with the given id, so it has neither a
 * position nor a step of its own. */
static const json_member body_player_members[] = {{ID}, {BODY}, {BOX_SIZE}, {SWEEP}, {0}};
static const json_member player_members[] = {
    {ID},
    {BODY},
    {"position", &json_vector, offsetof(octree_player, position), .check = check_position},
    {"step", &json_nonnegative, offsetof(octree_player, step), .check = set_default_box_size},
    {BOX_SIZE},
    {SWEEP},
    {0},
};

static bool read_player(json_reader *r, json_t *value, const json_place *at, void *into)
{
    octree_player *player = into;
    if (json_is_null(value)) {
        *player = (octree_player){.kind = OCTREE_PLAYER_NONE};
        return true;
    }
    const bool body = json_is_true(json_object_get(value, "body"));
    return json_read_members(r, value, at, body ? body_player_members : player_members, player);
}

static void write_player(json_writer *w, const void *from)
{
    const octree_player *player = from;
    if (player->kind == OCTREE_PLAYER_NONE)
        json_write_null(w);
    else
        json_write_object(w, player->kind == OCTREE_PLAYER_BODY ? body_player_members : player_members, player);
}

/* ---- Keys and ticks ----------------------------------------------------------------------------------------- */

bool session_check_keys(const char *keys, octreel_error *error)
{
    const size_t good = strspn(keys, "wasdefnq.");
    const char key = keys[good];
    char name[16];
    if (key == 0)
        return true;
    snprintf(name, sizeof name, key >= ' ' && key <= '~' ? "'%c'" : "byte 0x%02x", (unsigned char)key);
    return error_set(error, "key %zu, %s, is not one of w a s d e f n q .", good + 1, name);
}

static bool read_keys(json_reader *r, json_t *value, const json_place *at, void *into)
{
    const char *keys = json_string_value(value), **copy = into;
    octreel_error reason;
    if (!keys)
        return json_fail_expected(r, value, at, "a string of keys");
    if (!session_check_keys(keys, &reason))
        return json_fail(r, at, "%s", reason.text);
    *copy = strdup(keys);
    return *copy || json_fail(r, at, "out of memory");
}

static bool mark_tick_count_known(json_reader *r, const json_place *at, void *structure)
{
    (void)at, (void)structure;
    get_loader(r)->ends = true;
    return true;
}

static bool has_tick_count(const void *structure)
{
    return ((const session_header *)structure)->session.ticks != SESSION_ENDLESS;
}

/* The largest allowed number of ticks between two successive objects of a session. All ticks between the objects are
 * played and drawn, so a larger number is probably a mistake. */
#define MOST_TICKS_BETWEEN 1000000

/* Returns whether a tick is too far after the tick of the last object. If the header has "ticks", no tick is too
 * far. A tick that has a key in "keys" is never too far. */
static bool is_too_far_ahead(const session_loader *s, uint64_t tick)
{
    const char *keys = s->header.session.keys;
    const uint64_t last = s->tick == OCTREE_EVERY_TICK ? 0 : s->tick;
    return !s->ends && tick > last && tick - last > MOST_TICKS_BETWEEN && tick > (keys ? strlen(keys) : 0);
}

static bool check_tick(json_reader *r, const json_place *at, void *structure)
{
    session_loader *s = get_loader(r);
    const uint64_t tick = ((const session_tick *)structure)->tick;
    if (s->tick != OCTREE_EVERY_TICK && tick <= s->tick)
        return json_fail(r, at, "tick %" PRIu64 " follows tick %" PRIu64 "; ticks must ascend", tick, s->tick);
    if (is_too_far_ahead(s, tick))
        return json_fail(r, at,
                         "tick %" PRIu64 " is more than %d ticks after the object before it, and all ticks between "
                         "them would be played; if this is intended, add \"ticks\" to the header",
                         tick, MOST_TICKS_BETWEEN);
    s->tick = tick;
    if (!s->ends)
        s->header.session.ticks = tick;
    return true;
}

/* ---- Gaps --------------------------------------------------------------------------------------------------- */

static bool read_gap(json_reader *r, json_t *value, const json_place *at, void *into)
{
    session_loader *s = get_loader(r);
    octree_gap *gap = session_append_item(r, at, &s->lists[SESSION_GAPS], sizeof *gap);
    (void)into;
    if (!gap)
        return false;
    gap->tick = s->tick;
    return json_label.read(r, value, at, gap->why) &&
           (*gap->why || json_fail(r, at, "the reason of a gap must not be empty"));
}

static void write_gap(json_writer *w, const void *from)
{
    json_write_string(w, (*(const octree_gap *const *)from)->why);
}

/* ---- The objects of a file ---------------------------------------------------------------------------------- */

octree_session session_make_default_header(void)
{
    octree_session session = {.tree = octree_def_default()};
    session.tree.leaf_capacity = 8;
    /* in this version of the format, a session without "full" has this rule */
    session.tree.full_leaf = OCTREE_REFUSE;
    set_default_player(&session.player, &session.tree.world);
    return session;
}

#define HEADER(where) .offset = offsetof(session_header, where), .line = true

/* The members of the header, in the order in which they are read. The player comes after the world, the points come
 * after the player, and the velocities come after the points, because each of them needs the one before. */
const json_member session_header_members[] = {
    {"octreel", &json_constant, .required = true, .about = "session"},
    {"version", &json_version, .required = true, .max = 2, .about = "session",
     .advice = "rename \"nodes\" to \"foreign_nodes\" and set \"version\": 2"},
    {"world", &json_box, HEADER(session.tree.world), .check = check_world},
    {"tree", &json_structure, HEADER(session.tree), .members = tree_members},
    {"player", JSON_CODEC(read_player, write_player), HEADER(session.player)},
    {"keys", JSON_CODEC(read_keys, json_write_text), HEADER(session.keys), JSON_IF(session_header, session.keys)},
    {"ticks", &json_uint64, HEADER(session.ticks), .max = SESSION_LAST_TICK, .is_set = has_tick_count,
     .check = mark_tick_count_known},
    {"unplayed", &json_uint64, HEADER(session.unplayed), .max = SESSION_LAST_TICK,
     JSON_IF(session_header, session.unplayed)},
    {"pairs", &json_bool, HEADER(session.pairs), JSON_IF(session_header, session.pairs)},
    {"queries", &session_items_codec, HEADER(every_tick.queries), .about = &session_queries,
     JSON_IF(session_header, every_tick.query_count)},
    {"shapes", &session_items_codec, HEADER(every_tick.shapes), .about = &session_shapes,
     JSON_IF(session_header, every_tick.shape_count)},
    {"foreign_nodes", &session_nodes_codec, HEADER(every_tick.foreign), JSON_IF(session_header, every_tick.foreign)},
    {"sampled", &json_structure, HEADER(session.sampled), .given = offsetof(session_header, session.sampled.known),
     .members = session_sampled_members},
    {"columns", &session_columns_codec, HEADER(values), .is_set = session_has_columns},
    {"points", &session_points_codec, HEADER(session)},
    {"velocities", &session_velocities_codec, HEADER(session)},
    {0},
};

#define TICK(where) .offset = offsetof(session_tick, where)

const json_member session_tick_members[] = {
    {"tick", &json_uint64, TICK(tick), .required = true, .max = SESSION_LAST_TICK, .check = check_tick},
    {"edits", &session_items_codec, TICK(input.edits), .about = &session_edits,
     JSON_IF(session_tick, input.edit_count)},
    {"queries", &session_items_codec, TICK(input.queries), .about = &session_queries,
     JSON_IF(session_tick, input.query_count)},
    {"shapes", &session_items_codec, TICK(input.shapes), .about = &session_shapes,
     JSON_IF(session_tick, input.shape_count)},
    {"foreign_nodes", &session_nodes_codec, TICK(input.foreign), JSON_IF(session_tick, input.foreign)},
    {"pairs", &session_pairs_codec, TICK(input.foreign_pairs), JSON_IF(session_tick, input.foreign_pairs)},
    {"gap", JSON_CODEC(read_gap, write_gap), TICK(input.gap), .about = "the reason of a gap", .size = OCTREE_GAP_TEXT,
     JSON_IF(session_tick, input.gap)},
    {0},
};
