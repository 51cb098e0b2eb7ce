/* theme.h - what the colours mean, and the fixed table of 256 that a frame is made of.
 *
 * A role has eight shades, from 0 (near, full colour) to 7 (far, towards the background): the colour of a pixel is
 * the index role * 8 + shade. Red is the role of collision and of nothing else.
 */
#ifndef SCENE_THEME_H
#define SCENE_THEME_H

#include <stddef.h>
#include <stdint.h>

#define THEME_SHADES 8
#define THEME_NODE_DEPTHS 10 /* deeper nodes share the last */

typedef enum theme_role {
    ROLE_BACKGROUND,
    ROLE_PANEL,
    ROLE_TEXT,
    ROLE_FAINT, /* secondary text, axes */
    ROLE_WORLD,
    ROLE_POINT,
    ROLE_PLAYER,
    ROLE_COLLISION,
    ROLE_RANGE,
    ROLE_RADIUS,
    ROLE_KNEAREST,
    ROLE_NEAREST,
    ROLE_WARNING, /* refused, full: seen beside its word */
    ROLE_NODE,    /* and the THEME_NODE_DEPTHS - 1 roles after it, by depth */
    ROLE_SHAPE = ROLE_NODE + THEME_NODE_DEPTHS,
    ROLE_COUNT
} theme_role;

typedef struct theme_color {
    uint8_t r, g, b;
} theme_color;

/* The name that recording.json gives to this table. */
const char *theme_name(void);

/* The colour of an index; the background beyond the last role. */
theme_color theme_color_at(uint8_t index);

static inline uint8_t theme_index(unsigned role, unsigned shade)
{
    return (uint8_t)(role * THEME_SHADES + shade);
}

/* The number of indices in use. */
#define THEME_COLORS (ROLE_COUNT * THEME_SHADES)

/* The colour of a node by its depth, or by any other step of the same ramp. */
theme_role theme_node_role(unsigned depth);

/* The step of the ramp for a number of points: 0, 1, 2 to 3, 4 to 7 ... 256 and more. The same in every session. */
unsigned theme_occupancy_step(size_t count);

/* Where its last step begins. */
#define THEME_MOST_POINTS (1u << (THEME_NODE_DEPTHS - 2))

/* The one colour of nodes that tell nothing by it. */
#define ROLE_NODE_PLAIN (ROLE_NODE + 3)

#endif
