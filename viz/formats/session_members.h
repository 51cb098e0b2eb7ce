/* SPDX-License-Identifier: MIT */
/* session_members.h - tables of the members of a session file: each row reads and writes one member. Private to the
 * files session_*.c. */
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

/* The first object of a file. Queries and shapes of every tick are last in a session's arrays, but first in its file.
 */
typedef struct session_header {
    octree_session session;     /* without edits, and without the queries and shapes of single ticks */
    octree_input every_tick;    /* queries and shapes of every tick */
    const point_values *values; /* the values to write; null for none */
} session_header;

/* The object of a tick. */
typedef struct session_tick {
    uint64_t tick;
    octree_input input;
} session_tick;

/* The lists of a session. */
enum { SESSION_EDITS, SESSION_QUERIES, SESSION_SHAPES, SESSION_GAPS, SESSION_FOREIGN, SESSION_LISTS };

/* The values of points while a session is read. */
typedef struct session_values {
    point_values made;   /* the values of a file of points, and after session_merge_listed_values() those of `listed` */
    point_entry *listed; /* the values in the session's own text, in its order */
    size_t room;
    hash_map ids;    /* the ids of `listed` */
    uint64_t *plain; /* the ids of points that edits inserted without values */
    size_t plain_room;
    hash_map plain_ids, body_ids;   /* the ids of `plain`; the ids of the bodies, mapped when first needed */
    int columns[POINT_VALUE_KINDS]; /* the point_value_kind of each column after the id in rows of points */
    size_t column_count;
} session_values;

/* The state of reading a session; the context of its json_reader. */
typedef struct session_loader {
    const char *folder;    /* the folder of relative paths of files of points; null: files and samples are refused */
    session_header header; /* its queries and shapes are in the lists below */
    uint64_t tick;         /* the tick of the object that is being read; OCTREE_EVERY_TICK in the header */
    bool ends;             /* the header has "ticks" */
    cloud points;          /* the file of points, if it was read to compute the world */
    char note[512];        /* for session_file.note */
    session_values values;
    octree_body *bodies;                                            /* header.session.body_count elements */
    session_list lists[SESSION_LISTS], header_lists[SESSION_LISTS]; /* items of single ticks; items of the header */
} session_loader;

/* Read the header, or the object of a tick, into the loader. */
json_object_reader session_read_header, session_read_tick;

/* Check that the rest of the input is text of at most 2 GiB. Returns false, with an error, if not. */
bool session_check_is_text(json_reader *r);

/* Add the header's queries, shapes and foreign nodes to the lists of single ticks. In a session, queries and shapes of
 * every tick come last. */
bool session_append_header_lists(json_reader *r);

/* Make a session from the header and the lists. The loader still owns all arrays. */
octree_session session_assemble(const session_loader *s, const session_list lists[SESSION_LISTS]);

/* Returns a tick's input made of all edits, queries and shapes of a session, its first gap and its first foreign nodes.
 * */
octree_input session_collect_input(const octree_session *session);

/* Remove all items of the lists and free their memory; session_release_lists() also frees the arrays. */
void session_clear_lists(session_list lists[SESSION_LISTS]);
void session_release_lists(session_list lists[SESSION_LISTS]);

/* The members of the header, and of the object of a tick. */
extern const json_member session_header_members[], session_tick_members[];

/* Returns a header with the default of every member. */
octree_session session_make_default_header(void);

/* Lists of edits, queries or shapes; row->about is the type. The codec's value is in an octree_input. */
typedef struct session_items session_items;
extern const session_items session_edits, session_queries, session_shapes;
extern const json_codec session_items_codec;

/* Set the world of the session, and the default position and step of the player in it. */
void session_set_world(session_loader *s, const octree_box *world);

/* If the header has a file of points and no "world", read the file and compute the world from its points. */
bool session_find_file_world(json_reader *r, json_t *header);

/* The foreign nodes from a tick on. The codec's value is in an octree_input. */
extern const json_codec session_nodes_codec;

/* Points as a list, a file or a sample; and velocities by id. Velocities are only read: they are written with the
 * points. */
extern const json_codec session_points_codec, session_velocities_codec;

/* Map the bodies by their ids, unless they are mapped already. Returns false, with an error, if two bodies have the
 * same id, or one has the player's. Afterwards session_find_body() returns the index of a body; HASH_MAP_NONE if no
 * body has the id. */
bool session_map_bodies(json_reader *r, const json_place *at);
uint32_t session_find_body(const session_loader *s, uint64_t id);

/* The members of "sampled" (octree_sampled): how listed points and velocities were generated. */
extern const json_member session_sampled_members[];

/* A body: id, position, velocity and values. In an edit that inserts it, the id is required. */
extern const json_member session_body_members[];
extern const json_codec session_body_codec, session_insert_codec;

/* The names of the columns that rows of points have after the id. */
extern const json_codec session_columns_codec;
bool session_has_columns(const void *header);

/* Read one value of a row of points; JSON null means a missing value. */
bool session_read_column_value(json_reader *r, json_t *value, const json_place *at, point_value_kind kind,
                               point_value *into);

/* Write the values of a point as the columns of its row. */
void session_write_column_values(json_writer *w, uint64_t id);

/* Set the values of an id. Returns false, with an error, if the id already has other values. */
bool session_set_value(json_reader *r, const json_place *at, uint64_t id, const point_value *value);

/* Move the values of `listed` into `made`. Called at the end of a file, or after each object of a stream. */
bool session_merge_listed_values(json_reader *r);
void session_release_values(session_values *values);

/* Check that the game knows every key. Returns false, with an error, if not. */
bool session_check_keys(const char *keys, octreel_error *error);

/* Add an item to a list and return it uninitialized. When out of memory, returns null with an error. */
void *session_append_item(json_reader *r, const json_place *at, session_list *list, size_t item_size);

#endif
