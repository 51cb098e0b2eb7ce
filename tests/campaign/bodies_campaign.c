/* SPDX-License-Identifier: MIT */
/* bodies_campaign.c - random changes and queries of sets of bodies. Each change is also made of a list, and each answer
 * is compared with rational numbers.
 *
 * The program is one test of cmocka, which ends at the first difference. */
#include "fixture.h"

#include <getopt.h>
#include <stdio.h>

#include "body_asks.h"
#include "body_model.h"
#include "octree/sample.h"
#include "program.h"

const char program_name[] = "octree-bodies-campaign";

/* A set is cleared when it has this many bodies, because rational numbers are slow. */
enum { MOST_BODIES = 60, OPERATIONS_OF_A_SET = 500 };

static struct {
    uint64_t seed, operations;
    uint64_t done, sets;
} campaign = {.seed = 1, .operations = 10000};

static void replace_all(octree_bodies *set, body_model *m)
{
    m->count /= 2;
    assert_int_equal(octree_bodies_replace_all(set, m->bodies, m->count, NULL, NULL), OCTREE_OK);
}

static void clear(octree_bodies *set, body_model *m)
{
    m->count = 0;
    assert_int_equal(octree_bodies_clear(set), OCTREE_OK);
}

static void change(body_scene *s, body_model *m)
{
    const uint64_t kind = random_below(&s->seed, 200);
    if (kind == 0 || m->count > MOST_BODIES)
        clear(s->set, m);
    else if (kind == 1)
        replace_all(s->set, m);
    else if (kind < 5)
        body_model_compact(s->set, m);
    else if (kind < 10)
        body_model_assert_same(s->set, m);
    else if (kind < 30)
        body_model_change_many(s->set, m, s->numbers, &s->seed);
    else
        body_model_change_one(s->set, m, s->numbers, &s->seed);
    s->count = m->count;
}

static void ask(body_scene *s)
{
    const uint64_t kind = random_below(&s->seed, 40);
    if (kind == 0)
        body_scene_assert_pairs(s);
    else if (kind < 10)
        body_scene_assert_nearest(s);
    else if (kind < 20)
        body_scene_assert_cast(s, OCTREE_REGION_RAY);
    else if (kind < 30)
        body_scene_assert_cast(s, OCTREE_REGION_SWEPT);
    else
        body_scene_assert_regions(s, 1);
    campaign.done += kind >= 30 ? OCTREE_REGION_KINDS - 1 : 0;
}

static void check_set(uint64_t seed)
{
    static body_model m;
    body_scene s = {.numbers = (scene_numbers)(campaign.sets % NUMBERS_KINDS), .seed = seed, .bodies = m.bodies};
    m.count = 0;
    const uint64_t capacity = 1 + random_below(&s.seed, 40), depth = random_below(&s.seed, 22);
    const octree_def def = define(scene_world(s.numbers), capacity, depth, OCTREE_GROW);
    assert_int_equal(octree_bodies_create(&def, &s.set), OCTREE_OK);
    for (int i = 0; i < OPERATIONS_OF_A_SET && campaign.done < campaign.operations; i++, campaign.done++)
        if (random_below(&s.seed, 2))
            change(&s, &m);
        else
            ask(&s);
    body_model_assert_same(s.set, &m);
    octree_bodies_destroy(s.set);
    campaign.sets++;
}

static void read_options(int argc, char **argv)
{
    static const struct option known[] = {{"seed", required_argument, NULL, 's'},
                                          {"operations", required_argument, NULL, 'n'},
                                          {"help", no_argument, NULL, 'h'},
                                          {NULL, 0, NULL, 0}};
    for (int option; (option = getopt_long(argc, argv, "h", known, NULL)) >= 0;)
        switch (option) {
        case 's':
            campaign.seed = (uint64_t)parse_whole_number("--seed", optarg, 0, 0x1p53 - 1);
            break;
        case 'n':
            campaign.operations = (uint64_t)parse_whole_number("--operations", optarg, 1, 1e12);
            break;
        case 'h':
            puts("usage: octree-bodies-campaign [--seed N] [--operations N]\n\n"
                 "Change sets of bodies at random and ask them (10,000 operations). Each result is compared with\n"
                 "a list and with rational numbers. Exit status: 0 all are right, 1 one is wrong, 2 trouble.");
            exit(EXIT_DONE);
        default:
            stop_with_error("unknown option; --help lists all");
        }
}

static void every_result_is_that_of_a_list(void **state)
{
    (void)state;
    uint64_t seed = campaign.seed;
    while (campaign.done < campaign.operations)
        check_set(octree_random(&seed));
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_result_is_that_of_a_list)};
    read_options(argc, argv);
    const bool failed = cmocka_run_group_tests(tests, NULL, NULL) != 0;
    printf("%llu operations of --seed %llu on %llu sets of bodies: %s\n", (unsigned long long)campaign.done,
           (unsigned long long)campaign.seed, (unsigned long long)campaign.sets + failed,
           failed ? "the last one failed" : "all right");
    return failed ? EXIT_FINDING : EXIT_DONE;
}
