/* row_reader.c - see row_reader.h. */
#include "row_reader.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static void lock(row_reader *r)
{
    if (r->ahead)
        pthread_mutex_lock(&r->lock);
}

static void unlock(row_reader *r)
{
    if (r->ahead)
        pthread_mutex_unlock(&r->lock);
}

/* ---- Reading ------------------------------------------------------------------------------------------------- */

/* Room for the bands that are there at a time: without a thread, one. */
static bool make_room(row_reader *r)
{
    const size_t size = image_source_room(r->source, r->rows) * (r->ahead ? ROW_READER_BANDS : 1);
    if (size == 0)
        return true;
    r->room = malloc(size);
    if (!r->room)
        snprintf(r->error.text, sizeof r->error.text, "%.400s: %s", r->path, strerror(ENOMEM));
    return r->room != NULL;
}

static void open_source(row_reader *r)
{
    image_source *source = image_source_open(r->path, r->background, r->whole, &r->error);
    lock(r);
    r->source = source;
    if (source)
        r->rows = r->whole ? image_source_about(source)->height : image_band_rows(image_source_about(source));
    r->ended = !source || !make_room(r);
    r->opened = true;
    if (r->ahead)
        pthread_cond_signal(&r->changed);
    unlock(r);
}

static size_t place_of(const row_reader *r, size_t band)
{
    return r->ahead ? band % ROW_READER_BANDS : 0;
}

/* Read a band, where there is room for one. */
static void read_band(row_reader *r)
{
    const size_t place = place_of(r, r->made);
    uint8_t *room = r->room ? r->room + place * image_source_room(r->source, r->rows) : NULL;
    const bool more = image_source_next(r->source, r->rows, room, &r->bands[place]);
    lock(r);
    r->made += more;
    r->ended = !more;
    if (r->ahead && r->starved)
        pthread_cond_signal(&r->changed);
    unlock(r);
}

/* ---- The thread that is ahead -------------------------------------------------------------------------------- */

/* Once there is no room it waits until half of it is free, so that it is woken less often. */
static bool wait_for_room(row_reader *r)
{
    lock(r);
    if (r->made - r->taken == ROW_READER_BANDS)
        while (!r->stopped && r->made - r->taken > ROW_READER_BANDS / 2)
            pthread_cond_wait(&r->changed, &r->lock);
    const bool go_on = !r->stopped && !r->ended;
    unlock(r);
    return go_on;
}

static void *read_ahead(void *reader)
{
    row_reader *r = reader;
    open_source(r);
    while (wait_for_room(r))
        read_band(r);
    return NULL;
}

/* ---- Who asks for rows --------------------------------------------------------------------------------------- */

static void destroy_lock(row_reader *r)
{
    pthread_cond_destroy(&r->changed);
    pthread_mutex_destroy(&r->lock);
}

void row_reader_start(row_reader *r, const char *path, image_color background, bool whole, bool ahead)
{
    *r = (row_reader){.path = path, .background = background, .whole = whole, .ahead = ahead};
    if (!ahead)
        return;
    pthread_mutex_init(&r->lock, NULL);
    pthread_cond_init(&r->changed, NULL);
    if (pthread_create(&r->thread, NULL, read_ahead, r) == 0)
        return;
    r->ahead = false; /* then each band is read when it is asked for */
    destroy_lock(r);
}

void row_reader_stop(row_reader *r)
{
    if (r->ahead) {
        lock(r);
        r->stopped = true;
        pthread_cond_signal(&r->changed);
        unlock(r);
        pthread_join(r->thread, NULL);
        destroy_lock(r);
    }
    image_source_close(r->source);
    free(r->room);
}

const image *row_reader_about(row_reader *r)
{
    if (!r->ahead && !r->opened)
        open_source(r);
    lock(r);
    while (!r->opened)
        pthread_cond_wait(&r->changed, &r->lock);
    unlock(r);
    return r->source ? image_source_about(r->source) : NULL;
}

/* Under the lock: the band that was given last has been looked at. */
static void take_back(row_reader *r)
{
    if (!r->given)
        return;
    r->given = false;
    r->taken++;
    if (r->ahead && r->made - r->taken == ROW_READER_BANDS / 2)
        pthread_cond_signal(&r->changed);
}

static void get_band(row_reader *r)
{
    if (!r->ahead) {
        read_band(r);
        return;
    }
    r->starved = true;
    pthread_cond_wait(&r->changed, &r->lock);
    r->starved = false;
}

bool row_reader_next(row_reader *r, image *band)
{
    if (!row_reader_about(r))
        return false;
    lock(r);
    take_back(r);
    while (r->made == r->taken && !r->ended)
        get_band(r);
    r->given = r->made > r->taken;
    if (r->given)
        *band = r->bands[place_of(r, r->taken)];
    unlock(r);
    return r->given;
}

const octreel_error *row_reader_trouble(const row_reader *r)
{
    return r->error.text[0] ? &r->error : NULL;
}
