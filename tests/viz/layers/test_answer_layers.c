/* SPDX-License-Identifier: MIT */
/* test_answer_layers.c - tests that each answer of a tick is drawn in the layer of its query kind, and nothing else is.
 */
#include "scenes.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw_list.h"
#include "layer_type.h"
#include "random_session.h"

static void check_marked(const scene *s, unsigned layer, const octree_answer *answer)
{
    for (size_t i = 0; i < answer->count; i++)
        assert_true(count_markers_at(s, layer, answer->points[i].id, answer->points[i].position) >= 1);
}

static void check_range(const scene *s, const octree_answer *answer, size_t place, layer_counts *due)
{
    assert_true(same_box(&find_only_box(s, LAYER_RANGE, place)->box, &answer->box));
    check_marked(s, LAYER_RANGE, answer);
    due->boxes++;
    due->markers += answer->count;
}

static void check_nearest(const scene *s, const octree_answer *answer, size_t place, layer_counts *due)
{
    for (size_t i = 0; i < answer->count; i++) {
        const octree_point *nearest = &answer->neighbors[i].point;
        assert_int_equal(count_lines_between(s, LAYER_NEAREST, place, answer->target, nearest->position), 1);
        assert_true(count_markers_at(s, LAYER_NEAREST, nearest->id, nearest->position) >= 1);
    }
    due->segments += answer->count;
    due->markers += answer->count;
}

/* The great circles of a ball, and the chords that each is drawn by. */
#define BALL_CIRCLES 3
#define BALL_CHORDS 96

/* Return the label with this id and rank, or null. It is next to the point, on a background of its own. */
static const scene_label *rank_of(const scene *s, unsigned layer, uint64_t id, size_t rank, const double at[3])
{
    char number[24];
    double pixel[2];
    snprintf(number, sizeof number, "%zu", rank);
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        size_t grounds = 0;
        if (label->style.layer != layer || label->id != id)
            continue;
        pixel_of(s, at, pixel);
        assert_true(!label->in_world && strcmp(label->text, number) == 0);
        assert_true(fabs(label->at[0] - pixel[0]) < 3 * s->text.width + 8 * s->unit);
        assert_true(fabs(label->at[1] - pixel[1]) < 3 * s->text.height);
        for (size_t k = 0; k < s->panels.count; k++)
            grounds += s->panels.items[k].style.layer == layer && s->panels.items[k].id == id;
        assert_int_equal(grounds, 1);
        return label;
    }
    return NULL;
}

static bool is_behind_the_eye(const scene *s, const double at[3])
{
    double seen[3];
    camera_transform(&s->camera, at, seen);
    return s->camera.perspective && seen[2] < s->camera.near;
}

/* Each neighbour has a line from the target. The first nine have their ranks beside them, if there is room. */
static void check_knearest(const scene *s, const octree_answer *answer, size_t place, layer_counts *due)
{
    for (size_t i = 0; i < answer->count; i++) {
        const double *at = answer->neighbors[i].point.position;
        const uint64_t id = (uint64_t)place << 32 | i;
        assert_int_equal(count_lines_between(s, LAYER_KNEAREST, id, answer->target, at), 1);
        const bool ranked = rank_of(s, LAYER_KNEAREST, id, i + 1, at) != NULL;
        assert_true(!ranked || (i < 9 && !is_behind_the_eye(s, at)));
        due->labels += ranked;
        due->panels += ranked;
    }
    due->segments += answer->count;
}

