/* SPDX-License-Identifier: MIT */
/* neighbors.c - see neighbors.h. */
#include "neighbors.h"

#include <math.h>

#include "quick_oracle.h"
#include "must.h"

void ask_all(void *contestant)
{
    const asking *a = contestant;
    octree_neighbor found[TRUE_NEIGHBORS];
    size_t count;
    for (size_t i = 0; i < a->load->target_count; i++)
        must(octree_nearest_k(a->tree, a->load->targets[i], a->k, &a->how, found, &count));
}

double promised_excess(const octree_search *how)
{
    return how->mode == OCTREE_FAST ? how->epsilon + 0x1p-50 * (1 + how->epsilon) : how->epsilon;
}

/* In FAST mode a distance may also be longer by a length. */
static bool is_within_promise(const octree_search *how, const octree_box *world, const double target[3],
                              const double found[3], const double truth[3])
{
    const double extent = world->max[0] / 2 - world->min[0] / 2; /* half of it: to be strict */
    return quick_compare_ratio(target, found, truth, promised_excess(how)) <= 0 ||
           (how->mode == OCTREE_FAST && quick_compare_longer(target, found, truth, extent * 0x1p-490) <= 0);
}

static long double squared_distance(const double a[3], const double b[3])
{
    const long double x = (long double)a[0] - b[0], y = (long double)a[1] - b[1], z = (long double)a[2] - b[2];
    return x * x + y * y + z * z;
}

double excess_of(const octree_search *how, const octree_box *world, const double target[3], const double found[3],
                 const double truth[3])
{
    const int order = quick_compare(target, found, truth);
    const double promised = promised_excess(how);
    if (order <= 0)
        return 0;
    const long double a = squared_distance(target, found), b = squared_distance(target, truth);
    const double excess = b > 0 ? (double)((a - b) / (b * (1 + sqrtl(a / b)))) : INFINITY;
    if (is_within_promise(how, world, target, found, truth))
        return fmin(excess, promised);
    return fmax(excess, nextafter(promised, INFINITY));
}

static size_t count_recalled(const octree_neighbor *found, const octree_point *const *truth, size_t k)
{
    size_t recalled = 0;
    for (size_t i = 0; i < k; i++)
        for (size_t j = 0; j < k; j++)
            recalled += found[i].point.id == truth[j]->id;
    return recalled;
}

findings judge_answers(const asking *a)
{
    const true_neighbors *truth = workload_truth(a->load);
    findings f = {.asked = a->load->target_count};
    octree_search how = a->how;
    how.cost = &f.cost;
    size_t recalled = 0;
    for (size_t i = 0; i < f.asked; i++) {
        octree_neighbor found[TRUE_NEIGHBORS];
        size_t count;
        must(octree_nearest_k(a->tree, a->load->targets[i], a->k, &how, found, &count));
        if (count != a->k)
            stop_with_error("%s: %zu of %zu neighbours were found", a->load->name, count, a->k);
        f.wrong += found[0].point.id != truth[i][0]->id;
        recalled += count_recalled(found, truth[i], a->k);
        for (size_t j = 0; j < a->k; j++) {
            const double excess = excess_of(&a->how, &a->load->world, a->load->targets[i], found[j].point.position,
                                            truth[i][j]->position);
            f.worst = fmax(f.worst, excess);
            f.mean += excess / (double)(f.asked * a->k);
        }
    }
    f.recall = (double)recalled / (double)(f.asked * a->k);
    return f;
}
