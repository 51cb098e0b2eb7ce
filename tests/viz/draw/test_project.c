/* SPDX-License-Identifier: MIT */
/* test_project.c - projecting, clipping and cutting of segments, compared with long double, with sampling, and at
 * 1e300. */
#include "scenes.h"
#include "project.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#define WIDTH 400
#define HEIGHT 300

/* How far a clipped line may reach beyond the picture; the limit in project.c is smaller. */
#define MARGIN 1024

/* Invisible differences: half a step of the grid to which pixels are snapped, and a thousandth of a band. */
#define UNSEEN (1.0 / 512)
#define UNSEEN_BAND 1e-3

static scene scene_of(view_camera kind)
{
    const octree_box world = cube(-1, 1);
    const view v = view_of(WIDTH, HEIGHT, kind, VIEW_ALL_LAYERS);
    return empty_scene(&v, &world);
}

/* A position in camera coordinates (right, up, depth) and its pixel, in long double. */
typedef struct sight {
    long double seen[3], pixel[2];
} sight;

static sight look_at(const camera *c, const long double position[3])
{
    const double *axes[3] = {c->right, c->up, c->forward};
    sight result = {0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            result.seen[i] += (2 * ((position[j] - c->origin[j]) / c->size) - c->half[j] - c->eye[j]) * axes[i][j];
    const long double scale = c->perspective ? c->zoom / result.seen[2] : c->zoom;
    result.pixel[0] = c->middle[0] + result.seen[0] * scale;
    result.pixel[1] = c->middle[1] - result.seen[1] * scale;
    return result;
}

/* The distance of a pixel from a piece. */
static long double distance_to(const piece *p, const long double pixel[2])
{
    const long double dx = p->to[0] - (long double)p->from[0], dy = p->to[1] - (long double)p->from[1];
    const long double square = dx * dx + dy * dy;
    long double t = square > 0 ? ((pixel[0] - p->from[0]) * dx + (pixel[1] - p->from[1]) * dy) / square : 0;
    t = fminl(fmaxl(t, 0), 1);
    return hypotl(p->from[0] + t * dx - pixel[0], p->from[1] + t * dy - pixel[1]);
}

static long double band_position(const camera *c, long double depth)
{
    return (depth - c->near_depth) / (c->far_depth - (long double)c->near_depth) * QUAD_BANDS;
}

static bool band_agrees(const camera *c, long double depth, unsigned band)
{
    const long double position = band_position(c, depth);
    return (band == 0 || position > band - UNSEEN_BAND) &&
           (band == QUAD_BANDS - 1 || position < band + 1 + UNSEEN_BAND);
}

static bool in_picture(const sight *s, const camera *c)
{
    return (!c->perspective || s->seen[2] >= c->near) && s->pixel[0] >= 0 && s->pixel[0] <= WIDTH && s->pixel[1] >= 0 &&
           s->pixel[1] <= HEIGHT;
}

/* The test fails unless all pieces are finite, near the picture, and in bands that only rise or only fall. */
static unsigned assert_sound(const scene *s, const double from[3], const double to[3], piece pieces[QUAD_BANDS])
{
    bool overflowed;
    const unsigned count = project_segment(s, from, to, pieces, &overflowed);
    assert_true(count <= QUAD_BANDS);
    for (unsigned i = 0; i < count; i++) {
        const double ends[4] = {pieces[i].from[0], pieces[i].from[1], pieces[i].to[0], pieces[i].to[1]};
        for (int j = 0; j < 4; j++)
            assert_true(ends[j] >= -MARGIN && ends[j] <= (j % 2 ? HEIGHT : WIDTH) + MARGIN);
        assert_true(pieces[i].band < QUAD_BANDS);
        if (i + 2 < count) {
            const int step = (int)pieces[i + 1].band - (int)pieces[i].band;
            assert_true(step != 0 && (step > 0) == (pieces[i + 2].band > pieces[i + 1].band));
        }
    }
    return count;
}

#define SAMPLES 200

/* The test fails unless every visible sample of the segment is on a piece in the right band. */
static void assert_all_seen(const scene *s, const double from[3], const double to[3], const piece *pieces,
                            unsigned count)
{
    for (int i = 0; i <= SAMPLES; i++) {
        const long double t = (long double)i / SAMPLES;
        long double position[3];
        for (int axis = 0; axis < 3; axis++)
            position[axis] = from[axis] * (1 - t) + to[axis] * t;
        const sight at = look_at(&s->camera, position);
        bool found = !in_picture(&at, &s->camera);
        for (unsigned p = 0; !found && p < count; p++)
            found = distance_to(&pieces[p], at.pixel) < UNSEEN && band_agrees(&s->camera, at.seen[2], pieces[p].band);
        assert_true(found);
    }
}

/* The test fails unless every visible point of the pieces is on the segment: in the plane through it and the eye, and
 * within its ends. */
static void assert_nothing_else_seen(const scene *s, const double from[3], const double to[3], const piece *pieces,
                                     unsigned count)
{
    const camera *c = &s->camera;
    const sight a = look_at(c, (long double[3]){from[0], from[1], from[2]});
    const sight b = look_at(c, (long double[3]){to[0], to[1], to[2]});
    for (unsigned i = 0; i < 2 * count; i++) {
        const double *pixel = i % 2 ? pieces[i / 2].to : pieces[i / 2].from;
        const long double x = (pixel[0] - (long double)c->middle[0]) / c->zoom;
        const long double y = (c->middle[1] - (long double)pixel[1]) / c->zoom;
        long double p[2], q[2]; /* the ends as projected by lines through the eye, or along the view */
        long double dx = b.seen[0] - a.seen[0], dy = b.seen[1] - a.seen[1];
        long double off = dx * (y - a.seen[1]) - dy * (x - a.seen[0]), t = 0;
        if (c->perspective) { /* (x, y, 1) = u * (a + t * (b - a)): t from the larger of two equations */
            const long double dz = b.seen[2] - a.seen[2];
            p[0] = a.seen[0] - x * a.seen[2], q[0] = dx - x * dz;
            p[1] = a.seen[1] - y * a.seen[2], q[1] = dy - y * dz;
            off = p[0] * q[1] - p[1] * q[0];
        } else {
            p[0] = a.seen[0] - x, q[0] = dx;
            p[1] = a.seen[1] - y, q[1] = dy;
        }
        const int larger = fabsl(q[0]) < fabsl(q[1]);
        if (fabsl(q[larger]) < 1e-6L)
            continue;
        t = -p[larger] / q[larger];
        assert_true(fabsl(off) / fabsl(q[larger]) < 1e-9L);
        assert_true(t > -1e-6L && t < 1 + 1e-6L);
    }
}

static void assert_joined(const piece *pieces, unsigned count)
{
    for (unsigned i = 0; i + 1 < count; i++) {
        assert_int_equal(abs((int)pieces[i + 1].band - (int)pieces[i].band), 1);
        assert_true(pieces[i].to[0] == pieces[i + 1].from[0] && pieces[i].to[1] == pieces[i + 1].from[1]);
    }
}

static void random_position(uint64_t *random, double reach, double position[3])
{
    for (int axis = 0; axis < 3; axis++)
        position[axis] = random_below(random, 8) ? random_between(random, -reach, reach) : 0;
}

static void segments_are_projected_as_in_long_double(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int i = 0; i < 6000; i++) {
        const scene s = scene_of((view_camera)(i % CAMERA_COUNT));
        const double reach = i % 5 ? 1 : i % 3 ? 6 : 100;
        double from[3], to[3];
        piece pieces[QUAD_BANDS];
        random_position(&random, reach, from);
        random_position(&random, reach, to);
        for (int axis = 0; axis < 3; axis++) /* some are parallel to an axis, some are points */
            to[axis] = random_below(&random, 4) ? to[axis] : from[axis];
        const unsigned count = assert_sound(&s, from, to, pieces);
        assert_all_seen(&s, from, to, pieces, count);
        assert_nothing_else_seen(&s, from, to, pieces, count);
        if (reach == 1 && s.view.camera != CAMERA_FOLLOW)
            assert_joined(pieces, count);
    }
}

