/* SPDX-License-Identifier: MIT */
#include "theme.h"

#define ROLE_NAME(role, name, r, g, b) name,
#define ROLE_COLOR(role, name, r, g, b) {r, g, b},
static const char *const role_names[ROLE_COUNT] = {THEME_ROLE_MAP(ROLE_NAME)};
static const theme_color roles[ROLE_COUNT] = {THEME_ROLE_MAP(ROLE_COLOR)};

const char *theme_role_name(theme_role role)
{
    return role_names[role];
}

/* The part of the role's own colour in each shade, in 256ths. */
static const int strength[THEME_SHADES] = {256, 236, 216, 196, 176, 156, 136, 116};

static uint8_t mix(uint8_t color, uint8_t ground, int part)
{
    return (uint8_t)((color * part + ground * (256 - part)) / 256);
}

theme_color theme_shade(theme_color full, unsigned shade)
{
    const theme_color ground = roles[ROLE_BACKGROUND];
    const int part = strength[shade];
    return (theme_color){mix(full.r, ground.r, part), mix(full.g, ground.g, part), mix(full.b, ground.b, part)};
}

theme_color theme_color_at(uint8_t index)
{
    const unsigned role = index / THEME_SHADES;
    return role < ROLE_COUNT ? theme_shade(roles[role], index % THEME_SHADES) : roles[ROLE_BACKGROUND];
}

theme_role theme_node_role(unsigned depth)
{
    return (theme_role)(ROLE_NODE + (depth < THEME_NODE_DEPTHS ? depth : THEME_NODE_DEPTHS - 1));
}

unsigned theme_step(uint64_t amount, unsigned shift)
{
    unsigned step = 0;
    for (; amount > 0 && step < THEME_NODE_DEPTHS - 1; amount >>= shift)
        step++;
    return step;
}
