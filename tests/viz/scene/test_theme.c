/* SPDX-License-Identifier: MIT */
/* test_theme.c - the colours of the theme: their meanings, how they fade, and that they stay distinct in grey and for
 * colour-blind eyes. */
#include "fixture.h"
#include "layer.h"
#include "theme.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Hue in degrees from red, 0 to 180 either way, and how far a colour is from grey (chroma), 0 to 255. */
static double degrees_from_red(theme_color c, double *chroma)
{
    const double y = sqrt(3) / 2 * (c.g - c.b), x = c.r - (c.g + c.b) / 2.0;
    *chroma = hypot(x, y);
    return fabs(atan2(y, x)) * 180 / acos(-1);
}

static bool is_reddish(theme_color c)
{
    double chroma;
    return degrees_from_red(c, &chroma) <= 25 && chroma >= 12;
}

static void only_collision_is_red(void **state)
{
    (void)state;
    for (unsigned role = 0; role < ROLE_COUNT; role++) {
        for (unsigned shade = 0; shade < THEME_SHADES; shade++) {
            const theme_color color = theme_color_at(theme_color_index(role, shade));
            double chroma;
            if (role == ROLE_COLLISION)
                assert_true(degrees_from_red(color, &chroma) < 15 && chroma > 60);
            else
                assert_false(is_reddish(color));
        }
    }
}

/* Linear light of a channel (sRGB, IEC 61966-2-1). */
static double linear(uint8_t channel)
{
    const double c = channel / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double luminance(theme_color c)
{
    return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

static void deeper_nodes_are_lighter_also_in_grey(void **state)
{
    (void)state;
    for (unsigned shade = 0; shade < THEME_SHADES; shade++)
        for (unsigned depth = 1; depth < THEME_NODE_DEPTHS; depth++)
            assert_true(luminance(theme_color_at(theme_color_index(theme_node_role(depth), shade))) >
                        luminance(theme_color_at(theme_color_index(theme_node_role(depth - 1), shade))));
}

static void nodes_deeper_than_the_ramp_have_its_last_colour(void **state)
{
    (void)state;
    assert_int_equal(theme_node_role(0), ROLE_NODE);
    for (unsigned depth = THEME_NODE_DEPTHS - 1; depth < 1000; depth++)
        assert_int_equal(theme_node_role(depth), ROLE_NODE + THEME_NODE_DEPTHS - 1);
}

static int distance_to_ground(theme_color c)
{
    const theme_color ground = theme_color_at(theme_color_index(ROLE_BACKGROUND, 0));
    return abs(c.r - ground.r) + abs(c.g - ground.g) + abs(c.b - ground.b);
}

static void farther_shades_approach_the_background_and_stay_distinct_from_it(void **state)
{
    (void)state;
    for (unsigned role = ROLE_BACKGROUND + 1; role < ROLE_COUNT; role++) {
        int last = distance_to_ground(theme_color_at(theme_color_index(role, 0)));
        const unsigned step = role < ROLE_KIND ? 1 : THEME_SHADES / THEME_KIND_SHADES;
        for (unsigned shade = step; shade < THEME_SHADES; shade += step) {
            const int now = distance_to_ground(theme_color_at(theme_color_index(role, shade)));
            assert_true(now < last);
            last = now;
        }
        assert_true(role == ROLE_PANEL || last >= 64);
    }
}

static void the_background_has_no_shades_and_is_index_0(void **state)
{
    (void)state;
    assert_int_equal(theme_color_index(ROLE_BACKGROUND, 0), 0);
    for (unsigned shade = 0; shade < THEME_SHADES; shade++)
        assert_int_equal(distance_to_ground(theme_color_at(theme_color_index(ROLE_BACKGROUND, shade))), 0);
}

static void every_index_fits_a_byte_and_is_used_once(void **state)
{
    (void)state;
    bool used[256] = {false};
    assert_true(THEME_COLORS < 256); /* and one for painted points: THEME_OWN */
    for (unsigned role = 0; role < ROLE_COUNT; role++) {
        const unsigned step = role < ROLE_KIND ? 1 : THEME_SHADES / THEME_KIND_SHADES;
        for (unsigned shade = 0; shade < THEME_SHADES; shade += step) {
            assert_true(theme_color_index(role, shade) < THEME_COLORS);
            assert_false(used[theme_color_index(role, shade)]);
            used[theme_color_index(role, shade)] = true;
        }
    }
    for (unsigned index = THEME_COLORS; index < 256; index++)
        assert_int_equal(distance_to_ground(theme_color_at((uint8_t)index)), 0);
}

/* Simulation of colour blindness by Machado, Oliveira and Fernandes (2009), severity 1.0, on linear light: without red,
 * green or blue; and normal sight. */
static const double eyes[][3][3] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}},
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}},
    {{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}},
};

