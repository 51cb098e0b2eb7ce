/* SPDX-License-Identifier: MIT */
/* session_members.h - tables of the members of a session file. Each row of a table reads and writes one member.
 * Private to the files session_*.c. */
#ifndef FORMATS_SESSION_MEMBERS_H
#define FORMATS_SESSION_MEMBERS_H

#include "cloud.h"
#include "hash_map.h"
#include "json_table.h"
#include "session_file.h"

/* A growing array of items. */
typedef struct session_list {
    void *items;
    size_t count, room;
} session_list;

/* The header: the first object of a session file. It contains the queries and shapes that apply to every tick. In an
 * octree_session, these queries and shapes are at the end of the arrays. */
typedef struct session_header {
    octree_session session;  /* the session without its edits, and without the queries and shapes of single ticks */
    octree_input every_tick; /* the queries and shapes that apply to every tick */
    /* when writing: the colours, intensities and classes of points; null: no point has values */
    const point_values *values;
} session_header;

/* The object of one tick in a session file. */
typedef struct session_tick {
    uint64_t tick;
    octree_input input;
} session_tick;

/* The indices of the lists of a session. */
enum { SESSION_EDITS, SESSION_QUERIES, SESSION_SHAPES, SESSION_GAPS, SESSION_FOREIGN, SESSION_PAIRS, SESSION_LISTS };

/* The state of reading the values of points (colours, intensities and classes). */
typedef struct session_values {
    point_values made;   /* values from the point file; session_merge_listed_values() adds the values in `listed` */
    point_entry *listed; /* values from the text of the session, in the order of the text; owned */
    size_t room;
    hash_map ids;    /* maps the id of a point to the index of its item in `listed` */
    uint64_t *plain; /* the ids of points that edits inserted without values; owned */
    size_t plain_room;
    /* plain_ids maps an id to its index in `plain`; body_ids maps an id to its body and is filled when first needed */
    hash_map plain_ids, body_ids;
    /* if points are written as rows, the point_value_kind of each column after the id */
    int columns[POINT_VALUE_KINDS];
    size_t column_count;
} session_values;

/* The state while a session is read. A pointer to this state is the context of the json_reader. */
typedef struct session_loader {
    /* the folder at which relative paths of point files start; null: point files and samples are refused */
    const char *folder;
    session_header header; /* the header; its queries and shapes are in header_lists instead */
    /* the tick of the object that is being read; OCTREE_EVERY_TICK while the header is being read */
    uint64_t tick;
    bool ends; /* true: the header has the member "ticks" */
    /* the points of the point file, if the file was read early to compute the world; else empty */
    cloud points;
    char note[672]; /* the text for session_file.note */
    session_values values;
    octree_game_body *bodies; /* an array of header.session.body_count bodies */
    /* the items of single ticks, and the items of the header */
    session_list lists[SESSION_LISTS], header_lists[SESSION_LISTS];
} session_loader;

/* Read one object into the session_loader: the header or the object of a tick. */
json_object_reader session_read_header, session_read_tick;

/* Checks that the remaining input is text of at most 2 GiB. Otherwise returns false with an error. */
bool session_check_is_text(json_reader *r);

/* Moves the queries, shapes and foreign nodes of the header into the lists of single ticks. Queries and shapes of
 * the header become the last items of their lists, where a session has the items that apply to every tick. */
bool session_move_header_lists(json_reader *r);

/* Returns a session made of the header and the lists. Its arrays are not copied: the session_loader still owns them. */
octree_session session_assemble(const session_loader *s, const session_list lists[SESSION_LISTS]);

/* Returns an input that contains all edits, queries and shapes of a session, its first gap, its first foreign nodes and
 * its first foreign pairs. The caller passes a session that holds only the items of one tick. */
octree_input session_collect_input(const octree_session *session);

/* session_clear_lists() removes all items and frees the memory that the items own. session_release_lists() frees the
 * arrays as well. */
void session_clear_lists(session_list lists[SESSION_LISTS]);
void session_release_lists(session_list lists[SESSION_LISTS]);

/* The tables of the members of the header and of a tick's object. */
extern const json_member session_header_members[], session_tick_members[];

/* Returns a header in which every member has its default. */
octree_session session_make_default_header(void);

/* The types of lists: edits, queries and shapes. The member `about` of a table row points to one of them. The codec
 * reads and writes the list in an octree_input. */
typedef struct session_items session_items;
extern const session_items session_edits, session_queries, session_shapes;
extern const json_codec session_items_codec;

/* Sets the world of the session, and the player's default position and step in this world. */
void session_set_world(session_loader *s, const octree_box *world);

/* If the header has a point file and no "world", reads the file and computes the world from its points. Returns
 * false with an error. */
bool session_compute_world_from_file(json_reader *r, json_t *header);

/* The codec of foreign nodes. Foreign nodes apply from their tick on. The codec reads and writes these nodes in an
 * octree_input. */
extern const json_codec session_nodes_codec;

/* The codec of the pairs that a foreign index found at a tick, in an octree_input. */
extern const json_codec session_pairs_codec;

/* The codecs of points and of velocities. Points are a list, a point file or a sample. Velocities are listed by the
 * ids of points. The codec of velocities only reads, because velocities are written together with the points. */
extern const json_codec session_points_codec, session_velocities_codec;

/* session_map_bodies() maps the ids of bodies to their indices, unless this was done before. It returns false with
 * an error if two bodies have the same id, or if a body has the player's id. session_find_body() then returns the
 * index of the body with a given id, or HASH_MAP_NONE. */
bool session_map_bodies(json_reader *r, const json_place *at);
uint32_t session_find_body(const session_loader *s, uint64_t id);

/* The members of "sampled" (octree_sampled), which says how the listed points and velocities were generated. */
extern const json_member session_sampled_members[];

/* The members of a body, and its codecs: id, position, velocity and values (colour, intensity, class). A body that
 * an edit inserts must have an id. */
extern const json_member session_body_members[];
extern const json_codec session_body_codec, session_insert_codec;

/* The codec of "columns": the names of the columns that rows of points have after the id. */
extern const json_codec session_columns_codec;
bool session_has_columns(const void *header);

/* Reads one value in the row of a point. JSON null stands for a missing value. */
bool session_read_column_value(json_reader *r, json_t *value, const json_place *at, point_value_kind kind,
                               point_value *into);

/* Writes the values of a point (colour, intensity, class) as columns of the point's row. */
void session_write_column_values(json_writer *w, uint64_t id);

/* Sets the values of the point with this id. Returns false with an error if the point already has other values. */
bool session_set_value(json_reader *r, const json_place *at, uint64_t id, const point_value *value);

/* Moves the values that were read from the reader's list `listed` to the session `made`. The reader calls this at the
 * end of a file, or after each object of a stream. */
bool session_merge_listed_values(json_reader *r);
void session_release_values(session_values *values);

/* Checks that all keys (key presses of the player) are known to a game. Otherwise returns false with an error. */
bool session_check_keys(const char *keys, octreel_error *error);

/* Appends an uninitialized item to a list and returns a pointer to the item. Returns null with an error if memory
 * runs out. */
void *session_append_item(json_reader *r, const json_place *at, session_list *list, size_t item_size);

#endif
