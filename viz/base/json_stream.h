/* SPDX-License-Identifier: MIT */
/* json_stream.h - reads JSON objects from a stream while another program writes it. Each object is available as soon as
 * it is complete. Memory is that of the largest object and one block. */
#ifndef BASE_JSON_STREAM_H
#define BASE_JSON_STREAM_H

#include "json_read.h"

#define JSON_DEEPEST 512 /* nesting of lists and objects; a deeper text counts as broken */

/* The state of the search for the end of an object. */
typedef struct json_scan {
    unsigned depth;
    bool quoted, escaped, bare; /* inside a string; after a backslash in a string; inside text that is not an object */
    char before;                /* the last character outside of strings that is not whitespace */
    char open[JSON_DEEPEST];    /* the bracket at each depth */
} json_scan;

typedef struct json_stream {
    int file; /* file descriptor to read */
    /* Called between blocks and every 50 ms while waiting; false stops the reading. May be null. */
    bool (*keep_going)(void *context);
    void *context;
    char *bytes; /* the current object and the text after it */
    size_t size, room;
    size_t begin, scanned; /* start of the object, and its number of scanned bytes */
    bool ended;            /* the end of the stream was reached */
    unsigned mark;         /* skipped bytes of a UTF-8 byte order mark at the start */
    json_scan scan;
} json_stream;

typedef enum json_stream_state {
    JSON_STREAM_OBJECT,  /* a whole object is ready for json_read_object() */
    JSON_STREAM_END,     /* the text ended after the last object */
    JSON_STREAM_STOPPED, /* keep_going() returned false */
    JSON_STREAM_BROKEN,  /* r->error: a read failed, or the text ends inside an object */
} json_stream_state;

/* Wait for the next object and point the reader at it. The reader's line must start as 1. Broken text is returned like
 * an object, up to its first invalid character; json_read_object() then reports the error. */
json_stream_state json_stream_read_object(json_stream *s, json_reader *r);

/* Free the bytes. The file stays open. */
void json_stream_release(json_stream *s);

#endif
