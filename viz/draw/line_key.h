/* line_key.h - the line of the world that an edge of a box lies on: boxes share an edge where two are equal. Private.
 */
#ifndef DRAW_LINE_KEY_H
#define DRAW_LINE_KEY_H

#include "scene.h"

/* Parallel to an axis at `u` and `v` on the two others. */
typedef struct line_key {
    double u, v;
    uint32_t kind; /* layer, style, width and axis: what is drawn alike */
} line_key;

/* The line through a place. */
static inline line_key line_key_at(scene_style style, unsigned axis, const double at[3])
{
    return (line_key){
        .u = at[(axis + 1) % 3],
        .v = at[(axis + 2) % 3],
        .kind = (uint32_t)style.layer << 24 | (uint32_t)style.stroke << 16 | (uint32_t)style.width << 8 | axis,
    };
}

/* That of the edge of a box at one of the four corners across an axis. */
static inline line_key line_key_of(const scene_box *box, unsigned axis, unsigned corner)
{
    double at[3] = {0};
    at[(axis + 1) % 3] = (corner & 1 ? box->box.max : box->box.min)[(axis + 1) % 3];
    at[(axis + 2) % 3] = (corner & 2 ? box->box.max : box->box.min)[(axis + 2) % 3];
    return line_key_at(box->style, axis, at);
}

static inline unsigned line_key_axis(const line_key *key)
{
    return key->kind & 0xff;
}

static inline int compare_doubles(double a, double b)
{
    return (a > b) - (a < b);
}

/* The order of painting: by kind, and then by place. */
static inline int line_key_compare(const line_key *a, const line_key *b)
{
    if (a->kind != b->kind)
        return a->kind < b->kind ? -1 : 1;
    const int u = compare_doubles(a->u, b->u);
    return u ? u : compare_doubles(a->v, b->v);
}

#endif