/* A ball is three closed chains of chords. Each chain lies in a plane through the centre, its corners on the ball. */
static void check_radius(const scene *s, const octree_answer *answer, size_t place, layer_counts *due)
{
    size_t in_plane[3] = {0, 0, 0};
    const double *last = NULL;
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *chord = &s->segments.items[i];
        if (chord->style.layer != LAYER_RADIUS || chord->id >> 32 != place)
            continue;
        const size_t number = chord->id & UINT32_MAX, plane = number / BALL_CHORDS;
        double square = 0;
        for (int axis = 0; axis < 3; axis++)
            square += pow((chord->ends[0][axis] - answer->target[axis]) / (answer->radius > 0 ? answer->radius : 1), 2);
        assert_true(fabs(square - (answer->radius > 0)) < 1e-12);
        assert_true(chord->ends[0][plane] == answer->target[plane] && chord->ends[1][plane] == answer->target[plane]);
        assert_true(number % BALL_CHORDS == 0 || same_position(chord->ends[0], last));
        in_plane[plane]++;
        last = chord->ends[1];
        if (number % BALL_CHORDS == BALL_CHORDS - 1)
            assert_int_equal(count_lines_between(s, LAYER_RADIUS, chord->id - (BALL_CHORDS - 1), last,
                                                 s->segments.items[i - (BALL_CHORDS - 1)].ends[1]),
                             1);
    }
    for (int plane = 0; plane < 3; plane++)
        assert_int_equal(in_plane[plane], BALL_CHORDS);
    check_marked(s, LAYER_RADIUS, answer);
    due->segments += 3 * (size_t)BALL_CHORDS;
    due->markers += answer->count;
}

static void find_contact(const octree_answer *ray, double t, double at[3])
{
    for (int i = 0; i < 3; i++)
        at[i] = ray->target[i] + t * ray->direction[i];
}

/* An arrow to the last of k hits and dashes beyond, or an arrow to the end; each hit has a marker and a line to its
 * point, and the first nine may have their ranks. */
static void check_ray(const scene *s, const octree_answer *answer, size_t place, layer_counts *due)
{
    const bool complete = answer->count > 0 && answer->count == answer->k;
    const uint64_t id = (uint64_t)place << 32;
    double at[3];
    for (size_t i = 0; i < answer->count; i++) {
        const octree_point *point = &answer->neighbors[i].point;
        find_contact(answer, answer->neighbors[i].distance, at);
        assert_int_equal(count_lines_between(s, LAYER_RAY, id | (2 + i), at, point->position), 1);
        assert_true(count_markers_at(s, LAYER_RAY, point->id, at) >= 1);
        const bool ranked = rank_of(s, LAYER_RAY, id | i, i + 1, at) != NULL;
        due->labels += ranked;
        due->panels += ranked;
    }
    if (complete)
        assert_int_equal(count_lines_between(s, LAYER_RAY, id, answer->target, at), 1);
    size_t beyond = 0;
    for (size_t i = 0; i < s->segments.count; i++)
        beyond += s->segments.items[i].style.layer == LAYER_RAY && s->segments.items[i].id == (id | 1);
    assert_true(complete ? beyond <= 1 : beyond == 0);
    due->segments += 1 + beyond + answer->count;
    due->markers += answer->count;
}

/* The ends of the edges lie in all half-spaces, and on the boundary of at least one. */
static void check_frustum(const scene *s, const octree_answer *answer, size_t place, layer_counts *due)
{
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *edge = &s->segments.items[i];
        if (edge->style.layer != LAYER_FRUSTUM || edge->id >> 32 != place)
            continue;
        due->segments++;
        for (int end = 0; end < 2; end++) {
            size_t touched = 0;
            for (size_t k = 0; k < answer->frustum.count; k++) {
                const octree_half_space *space = &answer->frustum.half_spaces[k];
                double excess = -space->offset, size = fabs(space->offset);
                for (int axis = 0; axis < 3; axis++) {
                    excess += space->normal[axis] * edge->ends[end][axis];
                    size += fabs(space->normal[axis] * edge->ends[end][axis]);
                }
                assert_true(excess <= 1e-9 * size);
                touched += fabs(excess) <= 1e-9 * size;
            }
            assert_true(touched >= 1);
        }
    }
    check_marked(s, LAYER_FRUSTUM, answer);
    due->markers += answer->count;
}

