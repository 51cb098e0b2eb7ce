/* SPDX-License-Identifier: MIT */
/* session_members.h - the members of a session file, one row each, by which they are read and written. Private to
 * session_*.c.
 */
#ifndef FORMATS_SESSION_MEMBERS_H
#define FORMATS_SESSION_MEMBERS_H

#include "cloud.h"
#include "hash_map.h"
#include "json_table.h"
#include "session_file.h"

/* A growing array. */
typedef struct session_list {
    void *items;
    size_t count, room;
} session_list;

/* The first object of a file. Queries and shapes of every tick come last in a session's arrays, but first in its file.
 */
typedef struct session_header {
    octree_session session;     /* without edits, and without the queries and shapes of single ticks */
    octree_input standing;      /* queries and shapes of every tick */
    const point_values *values; /* to be written; may be null */
} session_header;

/* Each of the others: what happens in one tick. */
typedef struct session_tick {
    uint64_t tick;
    octree_input input;
} session_tick;

/* The lists of a session: those whose objects are of one kind among several, the gaps, and the nodes of programs. */
enum { SESSION_EDITS, SESSION_QUERIES, SESSION_SHAPES, SESSION_GAPS, SESSION_FOREIGN, SESSION_LISTS };

/* The values of points while a session is read. */
typedef struct session_values {
    point_values made;   /* of a file of points; at the end of all */
    point_entry *listed; /* of points in the session itself, in its order */
    size_t room;
    hash_map ids;    /* of those */
    uint64_t *plain; /* of points that edits inserted without values */
    size_t plain_room;
    hash_map plain_ids, body_ids;   /* of those; of the bodies, which are looked up when an edit gives values */
    int columns[POINT_VALUE_KINDS]; /* a point_value_kind each: what rows of points have after the id */
    size_t column_count;
} session_values;

/* A session that is being read: the context of its json_reader. */
typedef struct session_loader {
    const char *folder;    /* of files of points; null: neither those nor samples are read */
    session_header header; /* its queries and shapes are in the lists below */
    uint64_t tick;         /* of the object at hand; OCTREE_EVERY_TICK in the header */
    bool ends;             /* the header says after how many ticks */
    cloud points;          /* of the file that the header names, where it was needed before its turn */
    char note[512];        /* for session_file.note */
    session_values values;
    octree_body *bodies;                                        /* header.session.body_count of them */
    session_list lists[SESSION_LISTS], standing[SESSION_LISTS]; /* of single ticks; of every tick */
} session_loader;

/* The objects of a file: its header, and one of a tick. What they hold goes to the loader. */
json_object_reader session_read_header, session_read_tick;

/* False, with an error, where what is left to read is no text, or too long a one. */
bool session_check_text(json_reader *r);

/* Append the standing queries and shapes to the lists: what is of every tick comes last in a session, though it is the
 * first in its file. */
bool session_append_standing(json_reader *r);

/* The session of the header, with these lists; all of it is still the loader's. */
octree_session session_assemble(const session_loader *s, const session_list lists[SESSION_LISTS]);

/* Empty lists, and free what they hold; the other frees them, too. */
void session_clear_lists(session_list lists[SESSION_LISTS]);
void session_release_lists(session_list lists[SESSION_LISTS]);

/* The tables of both. */
extern const json_member session_header_members[], session_tick_members[];

/* What the members that are left out stand for. */
octree_session session_default_header(void);

/* A list of such objects, by row->about; it stands in an octree_input. */
typedef struct session_items session_items;
extern const session_items session_edits, session_queries, session_shapes;
extern const json_codec session_items_codec;

/* Give the session a world, and its player the place and step that follow from it. */
void session_set_world(session_loader *s, const octree_box *world);

/* Where a header names no world but a file of points, read that and take the world of its points. */
bool session_take_world(json_reader *r, json_t *header);

/* The foreign nodes from a tick on; it stands in an octree_input. */
extern const json_codec session_nodes_codec;

/* Points, in a list, a file or a sample; and velocities by id, which are never written: bodies have theirs. */
extern const json_codec session_points_codec, session_velocities_codec;

/* octree_sampled: what points that are listed were, where they were a sample. */
extern const json_member session_sampled_members[];

/* A body: id, position, velocity and values. Of an edit that inserts it the id is required. */
extern const json_member session_body_members[];
extern const json_codec session_body_codec, session_insert_codec;

/* Names of values: what the rows of points have. */
extern const json_codec session_columns_codec;

/* Read a value of a row of points; null is none. */
bool session_read_column(json_reader *r, json_t *value, const json_place *at, point_value_kind kind, point_value *into);

/* The values of a point that is written, as the columns of its row. */
void session_write_columns(json_writer *w, uint64_t id);

/* Keep the values of an id. False where it was given others. */
bool session_keep_value(json_reader *r, const json_place *at, uint64_t id, const point_value *value);

/* Put the values that were listed into s->values.made: at the end, or after each object of a stream. */
bool session_end_values(json_reader *r);
void session_release_listed(session_values *values);

/* False with the reason when the game does not know a key. */
bool session_check_keys(const char *keys, octreel_error *error);

/* Read printable ASCII into so many bytes, its final zero included; `what` is for errors, such as "a label". */
bool session_read_text(json_reader *r, json_t *value, const json_place *at, const char *what, size_t room, char *into);

/* Read a list of ids into a new array, to be freed with free(). */
bool session_read_ids(json_reader *r, json_t *value, const json_place *at, const uint64_t **ids, size_t *count);

/* Room for one more item; null with an error when there is no memory. */
void *session_append(json_reader *r, const json_place *at, session_list *list, size_t item_size);

#endif
