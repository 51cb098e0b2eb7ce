/* SPDX-License-Identifier: MIT */
/* theme.c - the names and colours of roles, and the ramps of colours; see theme.h. */
#include "theme.h"

#include <stdio.h>

#define ROLE_NAME(role, name, r, g, b) name,
#define ROLE_COLOR(role, name, r, g, b) {r, g, b},
static const char *const role_names[ROLE_COUNT] = {THEME_ROLE_MAP(ROLE_NAME)};
static const theme_color roles[ROLE_COUNT] = {THEME_ROLE_MAP(ROLE_COLOR)};

const char *theme_role_name(theme_role role)
{
    return role == ROLE_OWN ? "own" : role_names[role];
}

/* The weight of a role's full colour in each shade, in 256ths. The remaining weight is the weight of the background
 * colour. */
static const int strength[THEME_SHADES] = {256, 236, 216, 196, 176, 156, 136, 116};

static uint8_t mix_channel(uint8_t color, uint8_t ground, int part)
{
    return (uint8_t)((color * part + ground * (256 - part)) / 256);
}

char *theme_print_color(theme_color color, char text[THEME_COLOR_TEXT])
{
    snprintf(text, THEME_COLOR_TEXT, "#%02x%02x%02x", color.r, color.g, color.b);
    return text;
}

theme_color theme_fade_color(theme_color full, int parts)
{
    const theme_color ground = roles[ROLE_BACKGROUND];
    return (theme_color){mix_channel(full.r, ground.r, parts), mix_channel(full.g, ground.g, parts),
                         mix_channel(full.b, ground.b, parts)};
}

theme_color theme_shade_color(theme_color full, unsigned shade)
{
    return theme_fade_color(full, strength[shade]);
}

theme_color theme_color_at(uint8_t index)
{
    const unsigned kind = (unsigned)(index - THEME_FIRST_KIND) / THEME_KIND_SHADES;
    if (index < THEME_FIRST_KIND)
        return theme_shade_color(roles[index / THEME_SHADES], index % THEME_SHADES);
    return index < THEME_COLORS ? theme_shade_color(roles[ROLE_KIND + kind], index % THEME_KIND_SHADES * 2)
                                : roles[ROLE_BACKGROUND];
}

theme_role theme_node_role(unsigned depth)
{
    return (theme_role)(ROLE_NODE + (depth < THEME_NODE_DEPTHS ? depth : THEME_NODE_DEPTHS - 1));
}

theme_role theme_node_kind_role(unsigned kind)
{
    return (theme_role)(ROLE_KIND + (kind < THEME_NODE_KINDS ? kind : THEME_NODE_KINDS - 1));
}

unsigned theme_step_of_doubling_ramp(uint64_t amount, unsigned shift)
{
    unsigned step = 0;
    for (; amount > 0 && step < THEME_NODE_DEPTHS - 1; amount >>= shift)
        step++;
    return step;
}

unsigned theme_step_of_even_ramp(uint64_t amount, uint64_t whole)
{
    const unsigned last = THEME_NODE_DEPTHS - 1;
    return amount >= whole ? last : (unsigned)((amount * last + whole - 1) / whole);
}

/* ---- Colours of amounts and kinds ----------------------------------------------------------------------------- */

#define RAMP_STEPS 32

static const theme_color ramp[RAMP_STEPS] = {
    {67, 58, 130},  {65, 68, 135},  {62, 75, 137},  {58, 83, 138},  {55, 91, 140},  {52, 98, 141},  {48, 105, 141},
    {45, 113, 142}, {42, 120, 142}, {40, 127, 141}, {37, 134, 141}, {34, 141, 140}, {33, 148, 139}, {33, 155, 136},
    {34, 162, 134}, {35, 169, 131}, {44, 175, 126}, {53, 181, 121}, {61, 187, 116}, {72, 192, 110}, {86, 197, 102},
    {100, 202, 94}, {113, 206, 86}, {128, 210, 77}, {143, 213, 68}, {157, 216, 58}, {172, 220, 49}, {187, 223, 39},
    {204, 225, 38}, {221, 227, 38}, {237, 229, 37}, {253, 231, 37},
};

static uint8_t interpolate_channel(uint8_t from, uint8_t to, int part)
{
    return (uint8_t)(from + ((to - from) * part + 128) / 256);
}

theme_color theme_ramp_color(double part)
{
    if (!(part > 0))
        return ramp[0];
    if (part >= 1)
        return ramp[RAMP_STEPS - 1];
    const int at = (int)(part * ((RAMP_STEPS - 1) * 256)), step = at / 256, rest = at % 256;
    const theme_color a = ramp[step], b = ramp[step + 1];
    return (theme_color){interpolate_channel(a.r, b.r, rest), interpolate_channel(a.g, b.g, rest),
                         interpolate_channel(a.b, b.b, rest)};
}

theme_color theme_kind_color(unsigned kind)
{
    static const theme_color kinds[THEME_KINDS] = {{95, 100, 110}, {230, 159, 0},   {0, 158, 115},  {240, 228, 66},
                                                   {0, 114, 178},  {220, 130, 190}, {86, 180, 233}, {236, 236, 236}};
    return kinds[kind % THEME_KINDS];
}
