/* SPDX-License-Identifier: MIT */
/* json_table.h - structures as JSON objects: one table of members, by which an object is both read and written. */
#ifndef BASE_JSON_TABLE_H
#define BASE_JSON_TABLE_H

#include "json_read.h"
#include "json_write.h"

/* Read a value. False with the error written. r->row is its member's row, until another member is read. */
typedef bool json_read_value(json_reader *r, json_t *value, const json_place *at, void *into);

/* Write a value. w->row is its member's row, until another member is written. */
typedef void json_write_value(json_writer *w, const void *from);

typedef struct json_codec {
    json_read_value *read;
    json_write_value *write;          /* null: it is read alone */
    bool (*is_set)(const void *from); /* false: it is left out; null: never */
} json_codec;

/* The n-th name of a choice; null beyond the last. */
typedef const char *json_name(int n);

typedef struct json_member {
    const char *name; /* null ends a table */
    const json_codec *codec;
    size_t offset;    /* of the value in the structure */
    size_t given;     /* of a bool in it: reading sets it, and it is written where it is set; 0: none */
    bool required;    /* when it is read */
    bool nullable;    /* null stands for a value that is not set, instead of leaving the member out */
    bool line;        /* it is written on a line of its own */
    double min, max;  /* of numbers */
    json_name *names; /* of a choice */
    const struct json_member *members; /* of an object */
    const void *about;                 /* the text of a constant, or what else its type needs */
    const char *advice;                /* of a version: what to do with an older file; null: film it again */
} json_member;

/* A type for one row. */
#define JSON_CODEC(...)                                                                                                \
    &(const json_codec)                                                                                                \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }

/* Read the members of an object, in the table's order. A member that the table does not have is an error. */
bool json_read_members(json_reader *r, json_t *object, const json_place *at, const json_member *table, void *into);

/* Write the members into an object that has begun, in the table's order; or the whole object. */
void json_write_members(json_writer *w, const json_member *table, const void *from);
void json_write_object(json_writer *w, const json_member *table, const void *from);

/* Read each element of a list into `into`. `expected` says what the list is. */
bool json_read_elements(json_reader *r, json_t *list, const json_place *at, const char *expected, json_read_value *read,
                        void *into);

/* An object is of one kind among several: one of its members bears the kind's name. Its number; -1, with the error
 * written, where it is none of them or two at once. */
int json_read_kind(json_reader *r, json_t *object, const json_place *at, json_name *kinds);

/* The number of a name, -1 when it is none of them; `name` may be null. */
int json_find_name(json_name *names, const char *name);

/* An array in a structure whose next member is its count. */
typedef struct json_counted {
    const void *items;
    size_t count;
} json_counted;
json_counted json_counted_at(const void *from);

/* ---- Values ------------------------------------------------------------------------------------------------- */

/* The names, with commas between, cut where they do not fit. Returns `text`. */
const char *json_list_names(json_name *names, char *text, size_t size);

/* A whole number that is no member. */
bool json_read_whole(json_reader *r, const json_t *value, const json_place *at, double min, double max, uint64_t *into);

/* The elements first, first + 1, ... of an array, `count` numbers. */
bool json_read_numbers(json_reader *r, const json_t *list, const json_place *at, size_t first, size_t count,
                       double *into);

/* Values that other types are made of: double, double of 0 or more, double[3], octree_box with min not above max. */
json_read_value json_read_number, json_read_positive, json_read_vector, json_read_box;
json_read_value json_read_uint64, json_read_int;
json_write_value json_write_double, json_write_vector, json_write_box, json_write_uint64;

extern const json_codec json_uint64, json_size, json_int; /* whole numbers from row->min to row->max */
extern const json_codec json_number, json_positive;       /* double */
extern const json_codec json_interval;                    /* double from row->min to row->max */
extern const json_codec json_constant;                    /* the text row->about: no other is read */
extern const json_codec json_version;      /* the format version of a file, row->max, and no other; row->about names the
                                              file in errors: "recording" */
extern const json_codec json_bool;         /* left out when false */
extern const json_codec json_choice;       /* an enumeration: the number of one of row->names */
extern const json_codec json_later_choice; /* the same, left out when it is the first */
extern const json_codec json_vector;       /* double[3] */
extern const json_codec json_nonzero_vector; /* the same, left out when all its bits are 0 */
extern const json_codec json_box;            /* octree_box */
extern const json_codec json_structure;      /* a structure of row->members */

#endif
