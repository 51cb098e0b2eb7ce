/* SPDX-License-Identifier: MIT */
/* library_digests.c - prints digests of trees, answers and games: lines that must be the same for every compiler and
 * operating system. tests/lib/builds_for_windows compares those of a program for Windows with those of this machine.
 * It uses nothing but the library and standard C. */
#include "octree/digest.h"
#include "octree/game.h"
#include "octree/octree.h"
#include "octree/sample.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 20000, QUERIES = 200 };

static void require(octree_status status, const char *call)
{
    if (status == OCTREE_OK)
        return;
    fprintf(stderr, "library_digests: %s: %s\n", call, octree_status_text(status));
    exit(2);
}

static void require_valid(const octree *tree)
{
    const char *broken = octree_check(tree, NULL);
    if (!broken)
        return;
    fprintf(stderr, "library_digests: %s\n", broken);
    exit(1);
}

static uint64_t add_answer(uint64_t digest, const octree *tree, const octree_query *query)
{
    octree_answer answer;
    require(octree_query_answer(tree, query, NULL, NULL, &answer), "octree_query_answer");
    const bool neighbors = octree_query_about(query->kind)->neighbors;
    for (size_t i = 0; i < answer.count; i++) {
        digest = octree_digest_word(digest, neighbors ? answer.neighbors[i].point.id : answer.points[i].id);
        if (neighbors)
            digest = octree_digest_double(digest, answer.neighbors[i].distance);
    }
    octree_answer_release(tree, &answer);
    return digest;
}

/* Ask queries of the kinds without direction around targets inside and outside the world. */
static uint64_t digest_answers(const octree *tree, uint64_t seed)
{
    uint64_t digest = OCTREE_DIGEST_START;
    for (int i = 0; i < QUERIES; i++) {
        octree_query query = {.kind = (octree_query_kind)(i % OCTREE_QUERY_RAY), .k = 9, .radius = 120};
        for (int axis = 0; axis < 3; axis++) {
            query.target[axis] = 2400 * octree_random_unit(&seed) - 1200;
            query.box.min[axis] = query.target[axis] - 90;
            query.box.max[axis] = query.target[axis] + 90;
        }
        digest = add_answer(digest, tree, &query);
    }
    return digest;
}

static void print_tree(const char *name, const char *step, const octree *tree)
{
    require_valid(tree);
    printf("%s, %s: %zu points, tree %016" PRIx64 ", answers %016" PRIx64 "\n", name, step, octree_count(tree),
           octree_digest(tree), digest_answers(tree, 7));
}

static void print_sample(octree_sample_kind kind, double (*positions)[3])
{
    octree *tree;
    const octree_def def = octree_def_default();
    require(octree_create(&def, &tree), "octree_create");
    require(octree_sample(kind, 3, &def.world, POINTS, positions), "octree_sample");
    for (size_t i = 0; i < POINTS; i++)
        require(octree_insert(tree, positions[i], i), "octree_insert");
    print_tree(octree_sample_name(kind), "inserted", tree);
    for (size_t i = 0; i < POINTS; i += 2)
        require(octree_move(tree, positions[i], i, positions[(i + 1) % POINTS]), "octree_move");
    for (size_t i = 1; i < POINTS; i += 3)
        if (i % 2 == 1)
            require(octree_remove(tree, positions[i], i), "octree_remove");
    print_tree(octree_sample_name(kind), "moved and removed", tree);
    octree_destroy(tree);
}

static void print_game(void)
{
    const octree_session session = octree_session_default();
    octree_game *game;
    uint64_t digest = OCTREE_DIGEST_START;
    require(octree_game_create(&session, &game), "octree_game_create");
    while (!octree_game_over(game)) {
        const octree_tick *tick = octree_game_tick(game);
        digest = octree_digest_word(digest, octree_digest(octree_game_tree(game)));
        digest = octree_digest_word(digest, tick->hit_count);
        for (size_t i = 0; i < tick->hit_count; i++)
            digest = octree_digest_word(digest, tick->hits[i].id);
        require(octree_game_advance(game), "octree_game_advance");
    }
    printf("the example game: %016" PRIx64 "\n", digest);
    octree_game_destroy(game);
}

int main(void)
{
    double(*positions)[3] = malloc(POINTS * sizeof *positions);
    if (!positions)
        return 2;
    for (int kind = 0; kind < OCTREE_SAMPLE_KINDS; kind++)
        print_sample((octree_sample_kind)kind, positions);
    print_game();
    free(positions);
    return 0;
}
