/* SPDX-License-Identifier: MIT */
/* session_members.h - tables of the members of a session file. Each row of a table reads and writes one member.
 * Private to the files session_*.c. */
#ifndef FORMATS_SESSION_MEMBERS_H
#define FORMATS_SESSION_MEMBERS_H

#include "cloud.h"
#include "hash_map.h"
#include "json_table.h"
#include "session_file.h"

/* An array that grows as items are appended. */
typedef struct session_list {
    void *items;
    size_t count, room;
} session_list;

/* The header: the first object of a session file. Queries and shapes that apply to every tick are last in a
 * session's arrays, but they are in the header of a file. */
typedef struct session_header {
    octree_session session;     /* without edits, and without queries and shapes of single ticks */
    octree_input every_tick;    /* queries and shapes that apply to every tick */
    const point_values *values; /* the values of points to write; null: no point has values */
} session_header;

/* The object of one tick in a session file. */
typedef struct session_tick {
    uint64_t tick;
    octree_input input;
} session_tick;

/* The lists of a session, as indices. */
enum { SESSION_EDITS, SESSION_QUERIES, SESSION_SHAPES, SESSION_GAPS, SESSION_FOREIGN, SESSION_LISTS };

/* The values of points (colours, intensities and classes) while a session is read. */
typedef struct session_values {
    point_values made;   /* the values from the point file; session_merge_listed_values() adds those of `listed` */
    point_entry *listed; /* the values in the text of the session, in their order */
    size_t room;
    hash_map ids;    /* maps an id to its item of `listed` */
    uint64_t *plain; /* the ids of points that edits inserted without values */
    size_t plain_room;
    hash_map plain_ids, body_ids; /* map an id to its item of `plain`, and to its body; bodies are mapped when needed */
    int columns[POINT_VALUE_KINDS]; /* for rows of points: the point_value_kind of each column after the id */
    size_t column_count;
} session_values;

/* The state while a session is read. It is the context of the json_reader. */
typedef struct session_loader {
    const char *folder;    /* relative paths of point files start here; null: point files and samples are refused */
    session_header header; /* the header without its queries and shapes, which are in header_lists */
    uint64_t tick;         /* the tick whose object is being read; OCTREE_EVERY_TICK: the header is being read */
    bool ends;             /* the header has the member "ticks" */
    cloud points;          /* the points of the point file, if the file was read early to compute the world */
    char note[672];        /* the text for session_file.note */
    session_values values;
    octree_body *bodies;                                            /* an array of header.session.body_count bodies */
    session_list lists[SESSION_LISTS], header_lists[SESSION_LISTS]; /* items of single ticks; items of the header */
} session_loader;

/* Read the header, or the object of a tick, into the session_loader. */
json_object_reader session_read_header, session_read_tick;

/* Checks that the rest of the input is text and has at most 2 GiB. Otherwise returns false with an error. */
bool session_check_is_text(json_reader *r);

/* Moves the header's queries, shapes and foreign nodes into the lists of single ticks. In a session, queries and
 * shapes that apply to every tick come last. */
bool session_append_header_lists(json_reader *r);

/* Returns a session that consists of the header and the lists. The session_loader still owns all arrays. */
octree_session session_assemble(const session_loader *s, const session_list lists[SESSION_LISTS]);

/* Returns one tick's input that consists of all edits, queries and shapes of a session, its first gap and its first
 * foreign nodes. */
octree_input session_collect_input(const octree_session *session);

/* session_clear_lists() removes all items and frees the memory that they own. session_release_lists() also frees the
 * arrays. */
void session_clear_lists(session_list lists[SESSION_LISTS]);
void session_release_lists(session_list lists[SESSION_LISTS]);

/* The tables of the members of the header and of a tick's object. */
extern const json_member session_header_members[], session_tick_members[];

/* Returns a header in which every member has its default. */
octree_session session_make_default_header(void);

/* The types of lists, which a row's `about` points to. Their codec reads and writes lists in an octree_input. */
typedef struct session_items session_items;
extern const session_items session_edits, session_queries, session_shapes;
extern const json_codec session_items_codec;

/* Sets the world of the session, and the player's default position and step in this world. */
void session_set_world(session_loader *s, const octree_box *world);

/* If the header has a point file and no "world", reads the file and computes the world from its points. Returns
 * false with an error. */
bool session_find_file_world(json_reader *r, json_t *header);

/* The codec of the foreign nodes that apply from a tick on. It reads and writes them in an octree_input. */
extern const json_codec session_nodes_codec;

/* The codec of points, which are a list, a file or a sample; and the codec of velocities, which are listed by id.
 * Velocities are only read, because they are written together with the points. */
extern const json_codec session_points_codec, session_velocities_codec;

/* session_map_bodies() maps the bodies by their ids, unless they are mapped already. It returns false with an error
 * if two bodies have the same id, or if a body has the player's id. Then session_find_body() returns the index of
 * the body with an id, or HASH_MAP_NONE. */
bool session_map_bodies(json_reader *r, const json_place *at);
uint32_t session_find_body(const session_loader *s, uint64_t id);

/* The members of "sampled" (octree_sampled), which says how the listed points and velocities were generated. */
extern const json_member session_sampled_members[];

/* The members and codecs of a body: id, position, velocity and values. If an edit inserts a body, the id is
 * required. */
extern const json_member session_body_members[];
extern const json_codec session_body_codec, session_insert_codec;

/* The codec of "columns": the names of the columns that rows of points have after the id. */
extern const json_codec session_columns_codec;
bool session_has_columns(const void *header);

/* Reads one value of a row of points. JSON null stands for a missing value. */
bool session_read_column_value(json_reader *r, json_t *value, const json_place *at, point_value_kind kind,
                               point_value *into);

/* Writes the values of a point as columns of its row. */
void session_write_column_values(json_writer *w, uint64_t id);

/* Sets the values of the point with an id. Returns false with an error if the id already has other values. */
bool session_set_value(json_reader *r, const json_place *at, uint64_t id, const point_value *value);

/* Moves the values of `listed` into `made`. Called at the end of a file, or after each object of a stream. */
bool session_merge_listed_values(json_reader *r);
void session_release_values(session_values *values);

/* Checks that a game knows every key. Otherwise returns false with an error. */
bool session_check_keys(const char *keys, octreel_error *error);

/* Appends an uninitialized item to a list and returns it. Returns null with an error if memory runs out. */
void *session_append_item(json_reader *r, const json_place *at, session_list *list, size_t item_size);

#endif
