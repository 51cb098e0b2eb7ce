/* draw.h - a scene becomes pixels: the public face of this folder.
 *
 * A renderer holds one off-screen context and draws scenes of one size into indices of the theme's table. Under
 * anti-aliasing it draws view_samples() times as many pixels on each axis, which somebody else makes colours of: lines,
 * marks and letters are as large in the picture as without. Use it from the thread that opened it.
 */
#ifndef DRAW_DRAW_H
#define DRAW_DRAW_H

#include "error.h"
#include "scene.h"

typedef struct renderer renderer;

/* Kinds of off-screen contexts, in the order in which DRAW_AUTO tries those that are built. */
typedef enum draw_context { DRAW_AUTO, DRAW_OSMESA, DRAW_EGL, DRAW_CONTEXTS } draw_context;

/* "auto", "osmesa", "egl"; null from DRAW_CONTEXTS on. And the inverse; false when there is no such name. */
const char *draw_context_name(draw_context kind);
bool draw_context_parse(const char *name, draw_context *kind);

/* Whether this program was built with it. */
bool draw_context_built(draw_context kind);

/* Which renderer is wanted; zeros are what gives the same pixels everywhere. */
typedef struct renderer_choice {
    draw_context context;
    bool any_renderer; /* take what is not llvmpipe too: a graphics card, say */
} renderer_choice;

/* Who draws: static while the renderer lives. */
typedef struct renderer_info {
    const char *context;                     /* "osmesa", "egl" */
    const char *vendor, *renderer, *version; /* GL's own strings */
} renderer_info;

/* Open a context and a framebuffer of this size, samples counted. Null, and a sentence, when there is no such context,
 * when something else than llvmpipe would draw, or when the size is outside 1..VIEW_MAX_SIDE. Cost: some 10 ms and
 * 85 MB. */
renderer *renderer_open(int width, int height, const renderer_choice *choice, octreel_error *error);
void renderer_close(renderer *r);

renderer_info renderer_about(const renderer *r);

/* Draw a scene whose picture has the renderer's size in samples into width * height indices, rows from the top. */
bool renderer_draw(renderer *r, const scene *s, uint8_t *indices, octreel_error *error);

/* A rectangle of the picture, in its pixels; it may reach beyond the border. */
typedef struct draw_box {
    int x, y, width, height;
} draw_box;

/* Where a scene's letters and panels are: no text lights a pixel outside these boxes. Needs no renderer. */
void draw_text_boxes(const scene *s, void (*visit)(const draw_box *box, void *context), void *context);

/* Elements of the last scene that are not in its frame: NaN or infinite, or too far off for doubles. */
size_t renderer_left_out(const renderer *r);

/* ---- What is drawn where ------------------------------------------------------------------------------------ */

/* Draw a scene as renderer_draw() does, the same quads in the same order; but in place of its colour each sample gets
 * the number (scene_number_of) of the element that was painted there last. Where boxes share an edge that is the
 * shallowest of those which are there; where points share a quad, the one it was painted for: renderer_pixel() names
 * them all. */
bool renderer_pick(renderer *r, const scene *s, uint32_t *numbers, octreel_error *error);

/* Where a set of layers (bits 1 << view_layer, LAYER_DIAGRAM too) is seen in a scene's picture: a byte a pixel, 1 where
 * an element of theirs is on top at any of the pixel's samples, else 0. Without these layers no other pixel would be
 * different. */
bool renderer_layer_mask(renderer *r, const scene *s, unsigned layers, uint8_t *mask, octreel_error *error);

/* What an element has to do with a pixel, which is view_samples() squared samples. */
typedef struct draw_touch {
    uint32_t number;
    int shown;     /* samples at which it is seen: nothing was painted over it */
    int painted;   /* samples that were painted for it; 0: it is there by the quad of the one before it in the list, a
                      box that has the same edge there, or a point of the same pixel */
    uint16_t at;   /* which samples were painted: a bit for each, row by row */
    uint8_t color; /* index of the theme's table that was painted last; 0 also in the gaps of what is cut */
} draw_touch;

typedef struct draw_touches {
    draw_touch *items;
    size_t count, room;
} draw_touches;

void draw_touches_release(draw_touches *list);

/* Fill a list with all elements of a pixel of the picture, from the one on top to the one beneath all others: also
 * those that others cover. A zeroed list is an empty one. */
bool renderer_pixel(renderer *r, const scene *s, int x, int y, draw_touches *list, octreel_error *error);

#endif
