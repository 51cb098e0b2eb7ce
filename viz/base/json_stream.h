/* SPDX-License-Identifier: MIT */
/* json_stream.h - reads JSON objects from a stream while another program writes the stream. Each object is available as
 * soon as it is complete. Memory: the size of the largest object, and one block. */
#ifndef BASE_JSON_STREAM_H
#define BASE_JSON_STREAM_H

#include "json_read.h"

#define JSON_DEEPEST 512 /* the deepest nesting of lists and objects; deeper nesting is an error */

/* The state of the scan that finds the end of an object. */
typedef struct json_scan {
    unsigned depth;
    /* quoted: inside a string; escaped: after a backslash in a string; bare: in text that is not an object */
    bool quoted, escaped, bare;
    char before;             /* the last character that is not whitespace and not inside a string */
    char open[JSON_DEEPEST]; /* the open bracket at each depth */
} json_scan;

typedef struct json_stream {
    int file; /* the file descriptor that is read */
    /* Called between blocks, and every 50 ms while waiting for data. If it returns false, reading stops. The pointer
     * may be null. */
    bool (*keep_going)(void *context);
    void *context;
    char *bytes; /* the current object and the text after it; owned */
    size_t size, room;
    /* begin: index of the object's first byte; scanned: number of the object's bytes that were scanned */
    size_t begin, scanned;
    bool ended;    /* true: the end of the stream was reached */
    unsigned mark; /* number of bytes of a UTF-8 byte order mark that were skipped at the start of the text */
    json_scan scan;
} json_stream;

typedef enum json_stream_state {
    JSON_STREAM_OBJECT,  /* a whole object is ready for json_read_object() */
    JSON_STREAM_END,     /* the text ended after the last object */
    JSON_STREAM_STOPPED, /* keep_going() returned false */
    JSON_STREAM_BROKEN,  /* a read failed, or the text ends inside an object; r->error describes the failure */
} json_stream_state;

/* Waits for the next object and points the reader to it. The reader's line must be 1 before the first call. An invalid
 * object is returned as if it ended at its first invalid character; json_read_object() then reports the error. */
json_stream_state json_stream_read_object(json_stream *s, json_reader *r);

/* Frees the bytes. The file descriptor stays open. */
void json_stream_release(json_stream *s);

#endif
