/* row_reader.h - the rows of a picture in bands, decoded when they are asked for or by a thread that is some bands
 * ahead.
 */
#ifndef DIFF_ROW_READER_H
#define DIFF_ROW_READER_H

#include "image.h"

#include <pthread.h>

/* Bands that a thread is ahead at most. */
enum { ROW_READER_BANDS = 4 };

typedef struct row_reader {
    const char *path;
    image_color background;
    bool whole;
    image_source *source; /* null: not opened yet, or it cannot be */
    octreel_error error;  /* the sentence, where it fails */
    int rows;             /* of a band */
    uint8_t *room;        /* of all bands, where the source has not all rows at hand */
    image bands[ROW_READER_BANDS];
    size_t made, taken; /* bands, ever; those between them were given last or wait to be asked for */
    bool opened, ended; /* well or not */
    bool given;         /* a band was given, and is looked at */

    bool ahead;            /* a thread reads; then all of the above is under the lock, but for the bands not made yet */
    bool stopped, starved; /* what each of the two threads tells the other */
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
} row_reader;

/* Begin; nothing fails yet. `ahead` asks for a thread of its own, `whole` for all rows in one band. The reader stays
 * where it is, and path must outlive it. */
void row_reader_start(row_reader *r, const char *path, image_color background, bool whole, bool ahead);
/* Stop, whatever is read by then. */
void row_reader_stop(row_reader *r);

/* The picture but for its pixels; null where it cannot be read. */
const image *row_reader_about(row_reader *r);

/* The next band, valid until the one after it is asked for. Pictures of one size have bands of one size. False when
 * there are no more, or when it fails. */
bool row_reader_next(row_reader *r, image *band);

/* The sentence, when one of these failed, else null. */
const octreel_error *row_reader_trouble(const row_reader *r);

#endif
