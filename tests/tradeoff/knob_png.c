/* SPDX-License-Identifier: MIT */
/* knob_png.c - how a frame is compressed: time for bytes, and nothing of the picture. */
#include <math.h>
#include <png.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "frames.h"
#include "knob.h"
#include "picture.h"
#include "timing.h"
#include "measuring.h"
#include "program.h"
#include "recording_file.h"

static const column columns[] = {
    {"setting", "zlib's level", NULL},
    {"unlike", "pixels that differ after decoding", "0"},
    {"bytes", "of the file", NULL},
    {"ms", "processor milliseconds of the encoder", NULL},
};

static const chart charts[] = {
    {.title = "Size against time", .x = "ms", .y = "bytes", .x_log = true, .y_log = true},
};

static const gain gains[] = {
    {"indexed level 1 instead of level 9",
     {.variant = "indexed", .setting = 9},
     {.variant = "indexed-rle", .setting = 1},
     "ms"},
};

/* One way to write a frame. */
typedef struct encoding {
    const char *name;
    bool indexed, adaptive;
    int strategy;
} encoding;

static const encoding encodings[] = {
    {"indexed-rle", true, false, Z_RLE},
    {"indexed", true, false, Z_DEFAULT_STRATEGY},
    {"rgb", false, false, Z_DEFAULT_STRATEGY},
    {"rgb-adaptive", false, true, Z_FILTERED},
};
static const int levels[] = {0, 1, 2, 3, 6, 9};
enum { ENCODINGS = sizeof encodings / sizeof encodings[0], LEVELS = sizeof levels / sizeof levels[0] };

typedef struct bytes {
    unsigned char *at;
    size_t size, room;
} bytes;

typedef struct writing {
    const encoding *how;
    int level;
    const image *frame; /* of one channel or of three, as `how` says */
    bytes file;
} writing;

/* ---- Encoding and decoding ---------------------------------------------------------------------------------- */

static void take_bytes(png_structp png, png_bytep from, size_t size)
{
    bytes *b = png_get_io_ptr(png);
    if (b->size + size > b->room) {
        b->room = 2 * (b->size + size);
        b->at = resize_memory(b->at, b->room);
    }
    memcpy(b->at + b->size, from, size);
    b->size += size;
}

static void complain(png_structp png, png_const_charp sentence)
{
    (void)png;
    stop_with_error("libpng: %s", sentence);
}

static void set_palette(png_structp png, png_infop info, const image_palette *palette)
{
    png_color colors[256];
    for (int i = 0; i < palette->count; i++)
        colors[i] = (png_color){palette->colors[i].r, palette->colors[i].g, palette->colors[i].b};
    png_set_PLTE(png, info, colors, palette->count);
}

static void encode(void *contestant)
{
    writing *w = contestant;
    const image *frame = w->frame;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, complain, complain);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info)
        stop_with_error("libpng does not start");
    w->file.size = 0;
    png_set_write_fn(png, &w->file, take_bytes, NULL);
    png_set_IHDR(png, info, (png_uint_32)frame->width, (png_uint_32)frame->height, 8,
                 w->how->indexed ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    if (w->how->indexed)
        set_palette(png, info, &frame->palette);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, w->how->adaptive ? PNG_ALL_FILTERS : PNG_FILTER_NONE);
    png_set_compression_level(png, w->level);
    png_set_compression_strategy(png, w->how->strategy);
    png_set_compression_buffer_size(png, 1 << 16);
    png_write_info(png, info);
    for (int y = 0; y < frame->height; y++)
        png_write_row(png, frame->pixels + (size_t)y * (size_t)frame->width * (size_t)frame->channels);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
}

/* Pixels that are not as they were drawn, by libpng's own simple reader. */
static size_t count_unlike(const bytes *file, const image *frame)
{
    png_image read = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_memory(&read, file->at, file->size))
        stop_with_error("libpng: %s", read.message);
    read.format = PNG_FORMAT_RGB;
    unsigned char *pixels = resize_memory(NULL, PNG_IMAGE_SIZE(read));
    if ((int)read.width != frame->width || (int)read.height != frame->height ||
        !png_image_finish_read(&read, NULL, pixels, 0, NULL))
        stop_with_error("libpng: %s", read.message);
    size_t unlike = 0;
    for (int y = 0; y < frame->height; y++)
        for (int x = 0; x < frame->width; x++) {
            const unsigned char *p = pixels + 3 * ((size_t)y * (size_t)frame->width + (size_t)x);
            const image_color c = image_color_at(frame, x, y);
            unlike += p[0] != c.r || p[1] != c.g || p[2] != c.b;
        }
    free(pixels);
    return unlike;
}

/* ---- Measuring ---------------------------------------------------------------------------------------------- */

static bytes read_whole(const char *path)
{
    bytes b = {.room = (size_t)1 << 24}; /* no frame here is as large */
    FILE *file = fopen(path, "rb");
    if (!file)
        stop_with_error("cannot read %s", path);
    b.at = resize_memory(NULL, b.room);
    b.size = fread(b.at, 1, b.room, file);
    fclose(file);
    return b;
}

