/* draw.h - a scene becomes pixels: the public face of this folder.
 *
 * A renderer holds one off-screen context and draws scenes of one size into indices of the theme's table. Under
 * anti-aliasing it draws view_samples() times as many pixels on each axis, which somebody else makes colours of: lines,
 * marks and letters are as large in the picture as without. Use it from the thread that opened it.
 */
#ifndef DRAW_DRAW_H
#define DRAW_DRAW_H

#include "scene.h"

#define DRAW_MAX_SIDE 16384

typedef struct renderer renderer;

typedef struct draw_error {
    char text[256]; /* one sentence */
} draw_error;

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
 * when something else than llvmpipe would draw, or when the size is outside 1..DRAW_MAX_SIDE. Cost: some 10 ms and
 * 85 MB. */
renderer *renderer_open(int width, int height, const renderer_choice *choice, draw_error *error);
void renderer_close(renderer *r);

renderer_info renderer_about(const renderer *r);

/* Draw a scene whose picture has the renderer's size in samples into width * height indices, rows from the top. */
bool renderer_draw(renderer *r, const scene *s, uint8_t *indices, draw_error *error);

/* A rectangle of the picture, in its pixels; it may reach beyond the border. */
typedef struct draw_box {
    int x, y, width, height;
} draw_box;

/* Where a scene's letters and panels are: no text lights a pixel outside these boxes. Needs no renderer. */
void draw_text_boxes(const scene *s, void (*visit)(const draw_box *box, void *context), void *context);

/* Elements of the last scene that are not in its frame: NaN or infinite, or too far off for doubles. */
size_t renderer_left_out(const renderer *r);

#endif