/* The box at both ends and, with k hits, at the last of them; the ways of its corners; the hits and their ranks. */
static void check_sweep(const scene *s, const octree_answer *answer, size_t place, layer_counts *due)
{
    const uint64_t id = (uint64_t)place << 32;
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *way = &s->segments.items[i];
        if (way->style.layer != LAYER_SWEEP || way->id >> 32 != place)
            continue;
        for (int axis = 0; axis < 3; axis++) {
            assert_true(fabs(fabs(way->ends[0][axis] - answer->target[axis]) - answer->half[axis]) < 1e-9);
            assert_true(fabs(fabs(way->ends[1][axis] - answer->to[axis]) - answer->half[axis]) < 1e-9);
        }
    }
    for (size_t i = 0; i < answer->count; i++) {
        const octree_point *point = &answer->neighbors[i].point;
        assert_true(count_markers_at(s, LAYER_SWEEP, point->id, point->position) >= 1);
        const bool ranked = rank_of(s, LAYER_SWEEP, id | i, i + 1, point->position) != NULL;
        due->labels += ranked;
        due->panels += ranked;
    }
    due->boxes += 2 + (answer->count > 0 && answer->count == answer->k);
    due->segments += 8;
    due->markers += answer->count;
}

/* Each answer is shown in the layer of its kind, and that layer shows nothing else. */
static void check_answers(const scene *s, const octree_tick *tick)
{
    static const struct {
        view_layer layer;
        void (*check)(const scene *, const octree_answer *, size_t, layer_counts *);
    } kinds[OCTREE_QUERY_KINDS] = {
        [OCTREE_QUERY_RANGE] = {LAYER_RANGE, check_range},
        [OCTREE_QUERY_NEAREST] = {LAYER_NEAREST, check_nearest},
        [OCTREE_QUERY_KNEAREST] = {LAYER_KNEAREST, check_knearest},
        [OCTREE_QUERY_RADIUS] = {LAYER_RADIUS, check_radius},
        [OCTREE_QUERY_RAY] = {LAYER_RAY, check_ray},
        [OCTREE_QUERY_FRUSTUM] = {LAYER_FRUSTUM, check_frustum},
        [OCTREE_QUERY_SWEEP] = {LAYER_SWEEP, check_sweep},
    };
    for (int kind = 0; kind < OCTREE_QUERY_KINDS; kind++) {
        layer_counts due = {0}, found = count_layer(s, kinds[kind].layer);
        for (size_t i = 0; i < tick->answer_count; i++)
            if ((int)tick->answers[i].kind == kind)
                kinds[kind].check(s, &tick->answers[i], i, &due);
        assert_true(found.boxes == due.boxes && found.segments == due.segments && found.markers == due.markers &&
                    found.labels == due.labels && found.panels == due.panels);
    }
}

static void check_session(const octree_session *session, view_camera camera)
{
    const view v = view_of(320, 180, camera, VIEW_ALL_LAYERS);
    octree_game *game = start_game(session);
    scene s = {0};
    for (;; play_tick(game)) {
        build_tick(&s, &v, game);
        check_answers(&s, octree_game_tick(game));
        if (octree_game_over(game))
            break;
    }
    scene_release(&s);
    octree_game_destroy(game);
}

static void every_answer_of_a_session_is_shown_in_its_layer(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    check_session(&session, CAMERA_ISO);
}

static void every_answer_of_random_sessions_is_shown_in_its_layer(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 24; seed++) {
        random_session made;
        random_session_mixed(&made, seed);
        check_session(&made.session, (view_camera)(seed % CAMERA_COUNT));
    }
}

/* Several points at one pixel have their ranks on different sides of it. */
static void ranks_of_neighbours_never_cover_each_other(void **state)
{
    (void)state;
    static const octree_game_body bodies[] = {{.id = 1, .position = {5, 0, 5}},
                                              {.id = 2, .position = {5, 2, 5}},
                                              {.id = 3, .position = {5, -4, 5.01}},
                                              {.id = 4, .position = {-5, 0, -7}}};
    static const octree_query query = {.kind = OCTREE_QUERY_KNEAREST, .at_player = true, .k = 4};
    const view v = view_of(1280, 720, CAMERA_FRONT, VIEW_ALL_LAYERS);
    octree_session session = small_session(bodies, 4);
    session.queries = &query;
    session.query_count = 1;
    octree_game *game = start_game(&session);
    scene s = {0};
    build_tick(&s, &v, game);
    const octree_answer *answer = &octree_game_tick(game)->answers[0];
    for (size_t i = 0; i < 4; i++) {
        const scene_label *rank = rank_of(&s, LAYER_KNEAREST, i, i + 1, answer->neighbors[i].point.position);
        assert_non_null(rank);
        for (size_t k = 0; k < i; k++) {
            const scene_label *other = rank_of(&s, LAYER_KNEAREST, k, k + 1, answer->neighbors[k].point.position);
            assert_true(fabs(rank->at[0] - other->at[0]) >= s.text.width ||
                        fabs(rank->at[1] - other->at[1]) >= s.text.height);
        }
    }
    octree_game_destroy(game);
    scene_release(&s);
}

