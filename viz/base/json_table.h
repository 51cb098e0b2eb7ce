/* SPDX-License-Identifier: MIT */
/* json_table.h - reads and writes structures as JSON objects. One table of members serves both reading and writing. */
#ifndef BASE_JSON_TABLE_H
#define BASE_JSON_TABLE_H

#include "json_read.h"
#include "json_write.h"

/* Reads a value into `into`. Returns false with an error if the value is invalid. r->row is the table row of the member
 * whose value is read. */
typedef bool json_read_value(json_reader *r, json_t *value, const json_place *at, void *into);

/* Writes the value of one member. w->row is the table row of this member. */
typedef void json_write_value(json_writer *w, const void *from);

typedef struct json_codec {
    json_read_value *read;   /* null: the member is written but never read */
    json_write_value *write; /* null: the member is read but never written */
} json_codec;

/* Returns the n-th name of a list. Returns null if n is beyond the last name. */
typedef const char *json_name(int n);

/* Defines a json_name function with the name `names`. Its results are the names that `name_of` returns for the values
 * of an enumeration. */
#define JSON_NAMES(names, name_of, enumeration)                                                                        \
    static const char *names(int n)                                                                                    \
    {                                                                                                                  \
        return name_of((enumeration)n);                                                                                \
    }

/* A row of a table describes a member of an object. For a plain value, the first three members of the row are
 * enough. */
typedef struct json_member {
    const char *name; /* null: the table ends before this row */
    const json_codec *codec;
    size_t offset; /* the offset of the value in the structure */

    /* Conditions for writing the member of the object. All of them must hold. */
    /* offset in the structure of a bool that must be true; reading the member sets the bool to true; 0: no condition */
    size_t given;
    size_t nonzero, nonzero_size; /* offset and size of bytes in the structure that must not all be 0; see JSON_IF() */
    bool (*is_set)(const void *structure); /* a function that must return true; null: no condition */
    /* true: if a condition fails, the member is written as null, not left out; reading accepts null, too */
    bool nullable;
    bool line; /* true: the member is written on a line of its own */

    bool required; /* true: reading fails if the member is missing */
    /* Called after the member was read. Returns false with an error if the value is invalid. May be null. */
    bool (*check)(json_reader *r, const json_place *at, void *structure);

    /* Parameters of the codec. */
    double min, max; /* limits of a number */
    /* for an array of numbers: their count; for a label: its bytes; for a list of structures: the bytes of a
     * structure */
    size_t size;
    json_name *names;                  /* for a choice or a set: the names of its values */
    const struct json_member *members; /* for an object, or for each object in a list: its members */
    /* for a constant: its text; for a list or label: the noun for it in errors; for other codecs: other data */
    const void *about;
    /* For a version: what the user should do with an older file; null means "record it again". For a set: the noun for
     * its elements in errors. */
    const char *advice;
} json_member;

/* A condition in a row: the member is written only if a field of the structure is not zero. */
#define JSON_IF(type, field) .nonzero = offsetof(type, field), .nonzero_size = sizeof(((const type *)NULL)->field)

/* Defines a codec inside a row, for a codec that no other row uses. */
#define JSON_CODEC(...)                                                                                                \
    &(const json_codec)                                                                                                \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }

/* Reads the members of an object in the order of the table. An unknown member is an error. */
bool json_read_members(json_reader *r, json_t *object, const json_place *at, const json_member *table, void *into);

/* json_write_members() writes the members into an object that the caller has begun, in the order of the table.
 * json_write_object() writes a whole object. */
void json_write_members(json_writer *w, const json_member *table, const void *from);
void json_write_object(json_writer *w, const json_member *table, const void *from);

/* Reads the elements of a list with `read`, one by one. `expected` describes the list in error messages. */
bool json_read_elements(json_reader *r, json_t *list, const json_place *at, const char *expected, json_read_value *read,
                        void *into);

/* Returns the kind of an object, an index into `kinds`. An object of a kind has a member with the name of this kind,
 * and no member with the name of another kind; otherwise the function returns -1 with an error. */
int json_read_kind(json_reader *r, json_t *object, const json_place *at, json_name *kinds);

/* Returns the index of a name in `names`. Returns -1 if the name is unknown or null. */
int json_find_name(json_name *names, const char *name);

/* An array in a structure: a pointer member, directly followed by a count member. json_get_counted_array() returns the
 * array whose two members begin at `from`. */
typedef struct json_counted_array {
    const void *items;
    size_t count;
} json_counted_array;
json_counted_array json_get_counted_array(const void *from);

/* Returns whether at least one of the bytes is not zero. */
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

/* Functions from which codecs are built. json_read_choice() reads an index into row->names, json_read_vector() a
 * double[3]; json_write_text() writes a const char *. */
json_read_value json_read_choice, json_read_vector;
json_write_value json_write_text;

/* Codecs of whole numbers from row->min to row->max. An int is never negative. */
extern const json_codec json_uint64, json_size, json_int;
extern const json_codec json_ints; /* a codec of an array of row->size ints from row->min to row->max */
/* A codec of a json_counted_array of uint64_t. Reading fills the array, or allocates it if it is null. */
extern const json_codec json_ids;
/* a codec of a double from row->min to row->max, or of any double if row->min equals row->max */
extern const json_codec json_number;
extern const json_codec json_nonnegative; /* a codec of a double that is at least 0 */
extern const json_codec json_numbers;     /* a codec of an array of row->size doubles */
extern const json_codec json_vector;      /* a codec of a vector: double[3] */
extern const json_codec json_box;         /* a codec of an octree_box whose min is at most its max */
extern const json_codec json_constant;    /* a codec that accepts and writes only the text row->about */
extern const json_codec json_label;       /* a codec of a char[row->size] with printable ASCII and a final zero */
/* A codec of a format version, which must be row->max. Errors name the kind of file by row->about, such as
 * "recording". */
extern const json_codec json_version;
extern const json_codec json_bool;   /* a codec of a bool */
extern const json_codec json_choice; /* a codec of an enumeration: an index into row->names */
/* a codec of an unsigned with bits 1 << i, where i is an index into row->names */
extern const json_codec json_set;
extern const json_codec json_structure; /* a codec of a structure whose members are row->members */
/* a codec of a json_counted_array of structures of row->size bytes; it can only write */
extern const json_codec json_structures;

#endif
