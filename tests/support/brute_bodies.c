/* SPDX-License-Identifier: MIT */
#include "brute_bodies.h"

#include <math.h>
#include <stdlib.h>

#include "fixture.h"

void brute_bodies_free(brute_bodies *all)
{
    free(all->items);
    *all = (brute_bodies){0};
}

void brute_bodies_add(brute_bodies *all, const octree_body *body)
{
    if (all->count == all->room) {
        all->room = all->room ? 2 * all->room : 64;
        all->items = realloc(all->items, all->room * sizeof *all->items);
        assert_non_null(all->items);
    }
    all->items[all->count++] = *body;
}

octree_body *brute_bodies_find(const brute_bodies *all, uint64_t id)
{
    for (size_t i = 0; i < all->count; i++)
        if (all->items[i].id == id)
            return &all->items[i];
    return NULL;
}

void brute_bodies_remove(brute_bodies *all, uint64_t id)
{
    octree_body *body = brute_bodies_find(all, id);
    if (body)
        *body = all->items[--all->count];
}

bool brute_bodies_overlap(const octree_body *a, const octree_body *b)
{
    for (int i = 0; i < 3; i++)
        if (fabs(a->position[i] - b->position[i]) > a->half[i] + b->half[i])
            return false;
    return true;
}

bool brute_body_meets_box(const octree_body *body, const octree_box *box)
{
    for (int i = 0; i < 3; i++)
        if (body->position[i] + body->half[i] < box->min[i] || body->position[i] - body->half[i] > box->max[i])
            return false;
    return true;
}

double brute_body_square(const octree_body *body, const double target[3])
{
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const double gap = fmax(fabs(body->position[i] - target[i]) - body->half[i], 0);
        square += gap * gap;
    }
    return square;
}

static bool is_nearer(const octree_body *a, const octree_body *b, const double target[3])
{
    const double square_a = brute_body_square(a, target), square_b = brute_body_square(b, target);
    return square_a < square_b || (square_a == square_b && a->id < b->id);
}

/* An insertion sort that keeps the first k. */
void brute_bodies_nearest(const brute_bodies *all, const double target[3], size_t k, uint64_t skip_id,
                          brute_bodies *nearest)
{
    for (size_t i = 0; i < all->count; i++) {
        if (all->items[i].id == skip_id)
            continue;
        brute_bodies_add(nearest, &all->items[i]);
        for (size_t at = nearest->count - 1; at > 0; at--) {
            octree_body *pair = &nearest->items[at - 1], farther = pair[0];
            if (!is_nearer(&pair[1], &pair[0], target))
                break;
            pair[0] = pair[1];
            pair[1] = farther;
        }
        nearest->count -= nearest->count > k;
    }
}
