/* SPDX-License-Identifier: MIT */
/* about.c - checks the queries, shapes, foreign nodes and foreign pairs of a tick: see about.h. */
#include "about.h"
#include "octree/octree.h"
#include "session_file.h"
#include "status.h"

#include <math.h>

/* Returns why a query cannot be recorded, or null if the query can be recorded. A tree accepts infinite boxes and all
 * 64-bit ids, but JSON, the format of the recorder's files, cannot hold infinities or ids of 2^53 and more. */
static const char *find_query_error(const octree_query *query, octree_player_kind player)
{
    const octree_input one = {.queries = query, .query_count = 1};
    octree_status status = octree_input_check(&one);
    const octree_query_traits *kind = octree_query_about(query->kind);
    for (int i = 0; status == OCTREE_OK && kind->members & OCTREE_QUERY_HAS_BOX && i < 3; i++)
        if (!isfinite(query->box.min[i]) || !isfinite(query->box.max[i]))
            status = OCTREE_NOT_FINITE;
    if (status == OCTREE_OK && query->skip == OCTREE_SKIP_ID && query->skip_id >= SESSION_ID_LIMIT)
        return octreel_status_text(OCTREEL_BAD_ID);
    for (size_t i = 0; status == OCTREE_OK && query->answered && i < query->answer_count; i++)
        if (query->answer[i] >= SESSION_ID_LIMIT)
            return octreel_status_text(OCTREEL_BAD_ID);
    if (status == OCTREE_OK && query->at_player && player == OCTREE_PLAYER_NONE)
        return "at_player is set, but the recorder has no player";
    if (status == OCTREE_BAD_OPTION)
        return "unknown kind or unknown skip, or a query without a target has OCTREE_SKIP_COINCIDENT";
    return status == OCTREE_OK ? NULL : octree_status_text(status);
}

static octreel_status check_pairs(const octree_foreign_pairs *found, octreel_error *error)
{
    if (!found->pairs && found->pair_count)
        return status_fail(error, OCTREEL_NULL_ARGUMENT);
    for (size_t i = 0; i < found->pair_count; i++) {
        const octree_pair *pair = &found->pairs[i];
        const octreel_status status = pair->a == pair->b                                           ? OCTREEL_BAD_PAIR
                                      : pair->a >= SESSION_ID_LIMIT || pair->b >= SESSION_ID_LIMIT ? OCTREEL_BAD_ID
                                                                                                   : OCTREEL_OK;
        if (status != OCTREEL_OK)
            return status_refuse(error, status, "pairs[%zu]: %s", i, octreel_status_text(status));
    }
    return OCTREEL_OK;
}

/* Check the queries and shapes one by one, so that the error can name the first invalid query or shape. */
octreel_status tick_info_check(const octreel_tick_info *about, octree_player_kind player, octreel_error *error)
{
    if (!about)
        return OCTREEL_OK;
    if ((!about->queries && about->query_count) || (!about->shapes && about->shape_count))
        return status_fail(error, OCTREEL_NULL_ARGUMENT);
    for (size_t i = 0; i < about->query_count; i++) {
        const char *why = find_query_error(&about->queries[i], player);
        if (why)
            return status_refuse(error, OCTREEL_BAD_QUERY, "queries[%zu]: %s", i, why);
    }
    for (size_t i = 0; i < about->shape_count; i++) {
        const octree_input one = {.shapes = &about->shapes[i], .shape_count = 1};
        const octree_status status = octree_input_check(&one);
        if (status != OCTREE_OK)
            return status_refuse(error, OCTREEL_BAD_SHAPE, "shapes[%zu]: %s", i, octree_status_text(status));
    }
    return about->foreign_pairs ? check_pairs(about->foreign_pairs, error) : OCTREEL_OK;
}

/* Check the foreign nodes, and that their ids are below SESSION_ID_LIMIT, because larger ids do not fit into the
 * recorder's files. */
octreel_status tick_info_check_nodes(const octreel_tick_info *about, octreel_error *error)
{
    size_t place = 0;
    const octree_foreign_tree *tree = about ? about->foreign : NULL;
    const octree_status status = tree ? octree_foreign_check(tree, &place) : OCTREE_OK;
    if (status == OCTREE_NO_MEMORY)
        return status_fail(error, OCTREEL_NO_MEMORY);
    if (status != OCTREE_OK)
        return status_refuse(error, OCTREEL_BAD_NODE, "nodes[%zu]: %s", place, octree_status_text(status));
    for (size_t i = 0; tree && i < tree->node_count; i++)
        for (size_t j = 0; j < tree->nodes[i].points.count; j++)
            if (tree->nodes[i].points.ids[j] >= SESSION_ID_LIMIT)
                return status_refuse(error, OCTREEL_BAD_NODE, "nodes[%zu]: %s", i, octreel_status_text(OCTREEL_BAD_ID));
    return OCTREEL_OK;
}
