/* theme.c - see theme.h. */
#include "theme.h"

/* On a dark ground. Single meanings are from the set of Okabe and Ito (2008), which survives colour blindness, and two
 * more were searched for beside them; depth is a ramp of growing lightness from blue to pale yellow, after cividis
 * (Nunez et al. 2018), so that it survives grey. */
static const theme_color roles[ROLE_COUNT] = {
    [ROLE_BACKGROUND] = {13, 17, 26},  [ROLE_PANEL] = {24, 30, 43},       [ROLE_TEXT] = {236, 240, 246},
    [ROLE_FAINT] = {139, 150, 170},    [ROLE_WORLD] = {96, 108, 130},     [ROLE_POINT] = {245, 247, 250},
    [ROLE_PLAYER] = {240, 228, 66},    [ROLE_COLLISION] = {255, 64, 64},  [ROLE_RANGE] = {240, 165, 30},
    [ROLE_RADIUS] = {140, 250, 185},   [ROLE_KNEAREST] = {180, 152, 255}, [ROLE_NEAREST] = {255, 172, 222},
    [ROLE_WARNING] = {240, 190, 90},   [ROLE_NODE + 0] = {84, 98, 150},   [ROLE_NODE + 1] = {74, 110, 168},
    [ROLE_NODE + 2] = {62, 122, 176},  [ROLE_NODE + 3] = {54, 136, 176},  [ROLE_NODE + 4] = {58, 150, 168},
    [ROLE_NODE + 5] = {78, 164, 152},  [ROLE_NODE + 6] = {106, 174, 128}, [ROLE_NODE + 7] = {142, 186, 112},
    [ROLE_NODE + 8] = {178, 196, 104}, [ROLE_NODE + 9] = {212, 206, 116}, [ROLE_SHAPE] = {90, 200, 255},
};

const char *theme_name(void)
{
    return "night";
}

/* How much of the role's own colour is left in a shade, in 256ths: the far end keeps less than half. */
static const int strength[THEME_SHADES] = {256, 236, 216, 196, 176, 156, 136, 116};

static uint8_t mix(uint8_t color, uint8_t ground, int part)
{
    return (uint8_t)((color * part + ground * (256 - part)) / 256);
}

theme_color theme_color_at(uint8_t index)
{
    const theme_color ground = roles[ROLE_BACKGROUND];
    const unsigned role = index / THEME_SHADES;
    if (role >= ROLE_COUNT)
        return ground;
    const int part = strength[index % THEME_SHADES];
    return (theme_color){mix(roles[role].r, ground.r, part), mix(roles[role].g, ground.g, part),
                         mix(roles[role].b, ground.b, part)};
}

theme_role theme_node_role(unsigned depth)
{
    return (theme_role)(ROLE_NODE + (depth < THEME_NODE_DEPTHS ? depth : THEME_NODE_DEPTHS - 1));
}

unsigned theme_occupancy_step(size_t count)
{
    unsigned step = 0;
    for (; count > 0 && step < THEME_NODE_DEPTHS - 1; count /= 2)
        step++;
    return step;
}
