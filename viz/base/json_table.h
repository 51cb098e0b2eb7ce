/* SPDX-License-Identifier: MIT */
/* json_table.h - reads and writes structures as JSON objects. One table of members serves both reading and writing. */
#ifndef BASE_JSON_TABLE_H
#define BASE_JSON_TABLE_H

#include "json_read.h"
#include "json_write.h"

/* Reads a value into `into`. Returns false with an error if the value is invalid. r->row is the table row of the
 * member. */
typedef bool json_read_value(json_reader *r, json_t *value, const json_place *at, void *into);

/* Writes the value of one member. w->row is the table row of the member. */
typedef void json_write_value(json_writer *w, const void *from);

typedef struct json_codec {
    json_read_value *read;   /* null: the member is written but never read */
    json_write_value *write; /* null: the member is read but never written */
} json_codec;

/* Returns the n-th name of a list; null if n is beyond the last. */
typedef const char *json_name(int n);

/* Defines `names` as a json_name, from a function that returns the name of each value of an enumeration. */
#define JSON_NAMES(names, name_of, enumeration)                                                                        \
    static const char *names(int n)                                                                                    \
    {                                                                                                                  \
        return name_of((enumeration)n);                                                                                \
    }

/* A row of a table. For a plain value, the first three members are enough. */
typedef struct json_member {
    const char *name; /* null: the table ends before this row */
    const json_codec *codec;
    size_t offset; /* the offset of the value in the structure */

    /* The conditions of writing the member; all of them must hold. */
    size_t given;                 /* offset of a bool that must be true; reading sets it to true; 0: no condition */
    size_t nonzero, nonzero_size; /* offset and size of bytes that must not all be 0; see JSON_IF() */
    bool (*is_set)(const void *structure); /* a function that must return true; null: no condition */
    bool nullable;                         /* null is written if a condition fails, and null can be read */
    bool line;                             /* the member is written on a line of its own */

    bool required; /* reading fails if the member is missing */
    /* Called after the member was read. Returns false with an error. May be null. */
    bool (*check)(json_reader *r, const json_place *at, void *structure);

    /* Parameters of the codec. */
    double min, max;                   /* limits of a number */
    size_t size;                       /* the count of numbers; or the bytes of a label, or of a structure in a list */
    json_name *names;                  /* the names of the values of a choice or a set */
    const struct json_member *members; /* the members of an object, or of each object in a list */
    const void *about; /* the text of a constant; the noun for a list or label in errors; other data of a codec */
    /* For a version: what to do with an older file; null: "record it again". For a set: the noun for its elements in
     * errors. */
    const char *advice;
} json_member;

/* A condition: the member is written only if a field of the structure is not zero. */
#define JSON_IF(type, field) .nonzero = offsetof(type, field), .nonzero_size = sizeof(((const type *)NULL)->field)

/* Defines a codec in place, for a codec that only one row uses. */
#define JSON_CODEC(...)                                                                                                \
    &(const json_codec)                                                                                                \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }

/* Reads the members of an object in the order of the table. An unknown member is an error. */
bool json_read_members(json_reader *r, json_t *object, const json_place *at, const json_member *table, void *into);

/* json_write_members() writes the members into an object that was begun, in the order of the table.
 * json_write_object() writes a whole object. */
void json_write_members(json_writer *w, const json_member *table, const void *from);
void json_write_object(json_writer *w, const json_member *table, const void *from);

/* Reads the elements of a list one by one with `read`. `expected` describes the list in errors. */
bool json_read_elements(json_reader *r, json_t *list, const json_place *at, const char *expected, json_read_value *read,
                        void *into);

/* Returns the kind of an object: the index of the name in `kinds` that one of its members has. If no member or two
 * members have such a name, returns -1 with an error. */
int json_read_kind(json_reader *r, json_t *object, const json_place *at, json_name *kinds);

/* Returns the index of a name, or -1 if the name is unknown or null. */
int json_find_name(json_name *names, const char *name);

/* An array in a structure: a pointer member, then a count member. */
typedef struct json_counted_array {
    const void *items;
    size_t count;
} json_counted_array;
json_counted_array json_get_counted_array(const void *from);

/* Returns whether any of the bytes is not zero. */
bool json_has_nonzero_byte(const void *bytes, size_t size);

/* ---- Values ------------------------------------------------------------------------------------------------- */

/* Writes all names, separated by commas, into `text`, cut to `size` bytes. Returns `text`. */
const char *json_list_names(json_name *names, char *text, size_t size);

/* Reads a whole number from `min` to `max`. */
bool json_read_whole_number(json_reader *r, const json_t *value, const json_place *at, double min, double max,
                            uint64_t *into);

/* Reads element `i` of a list as an id. */
bool json_read_id(json_reader *r, const json_t *list, const json_place *at, size_t i, uint64_t *id);

/* Reads `count` numbers from a list, beginning at element `first`. */
bool json_read_numbers(json_reader *r, const json_t *list, const json_place *at, size_t first, size_t count,
                       double *into);

/* Functions from which codecs are built. They read an index into row->names and a double[3], and write a const char
 * *. */
json_read_value json_read_choice, json_read_vector;
json_write_value json_write_text;

/* Whole numbers from row->min to row->max. An int is never negative. */
extern const json_codec json_uint64, json_size, json_int;
extern const json_codec json_ints; /* an array of row->size ints from row->min to row->max */
/* A json_counted_array of uint64_t. Reading fills the array, or allocates it if it is null. */
extern const json_codec json_ids;
extern const json_codec json_number;      /* a double; if row->min and row->max differ, they are its limits */
extern const json_codec json_nonnegative; /* a double that is at least 0 */
extern const json_codec json_numbers;     /* an array of row->size doubles */
extern const json_codec json_vector;      /* a vector: double[3] */
extern const json_codec json_box;         /* an octree_box whose min is at most its max */
extern const json_codec json_constant;    /* the text row->about and no other */
extern const json_codec json_label;       /* char[row->size]: printable ASCII and a final zero */
/* The format version row->max and no other. Errors name the file by row->about: "recording". */
extern const json_codec json_version;
extern const json_codec json_bool;       /* a bool */
extern const json_codec json_choice;     /* an enumeration: an index into row->names */
extern const json_codec json_set;        /* an unsigned with bits 1 << index into row->names */
extern const json_codec json_structure;  /* a structure with the members row->members */
extern const json_codec json_structures; /* a json_counted_array of structures of row->size bytes; only written */

#endif
