/* SPDX-License-Identifier: MIT */
/* test_cli_queries.c - octreel inspect answers the queries of its command line as a scan over all points does. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "brute.h"
#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "images.h"
#include "tick_lines.h"
#include "image_compare.h"

enum { POINTS = 600, REACH = 50 };

/* Points with whole coordinates, some of them equal, with the ids that inspect gives them. */
static brute make_points(uint64_t seed)
{
    brute all = {0};
    for (uint64_t i = 0; i < POINTS; i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = (double)random_below(&seed, 2 * REACH + 1) - REACH;
        brute_insert(&all, i % 10 ? at : (double[]){1, 2, 3}, i);
    }
    return all;
}

static place write_points(void **state, const char *name, const brute *all)
{
    const place file = place_in(*state, name);
    FILE *out = fopen(file.path, "wb");
    assert_non_null(out);
    for (size_t i = 0; i < all->count; i++)
        fprintf(out, "%g %g %g\n", all->points[i].position[0], all->points[i].position[1], all->points[i].position[2]);
    assert_int_equal(fclose(out), 0);
    return file;
}

static double real(const json_t *object, const char *name)
{
    const json_t *value = json_member(object, name);
    assert_true(json_is_real(value));
    return json_real_value(value);
}

static void assert_place(const json_t *list, const double expected[3])
{
    assert_int_equal(json_array_size(list), 3);
    for (size_t i = 0; i < 3; i++)
        assert_true(json_real_value(json_array_get(list, i)) == expected[i]);
}

/* The test fails unless the cost of an answer is above 0 and no higher than the tree. */
static void assert_cost(const json_t *answer)
{
    const json_t *cost = json_member(answer, "cost");
    assert_members(cost, "nodes leaves points pruned taken");
    assert_true(real(cost, "leaves") <= real(cost, "nodes"));
    assert_true(real(cost, "nodes") + real(cost, "taken") >= 1 || real(answer, "found") == 0);
    assert_true(real(cost, "points") <= POINTS);
}

/* The points of an answer; `distances` may be null. */
static void assert_points(const json_t *answer, const octree_point *points, const double *distances, size_t count)
{
    const json_t *list = json_member(answer, "points");
    assert_true(real(answer, "found") == (double)count);
    assert_int_equal(json_array_size(list), count);
    for (size_t i = 0; i < count; i++) {
        const json_t *point = json_array_get(list, i);
        assert_members(point, distances ? "id position distance" : "id position");
        assert_whole_number(json_member(point, "id"), points[i].id);
        assert_place(json_member(point, "position"), points[i].position);
        assert_true(!distances || fabs(real(point, "distance") - distances[i]) <= 1e-15 * distances[i]);
    }
    assert_cost(answer);
}

static void assert_nearest(const json_t *answer, const brute *all, const double target[3], size_t k)
{
    octree_neighbor *nearest;
    octree_point points[POINTS];
    double distances[POINTS];
    const size_t count = brute_nearest_k(all, target, k, OCTREE_SKIP_NONE, 0, &nearest);
    for (size_t i = 0; i < count; i++) {
        points[i] = nearest[i].point;
        distances[i] = nearest[i].distance;
    }
    free(nearest);
    assert_points(answer, points, distances, count);
}

static void assert_ball(const json_t *answer, const brute *all, const double center[3], double radius)
{
    brute found = {0};
    brute_radius(all, center, radius, &found);
    assert_string_equal(json_string_value(json_member(answer, "query")), "radius");
    assert_place(json_member(answer, "center"), center);
    assert_nearest(answer, all, center, found.count); /* the points in the ball are the nearest ones */
    brute_free(&found);
}

static void assert_box(const json_t *answer, const brute *all, const octree_box *box)
{
    brute found = {0};
    brute_range(all, box, &found);
    if (found.count)
        qsort(found.points, found.count, sizeof *found.points, octree_compare_points);
    assert_string_equal(json_string_value(json_member(answer, "query")), "range");
    assert_points(answer, found.points, NULL, found.count);
    brute_free(&found);
}

static void random_place(uint64_t *random, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (double)random_below(random, 4 * REACH + 1) - 2 * REACH;
}

