/* SPDX-License-Identifier: MIT */
/* json_stream.h - reads JSON objects from a stream while another program writes it. Each object is available as soon
 * as it is complete. Memory: the size of the largest object and one block. */
#ifndef BASE_JSON_STREAM_H
#define BASE_JSON_STREAM_H

#include "json_read.h"

#define JSON_DEEPEST 512 /* the deepest nesting of lists and objects; deeper text is an error */

/* The state of the scan for the end of an object. */
typedef struct json_scan {
    unsigned depth;
    bool quoted, escaped, bare; /* in a string; after a backslash in a string; in text that is not an object */
    char before;                /* the last character that is outside of strings and not whitespace */
    char open[JSON_DEEPEST];    /* the open bracket at each depth */
} json_scan;

typedef struct json_stream {
    int file; /* the file descriptor that is read */
    /* Called between blocks, and every 50 ms while waiting for data. If it returns false, reading stops. May be
     * null. */
    bool (*keep_going)(void *context);
    void *context;
    char *bytes; /* the current object and the text after it; owned */
    size_t size, room;
    size_t begin, scanned; /* the start of the object, and how many of its bytes were scanned */
    bool ended;            /* the end of the stream was reached */
    unsigned mark;         /* how many bytes of a UTF-8 byte order mark at the start were skipped */
    json_scan scan;
} json_stream;

typedef enum json_stream_state {
    JSON_STREAM_OBJECT,  /* a whole object is ready for json_read_object() */
    JSON_STREAM_END,     /* the text ended after the last object */
    JSON_STREAM_STOPPED, /* keep_going() returned false */
    JSON_STREAM_BROKEN,  /* a read failed or the text ends inside an object; r->error says which */
} json_stream_state;

/* Waits for the next object and sets the reader to it. The reader's line must be 1 before the first call. An invalid
 * object is returned like an object that ends at its first invalid character; json_read_object() then reports the
 * error. */
json_stream_state json_stream_read_object(json_stream *s, json_reader *r);

/* Frees the bytes. The file descriptor stays open. */
void json_stream_release(json_stream *s);

#endif