/* A colour as a kind of sight perceives it, in CIE L*a*b* (D65). */
static void to_lab(theme_color c, const double eye[3][3], double lab[3])
{
    static const double xyz_of[3][3] = {{0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047},
                                        {0.2126729, 0.7151522, 0.0721750},
                                        {0.0193339 / 1.08883, 0.1191920 / 1.08883, 0.9503041 / 1.08883}};
    const double light[3] = {linear(c.r), linear(c.g), linear(c.b)};
    double seen[3], f[3];
    for (int i = 0; i < 3; i++) {
        const double sum = eye[i][0] * light[0] + eye[i][1] * light[1] + eye[i][2] * light[2];
        seen[i] = fmin(fmax(sum, 0), 1);
    }
    for (int i = 0; i < 3; i++) {
        const double t = xyz_of[i][0] * seen[0] + xyz_of[i][1] * seen[1] + xyz_of[i][2] * seen[2];
        f[i] = t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

static double colors_apart(theme_color a, theme_color b, const double eye[3][3])
{
    double p[3], q[3];
    to_lab(a, eye, p);
    to_lab(b, eye, q);
    return sqrt(pow(p[0] - q[0], 2) + pow(p[1] - q[1], 2) + pow(p[2] - q[2], 2));
}

static double apart(theme_role a, theme_role b, const double eye[3][3])
{
    return colors_apart(theme_color_at(theme_color_index(a, 0)), theme_color_at(theme_color_index(b, 0)), eye);
}

/* A minimum distance in L*a*b*; colours at a distance of 2 or 3 are just distinct side by side. */
#define CLEARLY_APART 12

static const theme_role meanings[] = {ROLE_POINT,   ROLE_PLAYER, ROLE_COLLISION, ROLE_RANGE, ROLE_RADIUS, ROLE_KNEAREST,
                                      ROLE_NEAREST, ROLE_WRONG,  ROLE_MISSED,    ROLE_HIT,   ROLE_CHANGE, ROLE_SHAPE};
#define MEANINGS (sizeof meanings / sizeof meanings[0])
#define EYES (sizeof eyes / sizeof eyes[0])

static void meanings_stay_distinct_without_red_or_green(void **state)
{
    (void)state;
    for (size_t eye = 0; eye < EYES; eye++) {
        for (size_t i = 0; i < MEANINGS; i++) {
            for (size_t j = i + 1; j < MEANINGS; j++)
                assert_true(apart(meanings[i], meanings[j], eyes[eye]) > CLEARLY_APART);
            assert_true(apart(meanings[i], ROLE_BACKGROUND, eyes[eye]) > 3 * CLEARLY_APART);
        }
    }
}

/* The line to the nearest neighbour differs from nodes by its dashes. All other meanings are drawn with solid lines. */
static void solid_meanings_stay_distinct_from_nodes(void **state)
{
    (void)state;
    for (size_t eye = 0; eye < EYES; eye++)
        for (size_t i = 0; i < MEANINGS; i++)
            for (unsigned depth = 0; depth < THEME_NODE_DEPTHS && meanings[i] != ROLE_NEAREST; depth++)
                assert_true(apart(meanings[i], theme_node_role(depth), eyes[eye]) > CLEARLY_APART);
}

/* Points, leaves with found points, changes of the tree and velocities differ by colour. Splits and merges have one
 * colour and differ by dashes. */
static void one_look_has_one_meaning(void **state)
{
    (void)state;
    static const view_layer layers[] = {LAYER_POINTS, LAYER_HIT, LAYER_SPLITS, LAYER_VELOCITIES};
    for (size_t eye = 0; eye < EYES; eye++)
        for (int i = 0; i < 4; i++)
            for (int j = i + 1; j < 4; j++)
                assert_true(apart((theme_role)layer_rows[layers[i]].role, (theme_role)layer_rows[layers[j]].role,
                                  eyes[eye]) > CLEARLY_APART);
    assert_int_equal(layer_rows[LAYER_SPLITS].role, layer_rows[LAYER_MERGES].role);
}

/* The contrast by WCAG 2.1 of a colour that is lighter than its background; text needs 4.5. */
static double contrast(theme_color c, theme_role ground)
{
    return (luminance(c) + 0.05) / (luminance(theme_color_at(theme_color_index(ground, 0))) + 0.05);
}

/* ---- Colours of amounts and kinds --------------------------------------------------------------------------- */

#define RAMP_TESTED 31

/* The steps are equal for normal sight, and each is lighter for every kind of sight, so that grey shows them as well.
 */
static void the_ramp_grows_evenly_lighter_for_every_kind_of_sight(void **state)
{
    (void)state;
    double smallest = 1000, largest = 0;
    for (size_t eye = 0; eye < EYES; eye++) {
        for (int i = 0; i < RAMP_TESTED; i++) {
            const theme_color a = theme_ramp_color((double)i / RAMP_TESTED),
                              b = theme_ramp_color((i + 1.0) / RAMP_TESTED);
            double before[3], after[3];
            to_lab(a, eyes[eye], before);
            to_lab(b, eyes[eye], after);
            assert_true(after[0] > before[0] + (eye < 3 ? 1 : 0)); /* without blue the last is one */
            smallest = eye == 0 ? fmin(smallest, colors_apart(a, b, eyes[eye])) : smallest;
            largest = eye == 0 ? fmax(largest, colors_apart(a, b, eyes[eye])) : largest;
        }
    }
    assert_true(smallest > 5 && largest < 7);
    assert_true(contrast(theme_ramp_color(0), ROLE_BACKGROUND) > 1.5);
}

static void the_ramp_has_a_colour_for_the_largest_amount(void **state)
{
    (void)state;
    const theme_color ends[] = {theme_ramp_color(0), theme_ramp_color(1)},
                      beyond[] = {theme_ramp_color(-3), theme_ramp_color(1e300)};
    const theme_color none = theme_ramp_color(nan(""));
    assert_memory_equal(ends, beyond, sizeof ends);
    assert_memory_equal(&ends[0], &none, sizeof none);
}

static void kinds_of_nodes_stay_distinct_without_red_or_green(void **state)
{
    (void)state;
    for (size_t eye = 0; eye < EYES; eye++)
        for (unsigned i = 0; i < THEME_KINDS; i++)
            for (unsigned j = i + 1; j < THEME_KINDS; j++)
                assert_true(colors_apart(theme_kind_color(i), theme_kind_color(j), eyes[eye]) > CLEARLY_APART);
}

/* Boxes of several kinds cross each other: their colours differ clearly from each other and from elements on them. */
static void kinds_of_nodes_are_distinct_for_every_kind_of_sight(void **state)
{
    (void)state;
    for (size_t eye = 0; eye < EYES; eye++)
        for (unsigned i = 0; i < THEME_NODE_KINDS; i++) {
            const theme_role kind = theme_node_kind_role(i);
            for (unsigned j = i + 1; j < THEME_NODE_KINDS; j++)
                assert_true(apart(kind, theme_node_kind_role(j), eyes[eye]) > 2.5 * CLEARLY_APART);
            for (size_t j = 0; j < MEANINGS; j++)
                assert_true(apart(kind, meanings[j], eyes[eye]) > CLEARLY_APART);
            assert_true(apart(kind, ROLE_NODE_PLAIN, eyes[eye]) > CLEARLY_APART);
            assert_true(contrast(theme_color_at(theme_color_index(kind, 0)), ROLE_BACKGROUND) >= 3);
        }
    assert_int_equal(theme_node_kind_role(THEME_NODE_KINDS), theme_node_kind_role(THEME_NODE_KINDS - 1));
}

/* ---- A colour for a new role -------------------------------------------------------------------------------- */

/* The smallest distance of a colour from any role, for any kind of sight; 0 if it is reddish, or hard to see on the
 * background or the panel. */
static double worth_of(theme_color c)
{
    double least = 1000;
    if (contrast(c, ROLE_BACKGROUND) < 4.5 || contrast(c, ROLE_PANEL) < 4.5)
        return 0;
    for (unsigned shade = 0; shade < THEME_SHADES; shade++)
        if (is_reddish(theme_shade_color(c, shade)) || distance_to_ground(theme_shade_color(c, shade)) < 64)
            return 0;
    for (size_t eye = 0; eye < EYES; eye++)
        for (unsigned role = 0; role < ROLE_COUNT; role++)
            least = fmin(least, colors_apart(c, theme_color_at(theme_color_index(role, 0)), eyes[eye]));
    return least;
}

enum { PROPOSALS = 5, STEP = 6 };

/* Propose the colours with the greatest distance from all roles and from the colours proposed before. */
static int propose(void)
{
    theme_color told[PROPOSALS];
    for (int i = 0; i < PROPOSALS; i++) {
        double best = 0;
        for (int rgb = 0; rgb < 43 * 43 * 43; rgb++) {
            const theme_color c = {(uint8_t)(rgb / 43 / 43 * STEP), (uint8_t)(rgb / 43 % 43 * STEP),
                                   (uint8_t)(rgb % 43 * STEP)};
            double worth = worth_of(c);
            for (size_t eye = 0; eye < EYES; eye++)
                for (int j = 0; j < i; j++)
                    worth = fmin(worth, colors_apart(c, told[j], eyes[eye]));
            if (worth > best) {
                best = worth;
                told[i] = c;
            }
        }
        if (best <= 0)
            break;
        printf("%3d, %3d, %3d: at least %.1f from every role by every eye%s\n", told[i].r, told[i].g, told[i].b, best,
               best > CLEARLY_APART ? "" : "; too near for a role that nothing but its colour tells");
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--propose") == 0)
        return propose();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_collision_is_red),
        cmocka_unit_test(deeper_nodes_are_lighter_also_in_grey),
        cmocka_unit_test(nodes_deeper_than_the_ramp_have_its_last_colour),
        cmocka_unit_test(farther_shades_approach_the_background_and_stay_distinct_from_it),
        cmocka_unit_test(the_background_has_no_shades_and_is_index_0),
        cmocka_unit_test(every_index_fits_a_byte_and_is_used_once),
        cmocka_unit_test(meanings_stay_distinct_without_red_or_green),
        cmocka_unit_test(one_look_has_one_meaning),
        cmocka_unit_test(the_ramp_grows_evenly_lighter_for_every_kind_of_sight),
        cmocka_unit_test(the_ramp_has_a_colour_for_the_largest_amount),
        cmocka_unit_test(kinds_of_nodes_are_distinct_for_every_kind_of_sight),
        cmocka_unit_test(kinds_of_nodes_stay_distinct_without_red_or_green),
        cmocka_unit_test(solid_meanings_stay_distinct_from_nodes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