static void reversed_segment_has_the_same_pieces_backwards(void **state)
{
    (void)state;
    uint64_t random = 6;
    for (int i = 0; i < 3000; i++) {
        const scene s = scene_of((view_camera)(i % CAMERA_COUNT));
        double from[3], to[3];
        piece forth[QUAD_BANDS], back[QUAD_BANDS];
        random_position(&random, 3, from);
        random_position(&random, 3, to);
        const unsigned count = assert_sound(&s, from, to, forth);
        assert_int_equal(assert_sound(&s, to, from, back), count);
        for (unsigned p = 0; p < count; p++) {
            const piece *other = &back[count - 1 - p];
            assert_int_equal(forth[p].band, other->band);
            for (int axis = 0; axis < 2; axis++) {
                assert_true(fabs(forth[p].from[axis] - other->to[axis]) < 1e-6);
                assert_true(fabs(forth[p].to[axis] - other->from[axis]) < 1e-6);
            }
        }
    }
}

/* The position that is this far to the right, up and forward from the eye, in unit coordinates. */
static void from_eye(const camera *c, double right, double up, double forward, double position[3])
{
    for (int axis = 0; axis < 3; axis++)
        position[axis] = c->eye[axis] + right * c->right[axis] + up * c->up[axis] + forward * c->forward[axis];
}