/* Where the ball reaches beyond all doubles, its chords are counted and left out; the points in it are marked. */
static void chords_of_a_ball_beyond_all_doubles_are_counted_and_left_out(void **state)
{
    (void)state;
    static const octree_query query = {.kind = OCTREE_QUERY_RADIUS, .target = {DBL_MAX, 0, 0}, .radius = DBL_MAX};
    const view v = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS);
    octree_session session = small_session(NULL, 0);
    session.queries = &query;
    session.query_count = 1;
    octree_game *game = start_game(&session);
    scene s = {0};
    assert_true(tick_scene_build(&s, &v, game, NULL, NULL));
    const layer_counts found = count_layer(&s, LAYER_RADIUS);
    assert_true(s.refused > 0);
    assert_int_equal(found.segments + s.refused, BALL_CIRCLES * BALL_CHORDS);
    assert_int_equal(found.markers, octree_game_tick(game)->answers[0].count);
    octree_game_destroy(game);
    scene_release(&s);
}

/* The same queries of a tree and of a tick are drawn with the same elements. */
static void answers_of_a_tree_are_drawn_like_answers_of_a_tick(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    const view v = view_of(640, 360, CAMERA_ISO, VIEW_ALL_LAYERS);
    octree_game *game = start_game(&session);
    scene tick = {0}, tree = {0};
    while (octree_game_tick(game)->number < 219) /* the tick that asks every kind of query */
        play_tick(game);
    build_tick(&tick, &v, game);
    const octree_tick *asked = octree_game_tick(game);
    const tree_subject about = {.title = "tree", .answers = asked->answers, .answer_count = asked->answer_count};
    assert_true(tree_scene_build(&tree, &v, octree_game_tree(game), &about));
    for (unsigned layer = LAYER_RANGE; layer <= LAYER_RAY; layer++) {
        const layer_counts a = count_layer(&tick, layer), b = count_layer(&tree, layer);
        assert_true(a.boxes + a.segments + a.markers > 0 && a.boxes == b.boxes && a.segments == b.segments);
        assert_true(a.markers == b.markers && a.labels == b.labels);
    }
    for (size_t i = 0; i < asked->answer_count; i++)
        if (asked->answers[i].kind == OCTREE_QUERY_RANGE)
            assert_non_null(find_only_box(&tree, LAYER_RANGE, i));
    scene_release(&tick);
    scene_release(&tree);
    octree_game_destroy(game);
}

/* A few marks are large and easy to see; many marks are small and do not hide each other. */
static void many_marks_are_smaller_than_few(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 50, 51, 500, 501, 2000};
    static octree_point points[2000];
    const octree_box world = cube(-10, 10);
    unsigned before = UINT8_MAX;
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        const octree_answer answer = {.kind = OCTREE_QUERY_RADIUS, .radius = 5, .points = points, .count = counts[i]};
        const view v = view_of(320, 180, CAMERA_ISO, VIEW_ALL_LAYERS);
        scene s = empty_scene(&v, &world);
        layer_RADIUS.add_answer(&s, &(layer_source){.answers = &answer, .answer_count = 1}, 0, LAYER_RADIUS);
        assert_int_equal(s.markers.count, counts[i]);
        const unsigned width = s.markers.items[0].style.width;
        assert_true(width > 0 && (i % 2 ? width == before : width < before));
        before = width;
        scene_release(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_answer_of_a_session_is_shown_in_its_layer),
        cmocka_unit_test(every_answer_of_random_sessions_is_shown_in_its_layer),
        cmocka_unit_test(ranks_of_neighbours_never_cover_each_other),
        cmocka_unit_test(chords_of_a_ball_beyond_all_doubles_are_counted_and_left_out),
        cmocka_unit_test(answers_of_a_tree_are_drawn_like_answers_of_a_tick),
        cmocka_unit_test(many_marks_are_smaller_than_few),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
