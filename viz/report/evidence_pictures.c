/* evidence_pictures.c - see evidence_pictures.h. */
#include "evidence_pictures.h"
#include "file.h"
#include "octree/digest.h"
#include "parallel.h"
#include "read_pair.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* ---- Names --------------------------------------------------------------------------------------------------- */

const char *evidence_word(evidence_picture picture)
{
    static const char *const words[] = {
#define EVIDENCE_WORD(name, word) word,
        EVIDENCE_PICTURE_MAP(EVIDENCE_WORD)
#undef EVIDENCE_WORD
    };
    return words[picture];
}

/* Where the suffix begins: the end of a name that has none. */
static size_t stem_length(const char *name)
{
    const size_t length = strlen(name);
    return length > 4 && strcasecmp(name + length - 4, ".png") == 0 ? length - 4 : length;
}

/* What is put behind a stem at most, also while it is written. */
#define LONGEST_ENDING "~0123456789abcdef.difference.png.part"

/* How much of a stem fits into the name of a file, whole letters of UTF-8. */
static size_t fitting_length(const char *stem)
{
    size_t length = NAME_MAX - (sizeof LONGEST_ENDING - 1);
    while (length > 0 && ((unsigned char)stem[length] & 0xc0) == 0x80)
        length--;
    return length;
}

/* The word goes before the suffix, which stays as it is: names that were unlike stay so. A name that would be too long
 * has a digest of itself in place of its end. */
char *evidence_name(const char *frame, evidence_picture picture)
{
    const size_t stem = stem_length(frame), size = strlen(frame) + sizeof LONGEST_ENDING;
    const bool fits = stem + sizeof ".difference.png.part" - 1 <= NAME_MAX;
    char digest[24] = "", *name = malloc(size);
    if (!fits)
        snprintf(digest, sizeof digest, "~%016" PRIx64, octree_digest_bytes(OCTREE_DIGEST_START, frame, strlen(frame)));
    if (name)
        snprintf(name, size, "%.*s%s.%s%s", (int)(fits ? stem : fitting_length(frame)), frame, digest,
                 evidence_word(picture), frame[stem] ? frame + stem : ".png");
    return name;
}

bool evidence_is_name(const char *name)
{
    static const char part[] = ".part";
    size_t length = strlen(name);
    if (length > sizeof part - 1 && strcmp(name + length - (sizeof part - 1), part) == 0)
        length -= sizeof part - 1;
    for (int i = 0; i < EVIDENCE_PICTURES; i++) {
        char end[32];
        const size_t size = (size_t)snprintf(end, sizeof end, ".%s.png", evidence_word((evidence_picture)i));
        if (length > size && strncasecmp(name + length - size, end, size) == 0)
            return true;
    }
    return false;
}

static char *picture_path(const char *folder, const diff_pair *pair, evidence_picture picture)
{
    char *name = evidence_name(diff_pair_name(pair), picture), *path = name ? path_join(folder, name) : NULL;
    free(name);
    return path;
}

/* ---- The files of both sides --------------------------------------------------------------------------------- */

/* What is no regular file is no picture: that is said as the pair's trouble. */
static bool has_file(const diff_frame *frame)
{
    struct stat status;
    return frame && frame->path && stat(frame->path, &status) == 0 && S_ISREG(status.st_mode);
}

static bool copy_frame(const diff_frame *frame, const diff_pair *pair, evidence_picture picture, const char *folder,
                       unsigned *written, octreel_error *error)
{
    if (!has_file(frame))
        return true;
    char *path = picture_path(folder, pair, picture);
    const bool ok = path ? file_copy_to(frame->path, path, error) : error_no_memory(error);
    free(path);
    *written |= ok ? 1u << picture : 0;
    return ok;
}

/* ---- The difference, and all three side by side -------------------------------------------------------------- */

enum { GAP = 12 }; /* pixels between pictures that lie side by side */

static const image_color GAP_COLOR = {38, 42, 50};

/* Both images, and what rows of the pictures are made of. */
typedef struct canvas {
    image images[2];
    int width, height; /* of the larger of both, each way */
    image_palette palette;
    image_tolerance tolerance;
} canvas;

static bool read_images(canvas *c, const diff_pair *pair, image_color background, octreel_error *error)
{
    octreel_error why;
    if (!read_pair(pair, background, c->images, &why))
        return error_set(error, "%s", why.text);
    const image *a = &c->images[0], *b = &c->images[1];
    c->width = a->width > b->width ? a->width : b->width;
    c->height = a->height > b->height ? a->height : b->height;
    return true;
}

