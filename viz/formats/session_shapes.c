/* session_shapes.c - the shapes of a session file. */
#include "session_reader.h"

#include <string.h>

static bool read_box(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_shape *shape = into;
    octree_box box;
    if (!session_read_box(reader, value, at, &box))
        return false;
    for (int i = 0; i < 3; i++)
        if (box.min[i] > box.max[i])
            return session_fail(reader, at, "min must not be above max, and is on %c", "xyz"[i]);
    memcpy(shape->at, box.min, sizeof shape->at);
    memcpy(shape->to, box.max, sizeof shape->to);
    return true;
}

static bool read_segment(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    octree_shape *shape = into;
    if (!json_is_array(value) || json_array_size(value) != 2)
        return session_expected(reader, value, at, "two places [[x, y, z], [x, y, z]]");
    return session_read_vector(reader, json_array_get(value, 0), &(json_place){at, NULL, 0}, shape->at) &&
           session_read_vector(reader, json_array_get(value, 1), &(json_place){at, NULL, 1}, shape->to);
}

static bool read_text(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const char *text = json_string_value(value);
    char *room = into;
    if (!text)
        return session_expected(reader, value, at, "a text");
    const size_t length = strlen(text);
    for (size_t i = 0; i < length; i++)
        if (text[i] < ' ' || text[i] > '~')
            return session_fail(reader, at, "a label is of printable ASCII characters, and byte %zu is none", i + 1);
    if (length >= OCTREE_SHAPE_TEXT)
        return session_fail(reader, at, "a label has at most %d characters, not %zu", OCTREE_SHAPE_TEXT - 1, length);
    memcpy(room, text, length + 1);
    return true;
}

/* The members of each kind of shape; the first bears its name. */
static const session_member shape_members[OCTREE_SHAPE_KINDS][SESSION_KIND_MEMBERS] = {
    [OCTREE_SHAPE_BOX] = {{"box", read_box, 0, true}},
    [OCTREE_SHAPE_SEGMENT] = {{"segment", read_segment, 0, true}},
    [OCTREE_SHAPE_POINT] = {{"point", session_read_vector, offsetof(octree_shape, at), true}},
    [OCTREE_SHAPE_LABEL] = {{"label", read_text, offsetof(octree_shape, text), true},
                            {"at", session_read_vector, offsetof(octree_shape, at), true}},
};

static bool read_shape(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    const int kind = session_read_kind(reader, value, at, shape_members, OCTREE_SHAPE_KINDS,
                                       "{\"box\": ...}, {\"segment\": ...}, {\"point\": ...} or {\"label\": ...}");
    if (kind == OCTREE_SHAPE_KINDS)
        return false;
    octree_shape *shape = session_append(reader, at, into, sizeof *shape);
    if (!shape)
        return false;
    *shape = (octree_shape){.tick = reader->tick, .kind = (octree_shape_kind)kind};
    return session_read_members(reader, value, at, shape_members[kind], shape);
}

bool session_read_shapes(session_reader *reader, json_t *value, const json_place *at, void *into)
{
    (void)into;
    return session_read_elements(reader, value, at, "a list of shapes", read_shape,
                                 reader->tick == OCTREE_EVERY_TICK ? &reader->standing_shapes : &reader->shapes);
}