/* The recorder's own file: its default is one of the rows, and must be as small. */
static void add_recorder(const run *r, table *t, const char *name, const image *frame)
{
    char path[4200];
    octreel_error why;
    snprintf(path, sizeof path, "%s/png-recorder.png", r->folder);
    const double start = processor_time();
    if (!image_write_png(frame, path, NULL, 0, &why))
        stop_with_error("%s", why.text);
    const double ms = (processor_time() - start) / 1e6;
    bytes file = read_whole(path);
    table_add(t, name, "recorder", (double[]){1, (double)count_unlike(&file, frame), (double)file.size, ms});
    free(file.at);
    unlink(path);
}

static void measure_frame(const run *r, table *t, const char *name, const image *indexed, const image *rgb)
{
    writing ways[ENCODINGS * LEVELS] = {{0}};
    double ns[ENCODINGS * LEVELS];
    for (size_t i = 0; i < ENCODINGS * LEVELS; i++) {
        ways[i].how = &encodings[i / LEVELS];
        ways[i].level = levels[i % LEVELS];
        ways[i].frame = ways[i].how->indexed ? indexed : rgb;
    }
    time_in_turn(encode, ways, sizeof ways[0], ENCODINGS * LEVELS, r->rounds, ns);
    for (size_t i = 0; i < ENCODINGS * LEVELS; i++) {
        const double unlike = (double)count_unlike(&ways[i].file, ways[i].frame);
        table_add(t, name, ways[i].how->name,
                  (double[]){ways[i].level, unlike, (double)ways[i].file.size, ns[i] / 1e6});
        free(ways[i].file.at);
    }
    add_recorder(r, t, name, indexed);
}

static image in_colors(const image *indexed)
{
    image rgb;
    if (!image_create(&rgb, indexed->width, indexed->height, 3) || !image_shrink(indexed, NULL, 1, &rgb))
        stop_with_error("there is no memory for a picture");
    return rgb;
}

static void measure(const run *r, table *t)
{
    static const frame_kind kinds[] = {{"session", 0}, {"clusters-2000", 2000}, {"clusters-50000", 50000}};
    for (size_t i = 0; i < (r->quick ? 1 : sizeof kinds / sizeof kinds[0]); i++) {
        const view v = view_make_default();
        subject *s = subject_make(&kinds[i]);
        scene shown = {0};
        picture p;
        octreel_error why;
        subject_show(s, &v, &shown);
        if (!picture_open(&p, &v, &(renderer_choice){0}, &why) || !picture_draw(&p, &shown, &why))
            stop_with_error("%s", why.text);
        image rgb = in_colors(&p.frame);
        measure_frame(r, t, kinds[i].name, &p.frame, &rgb);
        image_release(&rgb);
        picture_close(&p);
        scene_release(&shown);
        subject_free(s);
    }
}

static void tell(const table *t, FILE *out)
{
    const pick preset = {.variant = "indexed-rle", .setting = 1}, rgb = {.variant = "rgb-adaptive", .setting = 6};
    const pick small = {.variant = "indexed", .setting = 9}, plain = {.variant = "rgb", .setting = 1};
    fprintf(
        out,
        "Indexed colours, level 1, runs alone are the default: libpng's own defaults on RGB take %.1f x the time and "
        "%.2f x the bytes, RGB at level 1 %.1f x and %.2f x, indexed at level 9 %.1f x and %.2f x; %.0f pixels "
        "differ after decoding, proven 0.",
        table_ratio(t, rgb, preset, "ms"), table_ratio(t, rgb, preset, "bytes"), table_ratio(t, plain, preset, "ms"),
        table_ratio(t, plain, preset, "bytes"), table_ratio(t, small, preset, "ms"),
        table_ratio(t, small, preset, "bytes"), table_sum(t, (pick){.setting = NAN}, "unlike"));
}

/* How many other settings are no larger and, but for a twentieth, no slower in every scene, and smaller in most. */
static size_t count_better(const table *t, pick preset)
{
    size_t better = 0;
    for (size_t i = 0; i < t->count; i++) {
        const row *r = &t->rows[i];
        const pick other = {.variant = r->variant, .setting = r->values[0]};
        better += strcmp(r->scene, t->rows[0].scene) == 0 && table_ratios(t, other, preset, "ms").most <= 1.05 &&
                  table_ratios(t, other, preset, "bytes").most <= 1 && table_ratio(t, other, preset, "bytes") < 1;
    }
    return better;
}

static void defend(const table *t, FILE *out)
{
    const size_t better = count_better(t, (pick){.variant = "indexed-rle", .setting = 1});
    fprintf(out, "They are %s: %zu other settings are no larger and no slower in every scene, and smaller in most.",
            better ? "not the best" : "kept", better);
}

const knob knob_png = {
    .name = "png",
    .title = "PNG: level, and indexed colours or RGB",
    .trades = "Time of the encoder for bytes of a 1280 x 720 frame.",
    .preset = "8-bit indexed, filter none, level 1, Z_RLE; RGB under anti-aliasing",
    .proven = "PNG is lossless: no pixel differs.",
    .truth = "The pixels before encoding, and those that libpng's simplified reader decodes.",
    .columns = columns,
    .column_count = sizeof columns / sizeof columns[0],
    .charts = charts,
    .chart_count = sizeof charts / sizeof charts[0],
    .gains = gains,
    .gain_count = sizeof gains / sizeof gains[0],
    .measure = measure,
    .tell = tell,
    .defend = defend,
};