/* One query of each kind, inside the world and outside, in one command. */
static void ask_all_kinds(const place *file, const brute *all, uint64_t *random)
{
    double a[3], b[3], c[3];
    octree_box box;
    random_place(random, a);
    random_place(random, b);
    random_place(random, c);
    for (int axis = 0; axis < 3; axis++) {
        box.min[axis] = fmin(a[axis], b[axis]);
        box.max[axis] = fmax(a[axis], b[axis]);
    }
    const size_t k = 1 + random_below(random, POINTS + 3);
    const double radius = (double)random_below(random, 2 * REACH);
    command_result result = run_octreel(
        NULL,
        "inspect %s --capacity 3 --json --nearest %g,%g,%g --range=%g,%g,%g,%g,%g,%g --radius %g,%g,%g,%g --nearest "
        "%g,%g,%g,%zu",
        file->path, a[0], a[1], a[2], box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2], b[0],
        b[1], b[2], radius, c[0], c[1], c[2], k);
    assert_done(&result);
    json_t *object = json_read(result.out);
    assert_members(object, "cloud answers");
    const json_t *answers = json_member(object, "answers");
    assert_int_equal(json_array_size(answers), 4);
    assert_nearest(json_array_get(answers, 0), all, a, 1);
    assert_box(json_array_get(answers, 1), all, &box);
    assert_ball(json_array_get(answers, 2), all, b, radius);
    assert_nearest(json_array_get(answers, 3), all, c, k);
    json_decref(object);
    command_release(&result);
}

static void answers_equal_those_of_a_scan(void **state)
{
    uint64_t random = 17;
    brute all = make_points(4);
    const place file = write_points(state, "points.txt", &all);
    for (int round = 0; round < 25; round++)
        ask_all_kinds(&file, &all, &random);
    brute_free(&all);
}

static size_t count_lines(const char *text)
{
    size_t lines = 0;
    for (; *text; text++)
        lines += *text == '\n';
    return lines;
}

/* JSON lists all points. */
static void text_shows_at_most_ten_lines_of_an_answer(void **state)
{
    brute all = make_points(3);
    const place points = write_points(state, "points.txt", &all), picture = place_in(*state, "q.png"),
                nodes = place_in(*state, "n.csv");
    command_result result = run_octreel(NULL,
                                        "inspect %s --radius 0,0,0,500 --node root --capacity 1000 --size 64x36 -o %s "
                                        "--nodes %s",
                                        points.path, picture.path, nodes.path);
    assert_done(&result);
    const char *more = strstr(result.out, "\n  ... and 590 more; --json lists all\n");
    assert_non_null(more);
    assert_non_null(strstr(more + 1, "\n  ... and 590 more; --json lists all\n")); /* of the node, and of the ball */
    const size_t lines = count_lines(result.out);
    assert_true(lines >= 26 && lines <= 32);
    assert_non_null(strstr(result.out, "\nwrote "));
    assert_non_null(strstr(result.out, "q.png: 64 x 36 pixels; points by "));
    assert_non_null(strstr(result.out, "n.csv: all nodes\n"));
    command_release(&result);
    result = run_octreel(NULL, "inspect %s --radius 0,0,0,500 --json -o %s", points.path, picture.path);
    assert_done(&result);
    assert_int_equal(count_lines(result.out), 1);
    assert_null(strstr(result.out, "more"));
    assert_null(strstr(result.out, "wrote"));
    command_release(&result);
    brute_free(&all);
}

