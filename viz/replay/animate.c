/* SPDX-License-Identifier: MIT */
/* animate.c - reads the frames of a film one after the other, and passes them to a writer.
 *
 * A run is a frame together with the equal frames that follow it. In an animated PNG the number of frames and the
 * palette precede the first frame. So a first pass counts the runs and collects their colours, and a second pass writes
 * the runs. */
#include "animate.h"
#include "apng_write.h"
#include "color_table.h"
#include "ffmpeg.h"
#include "file.h"
#include "png_read.h"

#include <stdlib.h>

/* A function that is called for each run, with the run's RGB pixels and the number `shown` of the run's frames. Returns
 * false and sets *error to end the pass. */
typedef bool run_visitor(const uint8_t *rgb, unsigned shown, void *context, octreel_error *error);

typedef struct reel {
    const animation_frames *list;
    animation_options options; /* the options; width and height are always set, to the size of the film */
    size_t pixels;             /* number of pixels of a frame of the film */
    uint8_t *now, *next;       /* the RGB pixels of the current run, and of the frame that was read last */
    uint64_t read, to_read;    /* number of frames read so far, and to be read by all passes together */
    bool stopped;
} reel;

static void copy_row_as_rgb(const image *from, int left, int y, int count, uint8_t *rgb)
{
    const uint8_t *pixels = from->pixels + ((size_t)y * (size_t)from->width + (size_t)left) * image_pixel_size(from);
    if (from->channels == 3 && !from->wide) {
        memcpy(rgb, pixels, 3 * (size_t)count);
        return;
    }
    for (int x = 0; x < count; x++) {
        const image_color color = from->wide ? image_color_at(from, left + x, y) : from->palette.colors[pixels[x]];
        memcpy(rgb + 3 * x, &color, 3);
    }
}

static bool read_frame(reel *r, size_t index, uint8_t *rgb, octreel_error *error)
{
    image whole;
    const animation_options *o = &r->options;
    const char *path = r->list->frames[index].path;
    if (!image_read_png(path, &whole, error))
        return false;
    const bool same = whole.width == r->list->width && whole.height == r->list->height;
    for (int y = 0; same && y < o->height; y++)
        copy_row_as_rgb(&whole, o->left, o->top + y, o->width, rgb + 3 * (size_t)y * (size_t)o->width);
    image_release(&whole);
    watcher_report(&o->watch, ++r->read, r->to_read);
    r->stopped = !watcher_continues(&o->watch);
    return same || error_set(error, "%s: has changed while the film was made", path);
}

/* Call `visit` for each run. Returns true also if the watcher stopped the film before the last run. */
static bool visit_runs(reel *r, run_visitor *visit, void *context, octreel_error *error)
{
    unsigned shown = 1;
    bool ok = read_frame(r, 0, r->now, error);
    for (size_t i = 1; ok && !r->stopped && i < r->list->count; i++) {
        ok = read_frame(r, i, r->next, error);
        if (ok && shown < APNG_LONGEST && memcmp(r->now, r->next, 3 * r->pixels) == 0) {
            shown++;
            continue;
        }
        ok = ok && visit(r->now, shown, context, error);
        uint8_t *const swap = r->now;
        r->now = r->next;
        r->next = swap;
        shown = 1;
    }
    return ok && (r->stopped || visit(r->now, shown, context, error));
}

/* ---- Animated PNGs ------------------------------------------------------------------------------------------- */

typedef struct apng_passes {
    color_table colors;
    size_t pixels, runs;
    uint8_t *indices; /* room for the palette indices of a frame */
    apng_writer *writer;
} apng_passes;

static bool count_run_and_colors(const uint8_t *rgb, unsigned shown, void *context, octreel_error *error)
{
    apng_passes *p = context;
    (void)shown, (void)error;
    color_table_add(&p->colors, rgb, p->pixels);
    p->runs++;
    return true;
}