static void segments_behind_the_eye_are_invisible(void **state)
{
    (void)state;
    static const view_camera kinds[] = {CAMERA_FOLLOW, CAMERA_ORBIT};
    for (size_t kind = 0; kind < 2; kind++) {
        const scene s = scene_of(kinds[kind]);
        double ends[2][3], pixel[2];
        piece pieces[QUAD_BANDS];
        unsigned band;
        bool overflowed;
        from_eye(&s.camera, -1, 0.5, -0.001, ends[0]);
        from_eye(&s.camera, 1, -0.5, -3, ends[1]);
        assert_int_equal(project_segment(&s, ends[0], ends[1], pieces, &overflowed), 0);
        assert_false(overflowed);
        assert_false(find_pixel_and_band(&s, ends[0], pixel, &band));
        assert_false(find_pixel_and_band(&s, s.camera.eye, pixel, &band));
        assert_int_equal(assert_sound(&s, s.camera.eye, s.camera.eye, pieces), 0);
    }
}

/* A segment straight ahead, from behind the eye through it, is a single pixel in the middle, in every band from the
 * nearest to the farthest. */
static void segment_through_the_eye_is_cut_at_the_near_plane(void **state)
{
    (void)state;
    static const view_camera kinds[] = {CAMERA_FOLLOW, CAMERA_ORBIT};
    for (size_t kind = 0; kind < 2; kind++) {
        const scene s = scene_of(kinds[kind]);
        double ends[2][3];
        piece pieces[QUAD_BANDS];
        from_eye(&s.camera, 0, 0, -2, ends[0]);
        from_eye(&s.camera, 0, 0, 9, ends[1]);
        assert_int_equal(assert_sound(&s, ends[0], ends[1], pieces), QUAD_BANDS);
        for (unsigned i = 0; i < QUAD_BANDS; i++) {
            assert_int_equal(pieces[i].band, i);
            assert_true(fabs(pieces[i].from[0] - s.camera.middle[0]) < 1e-6 &&
                        fabs(pieces[i].to[1] - s.camera.middle[1]) < 1e-6);
        }
        assert_joined(pieces, QUAD_BANDS);
    }
}