/* A picture of the canvas while it is written. */
typedef struct drawing {
    const canvas *canvas;
    uint8_t *heat; /* a row of the difference */
    uint8_t *row;  /* a row of all three, side by side */
    char *path;
    octreel_error error;
    bool written;
} drawing;

static const uint8_t *difference_row(int y, void *context)
{
    const drawing *d = context;
    const canvas *c = d->canvas;
    image_difference_row(&c->images[0], &c->images[1], &c->tolerance, y, d->heat);
    return d->heat;
}

static uint8_t *put_color(uint8_t *to, image_color color)
{
    *to++ = color.r;
    *to++ = color.g;
    *to++ = color.b;
    return to;
}

static uint8_t *put_image_row(uint8_t *to, const image *from, int y)
{
    for (int x = 0; x < from->width; x++)
        to = put_color(to, y < from->height ? image_color_at(from, x, y) : GAP_COLOR);
    return to;
}

static const uint8_t *side_row(int y, void *context)
{
    const drawing *d = context;
    const canvas *c = d->canvas;
    const uint8_t *heat = difference_row(y, context);
    uint8_t *to = d->row;
    for (int i = 0; i < 2; i++) {
        to = put_image_row(to, &c->images[i], y);
        for (int x = 0; x < GAP; x++)
            to = put_color(to, GAP_COLOR);
    }
    for (int x = 0; x < c->width; x++)
        to = put_color(to, c->palette.colors[heat[x]]);
    return d->row;
}

static void write_drawing(size_t i, void *context)
{
    drawing *d = (drawing *)context + i;
    const canvas *c = d->canvas;
    const bool beside = i == 1;
    const image_rows rows = {
        .width = beside ? c->images[0].width + c->images[1].width + c->width + 2 * GAP : c->width,
        .height = c->height,
        .palette = beside ? NULL : &c->palette,
        .row = beside ? side_row : difference_row,
        .context = d,
    };
    d->heat = malloc((size_t)c->width);
    d->row = malloc(3 * (size_t)rows.width);
    if (d->path && d->heat && d->row)
        d->written = image_write_png_rows(&rows, d->path, &d->error);
    else
        snprintf(d->error.text, sizeof d->error.text, "there is no memory");
    free(d->heat);
    free(d->row);
}

/* Both at the same time, each from the images that both read. */
static bool write_drawings(const canvas *c, const diff_pair *pair, const char *folder, unsigned *written,
                           octreel_error *error)
{
    static const evidence_picture pictures[2] = {EVIDENCE_DIFFERENCE, EVIDENCE_SIDE};
    drawing drawings[2] = {{.canvas = c}, {.canvas = c}};
    bool ok = true;
    for (int i = 0; i < 2; i++)
        drawings[i].path = picture_path(folder, pair, pictures[i]);
    parallel_for(2, 2, write_drawing, drawings);
    for (int i = 0; i < 2; i++) {
        *written |= drawings[i].written ? 1u << pictures[i] : 0;
        if (ok && !drawings[i].written)
            ok = error_set(error, "%s", drawings[i].error.text);
        free(drawings[i].path);
    }
    return ok;
}

static bool draw_difference(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                            octreel_error *error)
{
    canvas c = {.palette = image_difference_palette(), .tolerance = options->tolerance};
    c.tolerance.ignored = pair->ignored;
    c.tolerance.ignored_count = pair->ignored_count;
    const bool ok =
        read_images(&c, pair, options->background, error) && write_drawings(&c, pair, folder, written, error);
    image_release(&c.images[0]);
    image_release(&c.images[1]);
    return ok;
}

bool evidence_draw(const diff_pair *pair, const diff_options *options, const char *folder, unsigned *written,
                   octreel_error *error)
{
    *written = 0;
    if (!copy_frame(pair->a, pair, EVIDENCE_EXPECTED, folder, written, error) ||
        !copy_frame(pair->b, pair, EVIDENCE_ACTUAL, folder, written, error))
        return false;
    const bool both = (pair->finding == FOUND_PIXELS || pair->finding == FOUND_SIZE) && pair->a->path && pair->b->path;
    return !both || draw_difference(pair, options, folder, written, error);
}
