/* session_header.c - the header of a session file: world, tree, player and keys. */
#include "session_reader.h"

#include <string.h>

/* ---- What the file is --------------------------------------------------------------------------------------- */

static bool read_kind(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *kind = json_string_value(value);
    (void)into;
    return (kind && strcmp(kind, "session") == 0) || session_expected(reader, value, at, "\"session\"");
}

static bool read_version(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    (void)into;
    return (json_is_real(value) && json_real_value(value) == 1) ||
           session_expected(reader, value, at, "1, the only version there is");
}

/* ---- World and tree ----------------------------------------------------------------------------------------- */

static double box_size_of(double step)
{
    return 0.6 * step;
}

/* Halves first: no world overflows. Rounding must not take the centre out of a world of a few ulps. */
static void place_player(octree_player *player, const octree_box *world)
{
    double longest = 0;
    for (int i = 0; i < 3; i++) {
        double half = world->max[i] / 2 - world->min[i] / 2;
        double centre = world->min[i] / 2 + world->max[i] / 2;
        longest = half > longest ? half : longest;
        centre = centre < world->min[i] ? world->min[i] : centre;
        player->position[i] = centre > world->max[i] ? world->max[i] : centre;
    }
    player->step = longest / 20;
    player->box_size = box_size_of(player->step);
}

static bool read_world(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_session *session = into;
    octree_box *world = &session->tree.world;
    if (!session_read_box(reader, value, at, world))
        return false;
    for (int i = 0; i < 3; i++)
        if (world->min[i] >= world->max[i])
            return session_fail(reader, at, "min must be below max on every axis, and is not on %c", "xyz"[i]);
    place_player(&session->player, world);
    return true;
}

static bool read_capacity(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    uint64_t capacity;
    if (!session_read_whole(reader, value, at, 1, UINT32_MAX, &capacity))
        return false;
    *(size_t *)into = (size_t)capacity;
    return true;
}

static bool read_depth(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    uint64_t depth;
    if (!session_read_whole(reader, value, at, 0, OCTREE_MAX_DEPTH, &depth))
        return false;
    *(size_t *)into = (size_t)depth;
    return true;
}

static bool read_full(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *name = json_string_value(value);
    octree_full_leaf *full = into;
    if (!name || (strcmp(name, "refuse") != 0 && strcmp(name, "grow") != 0))
        return session_expected(reader, value, at, "\"refuse\" or \"grow\"");
    *full = *name == 'g' ? OCTREE_GROW : OCTREE_REFUSE;
    return true;
}

static bool read_tree(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    static const session_member members[] = {
        {"capacity", read_capacity, offsetof(octree_def, leaf_capacity), false},
        {"depth", read_depth, offsetof(octree_def, max_depth), false},
        {"full", read_full, offsetof(octree_def, full_leaf), false},
        {0},
    };
    return session_read_members(reader, value, at, members, into);
}

/* ---- Player ------------------------------------------------------------------------------------------------- */

static bool read_player_position(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const octree_box *world = &reader->session->tree.world;
    double *position = into;
    if (!session_read_vector(reader, value, at, position))
        return false;
    for (int i = 0; i < 3; i++)
        if (position[i] < world->min[i] || position[i] > world->max[i])
            return session_fail(reader, at, "the player is outside the world on %c", "xyz"[i]);
    return true;
}

/* The box follows the step, unless its size is given too. */
static bool read_step(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_player *player = into;
    if (!session_read_positive(reader, value, at, &player->step))
        return false;
    player->box_size = box_size_of(player->step);
    return true;
}

static bool read_is_body(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_player *player = into;
    bool is_body;
    if (!session_read_bool(reader, value, at, &is_body))
        return false;
    player->kind = is_body ? OCTREE_PLAYER_BODY : OCTREE_PLAYER_KEYS;
    return true;
}

/* Where a body is, and how far it goes, is said by the point with its id. */
static bool read_player(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    static const session_member members[] = {
        {"id", session_read_id, offsetof(octree_player, id), false},
        {"body", read_is_body, 0, false},
        {"position", read_player_position, offsetof(octree_player, position), false},
        {"step", read_step, 0, false},
        {"box_size", session_read_positive, offsetof(octree_player, box_size), false},
        {"sweep", session_read_bool, offsetof(octree_player, sweep), false},
        {0},
    };
    static const session_member body_members[] = {
        {"id", session_read_id, offsetof(octree_player, id), false},
        {"body", read_is_body, 0, false},
        {"box_size", session_read_positive, offsetof(octree_player, box_size), false},
        {"sweep", session_read_bool, offsetof(octree_player, sweep), false},
        {0},
    };
    const bool is_body = json_is_true(json_object_get(value, "body"));
    if (json_is_null(value)) {
        *(octree_player *)into = (octree_player){.kind = OCTREE_PLAYER_NONE};
        return true;
    }
    return session_read_members(reader, value, at, is_body ? body_members : members, into);
}

/* ---- Keys and ticks ----------------------------------------------------------------------------------------- */

bool session_check_keys(const char *keys, char reason[SESSION_KEYS_REASON])
{
    static const char known[] = "wasdefnq.";
    size_t good = strspn(keys, known);
    char key = keys[good];
    if (key == '\0')
        return true;
    char name[16];
    bool printable = key >= ' ' && key <= '~';
    snprintf(name, sizeof name, printable ? "'%c'" : "byte 0x%02x", (unsigned char)key);
    snprintf(reason, SESSION_KEYS_REASON, "key %zu, %s, is not one of w a s d e f n q .", good + 1, name);
    return false;
}

static bool read_keys(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *keys = json_string_value(value);
    char reason[SESSION_KEYS_REASON];
    (void)into;
    if (!keys)
        return session_expected(reader, value, at, "a string of keys");
    if (!session_check_keys(keys, reason))
        return session_fail(reader, at, "%s", reason);
    reader->keys = strdup(keys);
    return reader->keys || session_fail(reader, at, "out of memory");
}

static bool read_ticks(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    reader->ends = true;
    return session_read_whole(reader, value, at, 0, SESSION_LAST_TICK, into);
}

/* ---- Header ------------------------------------------------------------------------------------------------- */

static octree_session default_header(void)
{
    octree_session session = {.tree = octree_def_default()};
    session.tree.leaf_capacity = 8;
    place_player(&session.player, &session.tree.world);
    return session;
}

/* The table's order is that of need: positions need the world, velocities need the points. */
bool session_read_header(session_reader *reader, json_t *header)
{
    static const session_member members[] = {
        {"octreel", read_kind, 0, true},
        {"version", read_version, 0, true},
        {"world", read_world, 0, false},
        {"tree", read_tree, offsetof(octree_session, tree), false},
        {"player", read_player, offsetof(octree_session, player), false},
        {"points", session_read_points, 0, false},
        {"velocities", session_read_velocities, 0, false},
        {"keys", read_keys, 0, false},
        {"ticks", read_ticks, offsetof(octree_session, ticks), false},
        {"queries", session_read_queries, 0, false},
        {"shapes", session_read_shapes, 0, false},
        {0},
    };
    *reader->session = default_header();
    reader->tick = OCTREE_EVERY_TICK;
    if (!json_object_get(header, "octreel"))
        return session_fail(reader, NULL, "is no session: the first object has no \"octreel\": \"session\"");
    return session_read_members(reader, header, NULL, members, reader->session);
}