static bool write_run(const uint8_t *rgb, unsigned shown, void *context, octreel_error *error)
{
    apng_passes *p = context;
    if (!p->colors.is_full)
        color_table_find(&p->colors, rgb, p->pixels, p->indices);
    return apng_writer_add(p->writer, p->colors.is_full ? rgb : p->indices, (uint16_t)shown, error);
}

static bool write_apng(reel *r, apng_passes *p, const char *path, octreel_error *error)
{
    const apng_description about = {r->options.width, r->options.height, p->colors.is_full ? NULL : &p->colors.palette,
                                    (uint32_t)p->runs, r->options.rate};
    p->indices = malloc(r->pixels);
    if (!p->indices)
        return error_no_memory(error);
    p->writer = apng_writer_open(path, &about, error);
    if (!p->writer)
        return false;
    if (visit_runs(r, write_run, p, error))
        return r->stopped ? !apng_writer_discard(p->writer) : apng_writer_close(p->writer, error);
    return apng_writer_discard(p->writer);
}

static bool animate_png(reel *r, const char *path, animation_summary *summary, octreel_error *error)
{
    apng_passes *p = calloc(1, sizeof *p);
    if (!p)
        return error_no_memory(error);
    p->pixels = r->pixels;
    r->to_read = 2 * r->list->count;
    const bool ok = visit_runs(r, count_run_and_colors, p, error) && (r->stopped || write_apng(r, p, path, error));
    summary->stored = p->runs;
    summary->colors = p->colors.is_full ? 0 : p->colors.palette.count;
    free(p->indices);
    free(p);
    return ok;
}

/* ---- Videos -------------------------------------------------------------------------------------------------- */

typedef struct video_pass {
    ffmpeg *writer;
    size_t size, runs;
} video_pass;

static bool send_run_to_ffmpeg(const uint8_t *rgb, unsigned shown, void *context, octreel_error *error)
{
    video_pass *p = context;
    p->runs++;
    for (unsigned i = 0; i < shown; i++)
        if (!ffmpeg_add(p->writer, rgb, p->size, error))
            return false;
    return true;
}

static bool animate_video(reel *r, const char *path, animation_summary *summary, octreel_error *error)
{
    video_pass p = {.size = 3 * r->pixels};
    r->to_read = r->list->count;
    p.writer = ffmpeg_open(path, r->options.width, r->options.height, r->options.rate, error);
    if (!p.writer)
        return false;
    const bool ok = visit_runs(r, send_run_to_ffmpeg, &p, error);
    summary->stored = p.runs;
    return ok && !r->stopped ? ffmpeg_close(p.writer, error) : (ffmpeg_discard(p.writer), ok);
}

/* ---- The film ------------------------------------------------------------------------------------------------ */

static bool check_crop(const animation_frames *list, animation_options *o, octreel_error *error)
{
    if (o->width == 0) {
        o->width = list->width;
        o->height = list->height;
    }
    return (o->left <= list->width - o->width && o->top <= list->height - o->height) ||
           error_set(error, "--crop %d,%d,%d,%d reaches beyond the frames, which have %d x %d pixels", o->left, o->top,
                     o->width, o->height, list->width, list->height);
}

bool animation_is_video(const char *path)
{
    return ffmpeg_find_format(path) != NULL;
}

bool animate(const animation_frames *list, const animation_options *options, const char *path,
             animation_summary *summary, octreel_error *error)
{
    reel r = {.list = list, .options = *options};
    *summary = (animation_summary){0};
    if (!check_crop(list, &r.options, error))
        return false;
    summary->width = r.options.width;
    summary->height = r.options.height;
    r.pixels = (size_t)r.options.width * (size_t)r.options.height;
    r.now = malloc(3 * r.pixels);
    r.next = malloc(3 * r.pixels);
    const bool ok = r.now && r.next ? (animation_is_video(path) ? animate_video : animate_png)(&r, path, summary, error)
                                    : error_no_memory(error);
    summary->frames = ok && !r.stopped ? list->count : 0;
    free(r.now);
    free(r.next);
    return ok;
}
