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
    point_values made;   /* the values of a file of points; session_end_values() adds those of `listed` */
    point_entry *listed; /* the values that the session itself states, in its order */
    size_t room;
    hash_map ids;    /* the ids of `listed` */
    uint64_t *plain; /* the ids of points that edits inserted without values */
    size_t plain_room;
    hash_map plain_ids, body_ids;   /* the ids of `plain`; those of the bodies, once they have been needed */
    int columns[POINT_VALUE_KINDS]; /* the point_value_kind of each column after the id in rows of points */
    size_t column_count;
} session_values;

/* The state of reading a session; the context of its json_reader. */
typedef struct session_loader {
    const char *folder;    /* where paths of files of points start; null: files and samples are refused */
    session_header header; /* its queries and shapes are in the lists below */
    uint64_t tick;         /* of the object that is being read; OCTREE_EVERY_TICK in the header */
    bool ends;             /* the header has "ticks" */
    cloud points;          /* the file of points, if the world had to be computed from it */
    char note[512];        /* for session_file.note */
    session_values values;
    octree_body *bodies;                                            /* header.session.body_count elements */
    session_list lists[SESSION_LISTS], header_lists[SESSION_LISTS]; /* items of single ticks; items of the header */
} session_loader;

/* Read the header, or the object of a tick, into the loader. */
json_object_reader session_read_header, session_read_tick;

/* Check that the rest of the input is text of at most 2 GiB. False with an error if not. */
bool session_check_text(json_reader *r);

/* Add the header's queries, shapes and foreign nodes to the lists of single ticks: in a session, queries and shapes of
 * every tick come last. */
bool session_append_header_lists(json_reader *r);

/* Make a session of the header and the lists. The loader keeps the ownership of all arrays. */
octree_session session_assemble(const session_loader *s, const session_list lists[SESSION_LISTS]);

/* The input of a tick, made of all edits, queries and shapes of a session, its first gap and its first foreign nodes.
 */
octree_input session_all_input(const octree_session *session);

/* Remove all items of the lists and free their memory; session_release_lists() also frees the arrays. */
void session_clear_lists(session_list lists[SESSION_LISTS]);
void session_release_lists(session_list lists[SESSION_LISTS]);

/* The members of the header, and of the object of a tick. */
extern const json_member session_header_members[], session_tick_members[];

/* The header with the default of every member. */
octree_session session_default_header(void);

/* Lists of edits, queries or shapes; row->about is the type. The codec's value is in an octree_input. */
typedef struct session_items session_items;
extern const session_items session_edits, session_queries, session_shapes;
extern const json_codec session_items_codec;

/* Set the world of the session, and the default position and step of the player in it. */
void session_set_world(session_loader *s, const octree_box *world);

/* If the header has no "world" but a file of points, read the file and compute the world from its points. */
bool session_read_file_world(json_reader *r, json_t *header);

/* The foreign nodes from a tick on. The codec's value is in an octree_input. */
extern const json_codec session_nodes_codec;

/* Points as a list, a file or a sample; and velocities by id, which are only read: writing puts them into the points.
 */
extern const json_codec session_points_codec, session_velocities_codec;

/* Map the bodies by their ids, unless that is done. False with an error if two have the same id, or one has the
 * player's. Then session_find_body() returns the index of a body; HASH_MAP_NONE if no body has the id. */
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
bool session_read_column(json_reader *r, json_t *value, const json_place *at, point_value_kind kind, point_value *into);

/* Write the values of a point as the columns of its row. */
void session_write_columns(json_writer *w, uint64_t id);

/* Set the values of an id. False with an error if the id already has other values. */
bool session_set_value(json_reader *r, const json_place *at, uint64_t id, const point_value *value);

/* Move the listed values into s->values.made. Called at the end of a file, or after each object of a stream. */
bool session_end_values(json_reader *r);
void session_release_listed(session_values *values);

/* Check that the game knows every key. False with the reason if not. */
bool session_check_keys(const char *keys, octreel_error *error);

/* Add an item to a list and return it, not initialized; null with an error if there is no memory. */
void *session_append(json_reader *r, const json_place *at, session_list *list, size_t item_size);

#endif
