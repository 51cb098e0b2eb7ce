/* SPDX-License-Identifier: MIT */
/* cause.c - plays two sessions side by side and compares them tick by tick. */
#include "cause.h"
#include "array.h"
#include "judgement.h"
#include "layer_type.h"
#include "octree/octree.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* The games of two sessions that are played side by side, and the state of their comparison. */
typedef struct playing {
    octree_game *games[2];
    bool same_session;    /* true: both sessions are equal, so all their ticks are equal */
    bool same_rules;      /* true: the trees have the same options, so trees with equal contents have equal digests */
    uint64_t versions[2]; /* octree_version() of each tree when the trees were last compared */
    bool unlike;          /* true: the trees differed when they were last compared */
    bool other_heat; /* true: the view shows heat, and an earlier tick differed, so the heat of this tick may differ */
    bool shows_heat;
    const cause_watcher *watcher;
    cause *found;
} playing;

static bool create_game(playing *p, int side, const octree_session *session, octreel_error *error)
{
    const octree_status status = octree_game_create(session, &p->games[side]);
    return status == OCTREE_OK || error_set(error, "the session of the %s cannot be played: %s",
                                            side ? "frames" : "reference", octree_status_text(status));
}

/* ---- One tick ------------------------------------------------------------------------------------------------ */

static bool do_tree_contents_differ(const playing *p)
{
    cause_facts facts = {0};
    if (p->same_rules)
        return octree_game_tick(p->games[0])->tree_digest != octree_game_tick(p->games[1])->tree_digest;
    cause_compare_trees(p->games[0], p->games[1], &facts);
    const bool unlike = facts.count > 0 || facts.out_of_memory;
    cause_facts_release(&facts);
    return unlike;
}

/* Return whether the trees differ. They are compared only if one of them has changed since the last call. */
static bool do_trees_differ(playing *p)
{
    const uint64_t versions[2] = {octree_version(octree_game_tree(p->games[0])),
                                  octree_version(octree_game_tree(p->games[1]))};
    if (versions[0] != p->versions[0] || versions[1] != p->versions[1])
        p->unlike = do_tree_contents_differ(p);
    p->versions[0] = versions[0];
    p->versions[1] = versions[1];
    return p->unlike;
}

/* Append the details of a tick. The appended element takes ownership of the memory of *facts. */
static bool append_tick(cause *c, uint64_t tick, cause_facts *facts)
{
    if (!array_grow(&c->ticks, c->count + 1, &c->room, sizeof *c->ticks))
        return false;
    c->ticks[c->count++] = (cause_tick){.tick = tick, .facts = *facts};
    *facts = (cause_facts){0};
    return true;
}

static void extend_span(cause_span *span, uint64_t count, uint64_t tick)
{
    if (span->count == 0)
        span->first = tick;
    span->count += count;
    span->last = tick;
}

/* The pairs that a foreign index found count as one answer. */
static size_t count_wrong_answers(const octree_tick *tick)
{
    size_t worst;
    return judgement_count_wrong(tick->answers, tick->answer_count, &worst) + (tick->foreign_pairs.wrong != 0);
}

static bool has_same_wrong_answers(const octree_tick *a, const octree_tick *b)
{
    const octree_pair_judgement *p = &a->foreign_pairs, *q = &b->foreign_pairs;
    if (p->wrong != q->wrong || p->wrong_pair.a != q->wrong_pair.a || p->wrong_pair.b != q->wrong_pair.b)
        return false;
    const size_t both = a->answer_count < b->answer_count ? a->answer_count : b->answer_count;
    for (size_t i = 0; i < both; i++) {
        const octree_judgement *x = &a->answers[i].judgement, *y = &b->answers[i].judgement;
        if (x->wrong != y->wrong || x->wrong_id != y->wrong_id)
            return false;
    }
    return true;
}

static void count_wrong_answer_changes(cause_span wrong[WRONG_CHANGES], const octree_tick *a, const octree_tick *b)
{
    const size_t before = count_wrong_answers(a), now = count_wrong_answers(b);
    if (now > before)
        extend_span(&wrong[WRONG_MORE], now - before, a->number);
    else if (now < before)
        extend_span(&wrong[WRONG_FEWER], before - now, a->number);
    else if (!has_same_wrong_answers(a, b))
        extend_span(&wrong[WRONG_OTHER], 1, a->number);
}

/* Return whether the states of the games differ, so that later ticks may differ, too. The caller has compared the
 * trees. */
static bool do_games_differ(const playing *p, bool trees_differ)
{
    const octree_tick *a = octree_game_tick(p->games[0]), *b = octree_game_tick(p->games[1]);
    return trees_differ || a->has_player != b->has_player || memcmp(a->player, b->player, sizeof a->player) != 0 ||
           a->foreign.digest != b->foreign.digest;
}

/* Compare one tick. If the tick may be reported in detail, the trees are compared node by node. Otherwise it is only
 * determined whether the trees differ. */
