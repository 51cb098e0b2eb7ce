/* SPDX-License-Identifier: MIT */
/* theme.h - the meanings of colours, and the fixed table of at most 256 colours of a frame.
 *
 * A role is a meaning with a colour. Each role has eight shades from 0 (near, full colour) to 7 (far, almost
 * background), and each shade has an index in the table. The kinds of foreign nodes use only four indices each, one for
 * two shades, because the table has no more room. Red means collision and nothing else. */
#ifndef SCENE_THEME_H
#define SCENE_THEME_H

#include <stddef.h>
#include <stdint.h>

#define THEME_SHADES 8

/* One row for each role: its name and its colour on the dark background. Scene digests hash the names.
 *
 * Roles with a single meaning have colours close to those of Okabe and Ito (2008), chosen by a search so that they
 * differ under every kind of colour blindness. Depths of nodes have a ramp from blue to pale yellow with growing
 * lightness, after cividis (Nunez et al. 2018), so that depths also differ in grey. Kinds of foreign nodes have colours
 * chosen by a search: for every kind of colour vision, they differ from each other and from the colours of elements
 * that are drawn over nodes.
 *
 * To add a role, add a row before the kinds: `test_theme --propose` prints colours that differ visibly from all
 * others. */
#define THEME_ROLE_MAP(X)                                                                                              \
    X(ROLE_BACKGROUND, "background", 13, 17, 26)                                                                       \
    X(ROLE_PANEL, "panel", 24, 30, 43)                                                                                 \
    X(ROLE_TEXT, "text", 236, 240, 246)                                                                                \
    X(ROLE_FAINT, "faint", 139, 150, 170) /* for secondary text and for axes */                                        \
    X(ROLE_WORLD, "world", 96, 108, 130)                                                                               \
    X(ROLE_POINT, "point", 245, 247, 250)                                                                              \
    X(ROLE_PLAYER, "player", 254, 246, 84)                                                                             \
    X(ROLE_COLLISION, "collision", 255, 64, 64) /* for collisions; no other role is red */                             \
    X(ROLE_RANGE, "range", 240, 165, 30)                                                                               \
    X(ROLE_RADIUS, "radius", 140, 250, 185)                                                                            \
    X(ROLE_KNEAREST, "knearest", 180, 152, 255)                                                                        \
    X(ROLE_NEAREST, "nearest", 255, 172, 222)                                                                          \
    X(ROLE_WARNING, "warning", 240, 190, 90) /* for the words refused, full and wrong */                               \
    X(ROLE_NODE, "node", 84, 98, 150)        /* the root; the next rows are the depths 1 to 9 */                       \
    X(ROLE_NODE_1, "node-1", 74, 110, 168)                                                                             \
    X(ROLE_NODE_2, "node-2", 62, 122, 176)                                                                             \
    X(ROLE_NODE_3, "node-3", 54, 136, 176)                                                                             \
    X(ROLE_NODE_4, "node-4", 58, 150, 168)                                                                             \
    X(ROLE_NODE_5, "node-5", 78, 164, 152)                                                                             \
    X(ROLE_NODE_6, "node-6", 106, 174, 128)                                                                            \
    X(ROLE_NODE_7, "node-7", 142, 186, 112)                                                                            \
    X(ROLE_NODE_8, "node-8", 178, 196, 104)                                                                            \
    X(ROLE_NODE_9, "node-9", 212, 206, 116)                                                                            \
    X(ROLE_SHAPE, "shape", 142, 196, 252)                                                                              \
    X(ROLE_WRONG, "wrong", 228, 40, 255) /* wrong answers of a foreign index, and the points in these answers */       \
    X(ROLE_MISSED, "missed", 0, 216, 174)                                                                              \
    X(ROLE_HIT, "hit", 102, 122, 254)       /* for leaves in which queries found points */                             \
    X(ROLE_CHANGE, "change", 210, 250, 130) /* splits (solid lines) and merges (dashed lines) */                       \
    X(ROLE_KIND, "kind", 112, 208, 136)     /* the first kind of foreign nodes; the next rows are the other kinds */   \
    X(ROLE_KIND_1, "kind-1", 248, 136, 224)                                                                            \
    X(ROLE_KIND_2, "kind-2", 200, 216, 80)                                                                             \
    X(ROLE_KIND_3, "kind-3", 120, 32, 248)                                                                             \
    X(ROLE_KIND_4, "kind-4", 176, 80, 0)                                                                               \
    X(ROLE_KIND_5, "kind-5", 56, 112, 88)                                                                              \
    X(ROLE_KIND_6, "kind-6", 144, 56, 176)

