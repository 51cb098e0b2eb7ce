/* session_reader.h - what the parts of the session reader share: the file being read, values of each type, and the
 * sentences of errors. The reader of recording.json takes its values and sentences from here too; nobody else includes
 * this.
 *
 * Readers take a JSON value, its place (for errors), and where the result goes. They return false with the error
 * written.
 */
#ifndef RECORD_SESSION_READER_H
#define RECORD_SESSION_READER_H

#include "json_place.h"
#include "session_file.h"

#include <jansson.h>

/* A growing array. */
typedef struct session_list {
    void *items;
    size_t count, capacity;
} session_list;

/* A session file on its way into *session. The arrays are kept here while they grow. */
typedef struct session_reader {
    const char *name, *folder;
    const char *object, *limit; /* the text of the object at hand, which may end before limit */
    size_t line;                /* where the object begins */
    uint64_t tick;              /* that the object is about; OCTREE_EVERY_TICK in the header */
    bool ends;                  /* the header says after how many ticks */
    octree_session *session;
    octree_body *bodies;
    char *keys;
    session_list edits, queries;
    session_list standing; /* queries of every tick */
    session_list shapes, standing_shapes;
    octreel_error *error;
} session_reader;

typedef bool session_value_reader(session_reader *reader, json_t *value, const json_place *at, void *into);

/* A member of an object: its name and what reads it. */
typedef struct session_member {
    const char *name; /* null ends a table */
    session_value_reader *read;
    size_t offset; /* of the result, in what the object is read into */
    bool required;
} session_member;

/* Read an object member by member, in the table's order. Members that the table does not have are errors. */
bool session_read_members(session_reader *reader, json_t *object, const json_place *at, const session_member *table,
                          void *into);

/* An object is of one kind among several, whose members begin with one that bears the kind's name. Its number; `count`
 * where it is none of them or two at once, which is an error. `forms` tells what they look like: "{...}, {...} or
 * {...}". */
#define SESSION_KIND_MEMBERS 3
int session_read_kind(session_reader *reader, json_t *object, const json_place *at,
                      const session_member kinds[][SESSION_KIND_MEMBERS], int count, const char *forms);

/* Read each element of a list, which may be long, with the same reader and the same `into`. */
bool session_read_elements(session_reader *reader, json_t *list, const json_place *at, const char *expected,
                           session_value_reader *read, void *into);

/* ---- Values ------------------------------------------------------------------------------------------------- */

bool session_read_whole(session_reader *reader, const json_t *value, const json_place *at, uint64_t min, uint64_t max,
                        uint64_t *into);

session_value_reader session_read_bool;
session_value_reader session_read_number;   /* into double */
session_value_reader session_read_positive; /* into double; 0 or more */
session_value_reader session_read_vector;   /* into double[3] */
session_value_reader session_read_box;      /* into octree_box; min and max in any order */
session_value_reader session_read_id;       /* into uint64_t; seeds too */

/* ---- Parts of a session ------------------------------------------------------------------------------------- */

bool session_read_header(session_reader *reader, json_t *header);
bool session_read_tick(session_reader *reader, json_t *object);

/* Into the reader's lists: points, their velocities, and the queries and shapes of the reader's tick. */
session_value_reader session_read_points, session_read_velocities, session_read_queries, session_read_shapes;

/* False with the reason when a key is none that the game knows. */
#define SESSION_KEYS_REASON 96
bool session_check_keys(const char *keys, char reason[SESSION_KEYS_REASON]);

/* ---- Memory and errors -------------------------------------------------------------------------------------- */

/* Room for one more item of a list; null with an error when there is no memory. */
void *session_append(session_reader *reader, const json_place *at, session_list *list, size_t item_size);

/* Write the error about a place, a printf format, and return false. */
bool session_fail(session_reader *reader, const json_place *at, const char *format, ...);

/* Write what the parser of JSON says of a text that is none. Of its own settings it must not speak, nor of a list,
 * which has no place among the objects of a file. Returns false. */
bool session_fail_parsed(session_reader *reader, const json_error_t *parsed);

/* Write "expected <what>, found <the value>" and return false. */
bool session_expected(session_reader *reader, const json_t *value, const json_place *at, const char *what);

/* The end of a file's name that leaves room for a reason. */
const char *session_name_end(const char *name);

/* The line where a place begins. */
size_t session_line(const session_reader *reader, const json_place *at);

/* Write the error about a line of the file, with the place's name where there is one, and return false. */
bool session_fail_line(session_reader *reader, size_t line, const char *where, const char *reason);

#endif