static bool compare_tick(playing *p, octreel_error *error)
{
    const octree_game *const games[2] = {p->games[0], p->games[1]};
    const cause_watcher *w = p->watcher;
    const uint64_t tick = octree_game_tick(games[0])->number;
    const bool wanted = w->wants && w->wants(w->context, tick), is_early = p->found->differing.count < w->first;
    const bool trees_differ = !p->same_session && do_trees_differ(p);
    cause_facts facts = {0};
    if (trees_differ && (wanted || is_early))
        cause_compare_trees(games[0], games[1], &facts);
    if (!p->same_session) {
        cause_compare_ticks(games[0], games[1], &facts);
        count_wrong_answer_changes(p->found->wrong, octree_game_tick(games[0]), octree_game_tick(games[1]));
    }
    const bool differs = trees_differ || facts.count > 0;
    const bool reported = wanted || (differs && is_early);
    if (differs)
        extend_span(&p->found->differing, 1, tick);
    if (reported && p->other_heat)
        cause_add_whole(&facts, "heat", CAUSE_OTHER, NULL, NULL);
    bool ok = cause_origins_update(&p->found->session.origins, tick, do_games_differ(p, trees_differ), p->other_heat);
    ok = ok && !facts.out_of_memory && (!reported || append_tick(p->found, tick, &facts));
    p->other_heat |= p->shows_heat && differs;
    cause_facts_release(&facts);
    p->found->compared++;
    if (!ok)
        return error_no_memory(error);
    return !w->watch || w->watch(w->context, games, differs, error);
}

/* ---- All ticks ------------------------------------------------------------------------------------------------- */

static bool advance_games(playing *p, octreel_error *error)
{
    for (int i = 0; i < 2; i++) {
        const octree_status status = octree_game_advance(p->games[i]);
        if (status != OCTREE_OK)
            return error_set(error, "tick %" PRIu64 " of the %s cannot be played: %s",
                             octree_game_tick(p->games[i])->number + 1, i ? "frames" : "reference",
                             octree_status_text(status));
    }
    return true;
}

static bool have_same_rules(const octree *a, const octree *b)
{
    const octree_def x = octree_definition(a), y = octree_definition(b);
    return memcmp(&x.world, &y.world, sizeof x.world) == 0 && x.leaf_capacity == y.leaf_capacity &&
           x.max_depth == y.max_depth && x.full_leaf == y.full_leaf;
}

/* Compare the views. A layer that is empty in both sessions draws nothing, so it is ignored in both views. A
 * recording made before such a layer existed therefore stays equal to a new recording. */
static void compare_views(const octree_session *a, const octree_session *b, const cause_view views[2],
                          bool same_session, cause_facts *facts)
{
    cause_view shown[2] = {views[0], views[1]};
    for (int i = 0; i < LAYER_COUNT; i++) {
        bool (*const in_session)(const octree_session *) = layer_types[i]->in_session;
        if (in_session && !in_session(a) && !in_session(b)) {
            shown[0].view.layers &= ~(1u << i);
            shown[1].view.layers &= ~(1u << i);
        }
    }
    cause_compare_views(&shown[0], &shown[1], same_session, facts);
}

bool cause_find(const session_file *a, const session_file *b, const cause_view views[2], const cause_watcher *watcher,
                cause *c, octreel_error *error)
{
    playing p = {.versions = {UINT64_MAX, UINT64_MAX}, .watcher = watcher, .found = c};
    *c = (cause){.drawn = CAUSE_NO_TICK};
    cause_compare_sessions(a, b, &c->session);
    p.same_session = c->session.count == 0;
    if (views)
        compare_views(&a->session, &b->session, views, p.same_session, &c->view);
    p.shows_heat = views && ((views[0].view.layers | views[1].view.layers) & VIEW_HEAT_LAYERS);
    bool ok = (!c->session.out_of_memory && !c->view.out_of_memory) || error_no_memory(error);
    ok = ok && create_game(&p, 0, &a->session, error) && create_game(&p, 1, &b->session, error);
    p.same_rules = ok && have_same_rules(octree_game_tree(p.games[0]), octree_game_tree(p.games[1]));
    for (bool over = false; ok && !over;) {
        ok = compare_tick(&p, error);
        over = octree_game_over(p.games[0]) || octree_game_over(p.games[1]);
        ok = ok && (over || advance_games(&p, error));
    }
    octree_game_destroy(p.games[0]);
    octree_game_destroy(p.games[1]);
    return ok;
}

void cause_release(cause *c)
{
    for (size_t i = 0; i < c->count; i++) {
        cause_facts_release(&c->ticks[i].facts);
        free(c->ticks[i].trace.parts);
    }
    free(c->ticks);
    cause_facts_release(&c->session);
    cause_facts_release(&c->view);
    *c = (cause){0};
}

const cause_tick *cause_find_tick(const cause *c, uint64_t tick)
{
    return c->count ? bsearch(&tick, c->ticks, c->count, sizeof *c->ticks, compare_uint64) : NULL;
}
