/* SPDX-License-Identifier: MIT */
/* json_table.h - reads and writes structures as JSON objects. One table lists the members and serves both directions.
 */
#ifndef BASE_JSON_TABLE_H
#define BASE_JSON_TABLE_H

#include "json_read.h"
#include "json_write.h"

/* Read a value into `into`. Returns false, with an error, if it is invalid. r->row is the member's table row. */
typedef bool json_read_value(json_reader *r, json_t *value, const json_place *at, void *into);

/* Write the value of one member. w->row is the table row that describes the member. */
typedef void json_write_value(json_writer *w, const void *from);

typedef struct json_codec {
    json_read_value *read;   /* null: the member is written but never read */
    json_write_value *write; /* null: the member is read but never written */
} json_codec;

/* Returns the n-th name of a list; null after the last. */
typedef const char *json_name(int n);

/* Define `names` as a json_name from a function that names the values of an enumeration. */
#define JSON_NAMES(names, name_of, enumeration)                                                                        \
    static const char *names(int n)                                                                                    \
    {                                                                                                                  \
        return name_of((enumeration)n);                                                                                \
    }

/* A row of a table. The first three members are enough for a plain value. */
typedef struct json_member {
    const char *name; /* null ends a table */
    const json_codec *codec;
    size_t offset; /* offset of the value in the structure */

    /* The member is written if all of these conditions hold. */
    size_t given;                          /* offset of a bool that is true; reading sets it; 0: no condition */
    size_t nonzero, nonzero_size;          /* offset and size of bytes that are not all 0; see JSON_IF() */
    bool (*is_set)(const void *structure); /* returns true; null: no condition */
    bool nullable;                         /* if a condition fails, null is written; null is accepted when reading */
    bool line;                             /* written on a line of its own */

    bool required; /* reading fails without the member */
    /* Called after reading; false with an error. May be null. */
    bool (*check)(json_reader *r, const json_place *at, void *structure);

    /* Parameters of the codec. */
    double min, max;                   /* limits of numbers */
    size_t size;                       /* count of numbers, or bytes of a label or of a structure in a list */
    json_name *names;                  /* the names of a choice or a set */
    const struct json_member *members; /* the members of an object, or of each object in a list */
    const void *about;                 /* the text of a constant; a noun for a list or label in errors; other data */
    const char *advice; /* for a version: what to do with an older file (null: record it again); for a set: a noun for
                           its elements in errors */
} json_member;

/* The member is written only if a field of the structure is not zero. */
#define JSON_IF(type, field) .nonzero = offsetof(type, field), .nonzero_size = sizeof(((const type *)NULL)->field)

/* A codec that only one row uses. */
#define JSON_CODEC(...)                                                                                                \
    &(const json_codec)                                                                                                \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }

/* Read the members of an object, in the order of the table. An unknown member is an error. */
bool json_read_members(json_reader *r, json_t *object, const json_place *at, const json_member *table, void *into);

/* json_write_members() writes the members of a begun object in the order of the table, json_write_object() a whole
 * object. */
void json_write_members(json_writer *w, const json_member *table, const void *from);
void json_write_object(json_writer *w, const json_member *table, const void *from);

/* Read the elements of a list one by one with `read`. `expected` describes the list in errors. */
bool json_read_elements(json_reader *r, json_t *list, const json_place *at, const char *expected, json_read_value *read,
                        void *into);

/* Returns the kind of an object that has exactly one member named after a kind; -1, with an error, if it has none or
 * two. */
int json_read_kind(json_reader *r, json_t *object, const json_place *at, json_name *kinds);

/* Returns the index of a name, or -1 if it is unknown or null. */
int json_find_name(json_name *names, const char *name);

/* An array in a structure: a pointer member followed by a count member. */
typedef struct json_counted_array {
    const void *items;
    size_t count;
} json_counted_array;
json_counted_array json_get_counted_array(const void *from);

/* True if any byte is not zero. */
bool json_has_nonzero_byte(const void *bytes, size_t size);

/* ---- Values ------------------------------------------------------------------------------------------------- */

/* Write all names, separated by commas and cut to `size`. Returns `text`. */
const char *json_list_names(json_name *names, char *text, size_t size);

/* Read a whole number from min to max. */
bool json_read_whole_number(json_reader *r, const json_t *value, const json_place *at, double min, double max,
                            uint64_t *into);

/* Read element `i` of an array as an id. */
bool json_read_id(json_reader *r, const json_t *list, const json_place *at, size_t i, uint64_t *id);

/* Read `count` numbers of an array, from element `first` on. */
bool json_read_numbers(json_reader *r, const json_t *list, const json_place *at, size_t first, size_t count,
                       double *into);

/* Building blocks for codecs: an index into row->names, double[3], const char *. */
json_read_value json_read_choice, json_read_vector;
json_write_value json_write_text;

extern const json_codec json_uint64, json_size, json_int; /* whole numbers from row->min to row->max; an int is never
                                                             negative */
extern const json_codec json_ints;                        /* array of row->size ints with the same limits */
extern const json_codec json_ids; /* json_counted_array of uint64_t; reading fills the array, or allocates it if it is
                                     null */
extern const json_codec json_number;      /* double; from row->min to row->max if these differ */
extern const json_codec json_nonnegative; /* double of at least 0 */
extern const json_codec json_numbers;     /* row->size doubles */
extern const json_codec json_vector;      /* double[3] */
extern const json_codec json_box;         /* octree_box with min at most max */
extern const json_codec json_constant;    /* exactly the text row->about */
extern const json_codec json_label;       /* char[row->size]: printable ASCII with its final zero */
extern const json_codec
    json_version; /* exactly the format version row->max; row->about names the file in errors: "recording" */
extern const json_codec json_bool;       /* bool */
extern const json_codec json_choice;     /* enumeration: index into row->names */
extern const json_codec json_set;        /* unsigned: bit 1 << index into row->names */
extern const json_codec json_structure;  /* a structure of row->members */
extern const json_codec json_structures; /* json_counted_array of structures of row->size bytes; only written */

#endif
