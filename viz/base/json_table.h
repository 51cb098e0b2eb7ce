/* SPDX-License-Identifier: MIT */
/* json_table.h - reads and writes structures as JSON objects. One table lists the members and serves both directions.
 */
#ifndef BASE_JSON_TABLE_H
#define BASE_JSON_TABLE_H

#include "json_read.h"
#include "json_write.h"

/* Read a value into `into`. False, with an error. r->row is the row of its member. */
typedef bool json_read_value(json_reader *r, json_t *value, const json_place *at, void *into);

/* Write the value of one member. w->row is the table row that describes the member. */
typedef void json_write_value(json_writer *w, const void *from);

typedef struct json_codec {
    json_read_value *read;
    json_write_value *write;          /* null: the member is read but never written */
    bool (*is_set)(const void *from); /* false: the member is left out; null: it is always written */
} json_codec;

/* Returns the n-th name of a list; null: n is beyond the last. */
typedef const char *json_name(int n);

typedef struct json_member {
    const char *name; /* null ends a table */
    const json_codec *codec;
    size_t offset;                     /* of the value in the structure */
    size_t given;                      /* offset of a bool that reading sets and writing asks; 0: none */
    bool required;                     /* reading fails without it */
    bool nullable;                     /* null stands for a value that is not set, instead of leaving the member out */
    bool line;                         /* written on a line of its own */
    double min, max;                   /* limits of numbers */
    json_name *names;                  /* names of a choice */
    const struct json_member *members; /* members of an object */
    const void *about;                 /* the text of a constant, or other data of the codec */
    const char *advice;                /* of a version: what to do with an older file; null: film it again */
} json_member;

/* A codec that only one row uses. */
#define JSON_CODEC(...)                                                                                                \
    &(const json_codec)                                                                                                \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }

/* Read the members of an object, in the order of the table. An unknown member is an error. */
bool json_read_members(json_reader *r, json_t *object, const json_place *at, const json_member *table, void *into);

/* Write the members of a begun object, in the order of the table; or a whole object. */
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

/* An array member of a structure, followed by a member that is its count. */
typedef struct json_counted {
    const void *items;
    size_t count;
} json_counted;
json_counted json_counted_at(const void *from);

/* ---- Values ------------------------------------------------------------------------------------------------- */

/* Write all names, separated by commas and cut to `size`. Returns `text`. */
const char *json_list_names(json_name *names, char *text, size_t size);

/* Read a whole number from min to max. */
bool json_read_whole(json_reader *r, const json_t *value, const json_place *at, double min, double max, uint64_t *into);

/* Read `count` numbers of an array, from element `first` on. */
bool json_read_numbers(json_reader *r, const json_t *list, const json_place *at, size_t first, size_t count,
                       double *into);

/* Building blocks for codecs: double, double of at least 0, double[3], octree_box with min at most max. */
json_read_value json_read_number, json_read_positive, json_read_vector, json_read_box;
json_read_value json_read_uint64, json_read_int;
json_write_value json_write_double, json_write_vector, json_write_box, json_write_uint64;

extern const json_codec json_uint64, json_size, json_int; /* whole numbers from row->min to row->max */
extern const json_codec json_number, json_positive;       /* double */
extern const json_codec json_interval;                    /* double from row->min to row->max */
extern const json_codec json_constant;                    /* the text row->about and no other */
extern const json_codec json_version;                     /* the format version of a file, row->max, and no other;
                                                             row->about names the file in errors: "recording" */
extern const json_codec json_bool;                        /* bool, left out if false */
extern const json_codec json_choice;                      /* enumeration: index into row->names */
extern const json_codec json_later_choice;                /* the same, left out if it is the first */
extern const json_codec json_vector;                      /* double[3] */
extern const json_codec json_nonzero_vector;              /* the same, left out if all its bits are 0 */
extern const json_codec json_box;                         /* octree_box */
extern const json_codec json_structure;                   /* a structure of row->members */

#endif