static void text_names_the_points_that_were_found(void **state)
{
    static const char *const rows[][2] = {
        {"--nearest 7.5,8,8", "nearest to 7.5 8 8: 1 found\n  1: 8 8 8  at 0.5\n  cost: "},
        {"--nearest 0,0,0,2", "2 nearest to 0 0 0: 2 found\n  0: 0 0 0  at 0\n  2: 3 0 4  at 5\n  cost: "},
        {"--radius 3,0,0,4", "radius 4 about 3 0 0: 2 found\n  0: 0 0 0  at 3\n  2: 3 0 4  at 4\n  cost: "},
        {"--range -1,-1,-1,3,3,4", "range -1 -1 -1  to  3 3 4: 2 found\n  0: 0 0 0\n  2: 3 0 4\n  cost: "},
        {"--range 4,4,4,5,5,5", ": 0 found\n  cost: "},
        {"--nearest -100,0,0", "  note: the place lies outside the world\n  0: 0 0 0  at 100\n"},
        {"--nearest 1,2,3,4", ": 3 found\n  note: the tree holds no more points\n"},
        {"--range 90,0,0,91,1,1", ": 0 found\n  note: the box lies outside the world\n  cost: "},
        {"--radius 90,0,0,1", ": 0 found\n  note: the ball lies outside the world\n  cost: "},
        {"--radius -1,0,0,1", ": 1 found\n  note: the centre lies outside the world\n  0: 0 0 0  at 1\n"},
        {"--radius 1e308,1e308,1e308,1e307", "  note: the ball lies outside the world\n"},
        {"--range -1e308,-1e308,-1e308,1e308,1e308,1e308", ": 3 found\n  0: 0 0 0\n  1: 8 8 8\n  2: 3 0 4\n"},
        {"--world 50,50,50,60,60,60 --nearest 0,0,0", ": 0 found\n  note: the tree holds no points\n"},
        {"--frustum 1,0,0,3,0,0,1,3.5", "frustum 1 0 0 <= 3, 0 0 1 <= 3.5: 1 found\n  0: 0 0 0\n  cost: "},
        {"--frustum 0,-1,0,-8", "frustum 0 -1 0 <= -8: 1 found\n  1: 8 8 8\n  cost: "},
        {"--ray -4,0,0,2,0,0", "first hit of the ray in direction 2 0 0 from -4 0 0, thickness 5: 1 found\n  "
                               "0: 0 0 0  t 0\n  cost: "},
        {"--ray -4,0,0,2,0,0,9,0.5",
         "first 9 hits of the ray in direction 2 0 0 from -4 0 0, thickness 0.5: 1 found\n  "
         "0: 0 0 0  t 1.75\n  cost: "},
        {"--ray -4,0.5,0,2,0,0,2,0",
         "first 2 hits of the ray in direction 2 0 0 from -4 0.5 0: 0 found\n  note: the ray"},
        {"--ray -4,0,0,2,0,0,2,4", " thickness 4: 2 found\n  0: 0 0 0  t 0\n  2: 3 0 4  t 1.5\n  cost: "},
        {"--ray -4,0,0,2,0,0,2,4,1.25", " thickness 4, length 1.25: 1 found\n  0: 0 0 0  t 0\n  cost: "},
        {"--ray -4,0,0,-2,0,0,1,1", ": 0 found\n  note: the ray hits no point; a thicker ray may\n  cost: "},
    };
    const place file = place_in(*state, "points.txt");
    file_write_text(file.path, "0 0 0\n8 8 8\n3 0 4\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "inspect %s %s", file.path, rows[i][0]);
        assert_done(&result);
        if (strncmp(result.out, "points.txt\n", 11) != 0 || !strstr(result.out, rows[i][1]))
            fail_msg("%s: \"%s\" is not in \"%s\"", rows[i][0], rows[i][1], result.out);
        command_release(&result);
    }
}

static void json_contains_notes_about_answers(void **state)
{
    const place file = place_in(*state, "points.txt");
    file_write_text(file.path, "0 0 0\n8 8 8\n");
    command_result result = run_octreel(NULL, "inspect %s --json --nearest 9,0,0 --nearest 1,0,0", file.path);
    assert_done(&result);
    json_t *object = json_read(result.out);
    const json_t *answers = json_member(object, "answers");
    assert_members(json_array_get(answers, 0), "query target k found points note cost");
    assert_members(json_array_get(answers, 1), "query target k found points cost");
    json_decref(object);
    command_release(&result);
}

static void json_of_a_ray_has_its_thickness_and_the_t_of_each_hit(void **state)
{
    const place file = place_in(*state, "points.txt");
    file_write_text(file.path, "0 0 0\n8 8 8\n3 0 4\n");
    command_result result =
        run_octreel(NULL, "inspect %s --json --ray -4,0,0,2,0,0,2,4 --ray 0,0,9,0,0,-1,1,1,5", file.path);
    assert_done(&result);
    json_t *object = json_read(result.out);
    const json_t *ray = json_array_get(json_member(object, "answers"), 0), *points = json_member(ray, "points");
    assert_members(ray, "query origin direction k thickness found points cost");
    assert_true(real(ray, "thickness") == 4 && json_array_size(points) == 2);
    assert_members(json_array_get(points, 1), "id position t");
    assert_true(real(json_array_get(points, 1), "t") == 1.5);
    ray = json_array_get(json_member(object, "answers"), 1);
    assert_members(ray, "query origin direction k thickness length found points note cost");
    json_decref(object);
    command_release(&result);
}