#define THEME_NODE_DEPTHS 10 /* the number of roles for node depths; all deeper nodes have the last of these roles */
/* the number of roles for kinds of foreign nodes; all further kinds have the last of these roles */
#define THEME_NODE_KINDS 7

#define THEME_ROLE_VALUE(role, ...) role,
typedef enum theme_role { THEME_ROLE_MAP(THEME_ROLE_VALUE) ROLE_COUNT } theme_role;
#undef THEME_ROLE_VALUE

typedef struct theme_color {
    uint8_t r, g, b;
} theme_color;

/* The name of this table of colours in recording.json. */
#define THEME_NAME "night"

/* Returns the name of a role, such as "range" or "node-3". */
const char *theme_role_name(theme_role role);

/* Returns a colour in a shade from 0 (full colour) to THEME_SHADES - 1 (almost background). */
theme_color theme_shade_color(theme_color full, unsigned shade);

/* Returns the colour at an index of the table. Returns the background colour for an index beyond the last role. */
theme_color theme_color_at(uint8_t index);

/* THEME_KIND_SHADES: the number of indices of each kind of foreign nodes. THEME_FIRST_KIND: the first index of the
 * first kind. THEME_COLORS: the number of indices in use. */
#define THEME_KIND_SHADES (THEME_SHADES / 2)
#define THEME_FIRST_KIND (ROLE_KIND * THEME_SHADES)
#define THEME_COLORS (THEME_FIRST_KIND + (ROLE_COUNT - ROLE_KIND) * THEME_KIND_SHADES)

static inline uint8_t theme_color_index(unsigned role, unsigned shade)
{
    return (uint8_t)(role < ROLE_KIND ? role * THEME_SHADES + shade
                                      : THEME_FIRST_KIND + (role - ROLE_KIND) * THEME_KIND_SHADES + shade / 2);
}

/* ROLE_OWN: the role of an element with a colour of its own, which is not in the table. THEME_OWN: the table index of
 * the pixels of such an element. */
#define ROLE_OWN ROLE_COUNT
#define THEME_OWN THEME_COLORS

/* Print a colour as "#rrggbb". Returns `text`. */
#define THEME_COLOR_TEXT 8
char *theme_print_color(theme_color color, char text[THEME_COLOR_TEXT]);

/* Mix a colour with the background: 256 parts give the colour, 0 parts the background. */
theme_color theme_fade_color(theme_color full, int parts);

/* Returns the colour of a value from 0 to 1; smaller and larger values are clamped. The ramp is viridis (van der Walt
 * and Smith 2015) without its darkest sixth, which would be invisible on the background. Equal differences of values
 * look equal, and larger values are lighter. */
theme_color theme_ramp_color(double part);

/* A pixel with this many points or more has the last colour of the density ramp. A power of two. */
#define THEME_MOST_DENSITY 64

/* Returns the colour of a kind of class; find_class_color_kind() groups the classes of points into kinds. The colours
 * can be told apart under every kind of colour blindness: the colours of Okabe and Ito without their red, and two
 * greys. */
#define THEME_KINDS 8
theme_color theme_kind_color(unsigned kind);

/* Returns the role of a node at this depth. The ramps of heat and occupancy use the same roles. */
theme_role theme_node_role(unsigned depth);

/* Returns the role of a kind of foreign nodes, numbered from 0. */
theme_role theme_node_kind_role(unsigned kind);

/* Returns the step of the ramp for an amount. Each step begins at 2^shift times the amount at which the previous step
 * begins. With a shift of 1 the steps are 0, 1, 2 to 3, 4 to 7 ... 256 and more. */
unsigned theme_step_of_doubling_ramp(uint64_t amount, unsigned shift);

/* Returns the step of the ramp for an amount from 0 to `whole`. Only the amount 0 has the first step. The other steps
 * divide the amounts up to `whole` into equal parts; greater amounts have the last step. `whole` must be below 2^60. */
unsigned theme_step_of_even_ramp(uint64_t amount, uint64_t whole);

/* The least amount in the last step of theme_step_of_doubling_ramp() with a shift of 1. */
#define THEME_MOST_POINTS (1u << (THEME_NODE_DEPTHS - 2))

/* The role of nodes under COLORING_PLAIN. */
#define ROLE_NODE_PLAIN (ROLE_NODE + 3)

#endif