/* Far ends of every magnitude, with segments before, behind and beside the eye. */
static void every_segment_gives_only_pieces_near_the_picture(void **state)
{
    (void)state;
    static const double sizes[] = {0, 1e-320, 1e-9, 1, 1e8, 1e16, 1e100, 1e290, 1e300, 1e304, 1e306, DBL_MAX};
    uint64_t random = 8;
    for (int i = 0; i < 60000; i++) {
        const scene s = scene_of((view_camera)(i % CAMERA_COUNT));
        double ends[2][3], pixel[2];
        piece pieces[QUAD_BANDS];
        unsigned band;
        for (int j = 0; j < 6; j++) {
            const double size = sizes[random_below(&random, sizeof sizes / sizeof sizes[0])];
            ends[j / 3][j % 3] = random_below(&random, 2) ? size : -size;
        }
        assert_sound(&s, ends[0], ends[1], pieces);
        if (find_pixel_and_band(&s, ends[0], pixel, &band))
            assert_true(fabs(pixel[0]) < WIDTH + MARGIN && fabs(pixel[1]) < HEIGHT + MARGIN && band < QUAD_BANDS);
    }
}

/* The first and the last pixel of a clipped segment. */
static unsigned ends_of(const scene *s, const double from[3], const double to[3], double first[2], double last[2])
{
    piece pieces[QUAD_BANDS];
    const unsigned count = assert_sound(s, from, to, pieces);
    for (int axis = 0; count && axis < 2; axis++) {
        first[axis] = pieces[0].from[axis];
        last[axis] = pieces[count - 1].to[axis];
    }
    return count;
}

static const double far_sizes[] = {1e3, 1e9, 1e12, 1e15, 1e17, 1e30, 1e100, 1e300};
#define FAR_SIZES (sizeof far_sizes / sizeof far_sizes[0])

/* The test fails unless a segment from the picture to a far point, in either direction, shows its whole part near the
 * picture. */
static void assert_ray_is_seen(const scene *s, const double start[3], const double direction[3])
{
    double near_part[3], ends[2][3];
    for (size_t i = 0; i < FAR_SIZES; i++) {
        for (int axis = 0; axis < 3; axis++) {
            ends[0][axis] = start[axis];
            ends[1][axis] = start[axis] + far_sizes[i] * direction[axis];
            near_part[axis] = start[axis] + (ends[1][axis] - start[axis]) / far_sizes[i] * 5;
        }
        for (int reversed = 0; reversed < 2; reversed++) {
            piece pieces[QUAD_BANDS];
            const unsigned count = assert_sound(s, ends[reversed], ends[!reversed], pieces);
            assert_all_seen(s, start, near_part, pieces, count);
        }
    }
}

static void segment_to_a_far_point_keeps_its_direction(void **state)
{
    (void)state;
    const double start[3] = {0.25, 0.125, -0.125};
    uint64_t random = 12;
    for (int i = 0; i < 60; i++) {
        const scene s = scene_of((view_camera)(i % CAMERA_COUNT));
        double direction[3];
        for (int axis = 0; axis < 3; axis++) /* slopes of a few bits, away from zero */
            direction[axis] = ((double)random_below(&random, 8) + 1) / 8 * (random_below(&random, 2) ? 1 : -1);
        assert_ray_is_seen(&s, start, direction);
    }
}

static void segment_across_the_picture_crosses_all_of_it(void **state)
{
    (void)state;
    const scene s = scene_of(CAMERA_FRONT);
    double pixel[2], first[2], last[2];
    pixel_of(&s, (double[3]){0.25, 0, -0.125}, pixel);
    for (size_t i = 0; i < FAR_SIZES; i++) {
        const double far = far_sizes[i], across[2][3] = {{-far, 0, -0.125}, {far, 0, -0.125}};
        assert_true(ends_of(&s, across[0], across[1], first, last) > 0);
        assert_true(first[0] <= 0 && last[0] >= WIDTH);
        assert_true(fabs(first[1] - pixel[1]) < UNSEEN && fabs(last[1] - pixel[1]) < UNSEEN);
        const double along[2][3] = {{0.25, 0, far}, {0.25, 0, -far}};
        assert_true(ends_of(&s, along[0], along[1], first, last) > 0);
        assert_true(first[1] <= 0 && last[1] >= HEIGHT);
        assert_true(fabs(first[0] - pixel[0]) < UNSEEN && fabs(last[0] - pixel[0]) < UNSEEN);
    }
}