static void invalid_queries_are_refused_in_one_sentence(void **state)
{
    static const char *const rows[][2] = {
        {"--nearest 1,2", "--nearest takes a position"},
        {"--nearest 1,2,3,4,5", "--nearest takes a position"},
        {"--nearest=", "--nearest takes a position"},
        {"--nearest 1,,3", "--nearest takes a position"},
        {"--nearest 1,2,x", "--nearest takes a position, and the number of neighbours if it is not 1, as in 1,2,3 or "
                            "1,2,3,8, not \"1,2,x\""},
        {"--nearest nan,2,3", "not \"nan,2,3\""},
        {"--nearest 1,inf,3", "not \"1,inf,3\""},
        {"--nearest 1,2,1e999", "not \"1,2,1e999\""},
        {"--nearest 1,2,3,0", "a whole number from 1 to 9007199254740991; found"},
        {"--nearest 1,2,3,-2", "a whole number from 1 to 9007199254740991; found"},
        {"--nearest 1,2,3,2.5", "a whole number from 1 to 9007199254740991; found"},
        {"--nearest 1,2,3,99999999999999999999", "a whole number from 1 to 9007199254740991; found"},
        {"--nearest 1,2,3,1e300", "a whole number from 1 to 9007199254740991; found"},
        {"--frustum 1,0,0", "--frustum takes 1 to 8 half-spaces of four numbers each"},
        {"--frustum 1,0,0,1,2,3", "--frustum takes 1 to 8 half-spaces of four numbers each"},
        {"--frustum 0,0,0,1", "--frustum: a size must not be negative, nor a direction zero"},
        {"--radius 1,2,3", "--radius takes a centre and a radius"},
        {"--radius 1,2,3,4,5", "--radius takes a centre and a radius"},
        {"--radius 1,2,3,-1", "must not be negative"},
        {"--radius 1,2,3,NaN", "not \"1,2,3,NaN\""},
        {"--ray 1,2,3,4,5", "--ray takes a position, a direction"},
        {"--ray 1,2,3,4,5,6,7,8,9,10", "--ray takes a position, a direction"},
        {"--ray 1,2,3,0,0,0", "nor a direction zero in \"1,2,3,0,0,0\""},
        {"--ray 1,2,3,0,0,1,0", "the number of neighbours or hits must be a whole number from 1"},
        {"--ray 1,2,3,0,0,1,1,-1", "must not be negative"},
        {"--range 1,2,3,4,5", "--range takes two corners"},
        {"--range 1,2,3,4,5,6,7", "--range takes two corners"},
        {"--range 1,2,3,4,1,6", "the box's min is above its max in"},
        {"--range 1,2,3,4,5,nan", "not \"1,2,3,4,5,nan\""},
    };
    const place file = place_in(*state, "points.txt"), picture = place_in(*state, "tree.png");
    file_write_text(file.path, "0 0 0\n8 8 8\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result result = run_octreel(NULL, "inspect %s -o %s %s", file.path, picture.path, rows[i][0]);
        assert_trouble(&result, rows[i][1]);
        assert_false(file_exists(picture.path));
    }
}

/* A query changes the picture only if its layer is shown. */
static void queries_are_drawn_in_their_layers(void **state)
{
    static const char *const queries[] = {"nearest 9,-9,9", "nearest 9,-9,9,5", "radius 9,-9,9,20",
                                          "range 0,0,0,30,30,30", "ray -30,-30,9,1,1,0"};
    static const char *const layers[] = {"nearest", "knearest", "radius", "range", "ray"};
    enum { KINDS = sizeof layers / sizeof layers[0] };
    brute all = make_points(5);
    const place file = write_points(state, "points.txt", &all), picture = place_in(*state, "tree.png");
    for (size_t i = 0; i < 2 * KINDS; i++) {
        image frames[2];
        for (int asked = 0; asked < 2; asked++) {
            command_result result = run_octreel(
                NULL, "inspect %s -o %s --size 160x90 --layers nodes%s%s %s%s", file.path, picture.path,
                i < KINDS ? "," : "", i < KINDS ? layers[i] : "", asked ? "--" : "", asked ? queries[i % KINDS] : "");
            assert_done(&result);
            command_release(&result);
            frames[asked] = assert_read(picture.path);
        }
        const image_difference asked = image_compare(&frames[0], &frames[1]);
        assert_int_equal(image_has_no_difference(&asked), i >= KINDS);
        image_release(&frames[0]);
        image_release(&frames[1]);
    }
    brute_free(&all);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(answers_equal_those_of_a_scan),
        IN_FOLDER(text_shows_at_most_ten_lines_of_an_answer),
        IN_FOLDER(text_names_the_points_that_were_found),
        IN_FOLDER(json_contains_notes_about_answers),
        IN_FOLDER(json_of_a_ray_has_its_thickness_and_the_t_of_each_hit),
        IN_FOLDER(invalid_queries_are_refused_in_one_sentence),
        IN_FOLDER(queries_are_drawn_in_their_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
