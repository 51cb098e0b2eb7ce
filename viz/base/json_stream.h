/* SPDX-License-Identifier: MIT */
/* json_stream.h - the objects of a text that is still being written, each of them as soon as it is whole.
 *
 * Nothing is read ahead of what has come: who writes waits where who reads is slower, as pipes have it. Memory is that
 * of the largest object. */
#ifndef BASE_JSON_STREAM_H
#define BASE_JSON_STREAM_H

#include "json_read.h"

#define JSON_DEEPEST 512 /* of lists and objects in each other, beyond which a text is taken for broken */

/* Where one object ends, told character by character. */
typedef struct json_scan {
    unsigned depth;
    bool quoted, escaped, bare; /* within a string; after its backslash; within what is no object */
    char before;                /* the last character that is neither blank nor of a string */
    char open[JSON_DEEPEST];    /* the bracket at each depth */
} json_scan;

typedef struct json_stream {
    int file; /* a descriptor */
    /* Asked between blocks, and now and then while nothing comes: false stops. May be null. */
    bool (*keep_going)(void *context);
    void *context;
    char *bytes; /* of the object at hand, and what has come after it */
    size_t size, room;
    size_t begin, scanned; /* of the object, and what of it is known not to be its end */
    bool ended;            /* nothing more comes */
    unsigned mark;         /* bytes of a byte order mark that were passed over: some editors put it before UTF-8 */
    json_scan scan;
} json_stream;

typedef enum json_stream_state {
    JSON_STREAM_OBJECT,  /* there is one, to be read by json_read_object() */
    JSON_STREAM_END,     /* the text ended after the last */
    JSON_STREAM_STOPPED, /* keep_going() said so */
    JSON_STREAM_BROKEN,  /* r->error: it cannot be read, or ends within an object */
} json_stream_state;

/* Wait for the next object, and let the reader be at it; its line counts on, and its first is 1. What can be the
 * beginning of no object is handed over as far as that shows, for json_read_object() to say what is wrong. */
json_stream_state json_stream_next(json_stream *s, json_reader *r);

/* Free the bytes. The file stays open. */
void json_stream_release(json_stream *s);

#endif
