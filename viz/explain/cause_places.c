/* SPDX-License-Identifier: MIT */
/* cause_places.c - the table of places in which recordings can differ. Each row states how the values at its place
 * are compared, and the noun and verbs with which differences are printed. */
#include "cause_places.h"
#include "view_options.h"

#include <string.h>

#define PLAIN .option = false
#define OPTION .option = true
#define EVERY .every = true
#define MINOR .minor = true
#define BY_KEY .rule = CAUSE_BY_KEY
#define VERB_OTHER .verbs[CAUSE_OTHER]
#define VERB_MORE .verbs[CAUSE_MORE]
#define VERB_LESS .verbs[CAUSE_LESS]
#define WHOLE .rule = CAUSE_WHOLE

/* How values at each place are compared, and what the place is called. For a place that is not in the table, the type
 * of the values decides how they are compared, and the place's path is printed. */
static const cause_row rows[] = {
    /* places in sessions */
    {"world", "world", OPTION},
    {"tree.capacity", "leaf capacity", OPTION},
    {"tree.depth", "depth", OPTION},
    {"tree.full", "rule for full leaves", OPTION},
    {"player.kind", "kind of player", OPTION},
    {"player.id", "player's id", OPTION},
    {"player.position", "start of the player", OPTION},
    {"player.step", "step of the player", OPTION},
    {"player.box_size", "collision box", OPTION},
    {"player.sweep", "swept collision test", OPTION},
    {"session.pairs", "detection of overlaps", OPTION},
    {"session.foreign_pairs", "foreign pair", .plural = "foreign pairs"},
    {"ticks", "last tick", PLAIN},
    {"keys", "key", PLAIN},
    {"points", "initial point", .plural = "initial points"},
    {"points.velocity", "velocity of a point", .plural = "velocities of points"},
    {"points.half", "half extent of a body", .plural = "half extents of bodies"},
    {"points.color", "colour of a point", .plural = "colours of points"},
    {"points.intensity", "intensity of a point", .plural = "intensities of points"},
    {"points.class", "class of a point", .plural = "classes of points"},
    {"sampled.points", "sample of points", OPTION},
    {"sampled.points.sample", "kind of sample", OPTION},
    {"sampled.points.count", "number of points in the sample", OPTION},
    {"sampled.points.seed", "seed of the points", OPTION},
    {"sampled.velocities", "sample of velocities", OPTION},
    {"sampled.velocities.speed", "length of the velocities", OPTION},
    {"sampled.velocities.seed", "seed of the velocities", OPTION},
    {"edits", "edit", BY_KEY},
    {"queries", "query", .plural = "queries", EVERY, .rule = CAUSE_QUERIES},
    {"queries.visits", "query", .plural = "queries", VERB_OTHER = "visited other nodes"},
    {"queries.answer", "foreign answer", .plural = "foreign answers", VERB_OTHER = "changed"},
    {"shapes", "shape shown", .plural = "shapes shown", EVERY},
    {"foreign_nodes", "foreign node", PLAIN},
    /* places in views; the nouns of view options are in view_options.c */
    {"every", "interval of frames", PLAIN},
    {"focus", "box around the points", PLAIN},
    {"point_scale", "scale of points", PLAIN},
    /* Places in trees. The verb is "divided": one tree has an inner node where the other has a leaf. "Split" would
     * mean that the node split at this very tick. */
    {"nodes.split", "node", VERB_MORE = "divided only in the frames"},
    {"nodes.merged", "node", VERB_MORE = "divided only in the reference"},
    {"nodes.born", "node", VERB_MORE = "only in the frames"},
    {"nodes.gone", "node", VERB_MORE = "only in the reference"},
    {"tree.points", "point", VERB_OTHER = "moved", VERB_MORE = "added", VERB_LESS = "removed"},
    /* places in ticks */
    {"player", "place of the player", PLAIN},
    {"key", "key", MINOR},
    {"from", "start of the player's step", MINOR},
    {"attempt", "position that the player attempted", MINOR},
    {"hit_from", "path of a point that the player hit", .plural = "paths of points that the player hit", MINOR},
    {"events", "event", MINOR},
    {"hits", "hit of the player", .plural = "hits of the player", BY_KEY},
    {"pairs", "overlap of two bodies", .plural = "overlaps of two bodies"},
    {"pairs.count", "number of overlaps", PLAIN},
    {"pairs.digest", "digest of the overlaps", MINOR},
    {"foreign_pairs", "judgement of the foreign pairs", MINOR},
    {"foreign_pairs.given", "foreign pair", .plural = "foreign pairs"},
    {"foreign_pairs.wrong", "judgement of the foreign pairs", PLAIN},
    {"foreign_pairs.wrong_pair", "wrong pair", MINOR},
    {"foreign_pairs.expected", "number of exact pairs", MINOR},
    {"foreign_pairs.missing", "missing pair", MINOR},
    {"foreign_pairs.extra", "extra pair", MINOR},
    {"answers", "query", .plural = "queries", .rule = CAUSE_ANSWERS},
    {"answers.ids", "hit", BY_KEY},
    {"answers.half_spaces", "half-space", PLAIN},
    {"answers.neighbors", "neighbour", PLAIN},
    {"answers.id", "nearest point", PLAIN},
    {"answers.position", "position of the nearest point", MINOR},
    {"answers.distance", "distance of the nearest point", MINOR},
    {"answers.cost", "cost", MINOR, WHOLE},
    {"answers.judged.answer", "foreign answer", .plural = "foreign answers"},
    {"answers.judged.wrong", "judgement of the foreign answer", .plural = "judgements of the foreign answers"},
    {"answers.judged.wrong_id", "wrong id", MINOR},
    {"answers.judged.missing", "missing point", MINOR},
    {"answers.judged.extra", "extra point", MINOR},
    {"answers.judged.rank", "first wrong rank", MINOR},
    {"answers.judged.ratio", "ratio of distances", .plural = "ratios of distances", MINOR},
    {"foreign_nodes.count", "number of foreign nodes", MINOR},
    {"foreign_nodes.leaves", "number of foreign leaves", MINOR},
    {"foreign_nodes.depth", "depth of the foreign nodes", MINOR},
    {"foreign_nodes.digest", "digest of the foreign nodes", MINOR},
    {"foreign_nodes.visited", "number of foreign nodes visited", MINOR},
    {"foreign_nodes.pruned", "number of nodes that the foreign index pruned", MINOR},
    {"foreign_nodes.hit", "number of foreign nodes hit", MINOR},
    {"foreign_nodes.wrong.count", "number of wrong foreign nodes", MINOR},
    {"foreign_nodes.wrong.first", "wrong foreign node", .plural = "wrong foreign nodes"},
    {"refusals", "refusal", PLAIN},
    {"splits", "node", VERB_MORE = "split at this tick", VERB_LESS = "not split at this tick", MINOR},
    {"merges", "node", VERB_MORE = "merged at this tick", VERB_LESS = "not merged at this tick", MINOR},
    {"hit_cost", "cost of the collision test", MINOR, WHOLE},
    {"visits", "number of visited nodes", MINOR, WHOLE},
    {"visited", "list of visited nodes", MINOR},
    {"heat", "visit counts of earlier ticks", MINOR},
};

static const cause_row *find_row(const char *where)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(rows[i].where, where) == 0)
            return &rows[i];
    return NULL;
}

cause_rule cause_rule_of(const char *where)
{
    const cause_row *row = find_row(where);
    return row ? row->rule : CAUSE_BY_TYPE;
}

/* A place without a row of its own is minor if it is a member of an answer (positions, distances) or a count of
 * wrong foreign nodes. */
cause_row cause_row_of(const cause_group *group)
{
    const cause_row *row = find_row(group->where);
    if (row)
        return *row;
    for (size_t i = 0; view_option_at(i); i++) {
        const view_option *option = view_option_at(i);
        if (option->noun && option->member.name && strcmp(option->member.name, group->where) == 0)
            return (cause_row){.where = group->where, .noun = option->noun};
    }
    const char *last = strrchr(group->where, '.');
    const bool minor = *group->query || strncmp(group->where, "foreign_nodes.wrong.", 20) == 0;
    return (cause_row){.where = group->where, .noun = last && minor ? last + 1 : group->where, .minor = minor};
}