/* Along the view of an orthographic camera a segment is a point of the picture, in every band. */
static void segment_along_the_view_passes_every_depth_band(void **state)
{
    (void)state;
    const scene s = scene_of(CAMERA_FRONT);
    for (size_t i = 0; i < FAR_SIZES; i++) {
        const double ends[2][3] = {{0.5, -far_sizes[i], 0.5}, {0.5, far_sizes[i], 0.5}};
        piece pieces[QUAD_BANDS];
        for (int reversed = 0; reversed < 2; reversed++) {
            assert_int_equal(assert_sound(&s, ends[reversed], ends[!reversed], pieces), QUAD_BANDS);
            for (unsigned band = 0; band < QUAD_BANDS; band++)
                assert_int_equal(pieces[band].band, reversed ? QUAD_BANDS - 1 - band : band);
        }
    }
}

static void segments_in_pixels_are_clipped_without_a_camera(void **state)
{
    (void)state;
    static const double ends[][2][3] = {
        {{3, 4, 9}, {50, 60, -9}}, {{-1e9, 20, 0}, {1e9, 20, 0}}, {{0, -1e9, 0}, {9, -1e9, 0}}};
    const octree_box world = cube(0, 1);
    for (int samples = 1; samples <= 4; samples *= 2) {
        view v = view_of(320, 180, CAMERA_ORBIT, VIEW_ALL_LAYERS);
        v.aa = samples;
        scene s = empty_scene(&v, &world);
        s.view.width *= samples; /* for the enlarged picture of the samples */
        s.view.height *= samples;
        piece p;
        assert_true(clip_picture_segment(&s, ends[0][0], ends[0][1], &p));
        assert_true(p.band == 0 && p.from[0] == 3 * samples && p.from[1] == 4 * samples);
        assert_true(p.to[0] == 50 * samples && p.to[1] == 60 * samples);
        assert_true(clip_picture_segment(&s, ends[1][0], ends[1][1], &p));
        assert_true(p.from[0] == -64 && p.to[0] == 320 * samples + 64 && p.from[1] == 20 * samples);
        assert_false(clip_picture_segment(&s, ends[2][0], ends[2][1], &p));
    }
}

static void points_have_the_band_of_their_depth(void **state)
{
    (void)state;
    uint64_t random = 10;
    for (int i = 0; i < 3000; i++) {
        const scene s = scene_of((view_camera)(i % CAMERA_COUNT));
        double position[3], pixel[2];
        unsigned band;
        random_position(&random, 1, position);
        const sight at = look_at(&s.camera, (long double[3]){position[0], position[1], position[2]});
        const bool seen = find_pixel_and_band(&s, position, pixel, &band);
        assert_true(seen || !in_picture(&at, &s.camera));
        if (!seen)
            continue;
        assert_true(fabsl(at.pixel[0] - pixel[0]) < 1e-9L && fabsl(at.pixel[1] - pixel[1]) < 1e-9L);
        assert_true(band_agrees(&s.camera, at.seen[2], band));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_are_projected_as_in_long_double),
        cmocka_unit_test(reversed_segment_has_the_same_pieces_backwards),
        cmocka_unit_test(segments_behind_the_eye_are_invisible),
        cmocka_unit_test(segment_through_the_eye_is_cut_at_the_near_plane),
        cmocka_unit_test(every_segment_gives_only_pieces_near_the_picture),
        cmocka_unit_test(segment_to_a_far_point_keeps_its_direction),
        cmocka_unit_test(segment_across_the_picture_crosses_all_of_it),
        cmocka_unit_test(segment_along_the_view_passes_every_depth_band),
        cmocka_unit_test(segments_in_pixels_are_clipped_without_a_camera),
        cmocka_unit_test(points_have_the_band_of_their_depth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
