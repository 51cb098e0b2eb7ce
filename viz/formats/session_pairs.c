/* SPDX-License-Identifier: MIT */
/* session_pairs.c - reads and writes the pairs that a foreign index found at a tick. */
#include "session_members.h"

#include <inttypes.h>
#include <stdlib.h>

static bool read_pair(json_reader *r, json_t *value, const json_place *at, void *into)
{
    octree_pair *pair = (octree_pair *)into + at->index;
    if (json_array_size(value) != 2)
        return json_fail_expected(r, value, at, "two ids [a, b]");
    return json_read_id(r, value, at, 0, &pair->a) && json_read_id(r, value, at, 1, &pair->b) &&
           (pair->a != pair->b ||
            json_fail(r, at, "a pair must consist of two different ids, not twice %" PRIu64, pair->a));
}

static bool read_found_pairs(json_reader *r, json_t *value, const json_place *at, void *into)
{
    session_loader *s = r->context;
    const size_t count = json_array_size(value);
    octree_foreign_pairs *found = session_append_item(r, at, &s->lists[SESSION_PAIRS], sizeof *found);
    (void)into;
    if (!found)
        return false;
    octree_pair *pairs = count ? calloc(count, sizeof *pairs) : NULL;
    *found = (octree_foreign_pairs){.tick = s->tick, .pairs = pairs, .pair_count = pairs ? count : 0};
    if (count && !pairs)
        return json_fail(r, at, "out of memory for %zu pairs", count);
    return json_read_elements(r, value, at, "a list of pairs of ids, such as [[1, 2], [3, 4]]", read_pair, pairs);
}

static void write_found_pairs(json_writer *w, const void *from)
{
    const octree_foreign_pairs *found = *(const octree_foreign_pairs *const *)from;
    json_write_begin_array(w);
    for (size_t i = 0; i < found->pair_count; i++)
        json_ids.write(w, &(json_counted_array){&found->pairs[i], 2});
    json_write_end_array(w);
}

const json_codec session_pairs_codec = {read_found_pairs, write_found_pairs};
