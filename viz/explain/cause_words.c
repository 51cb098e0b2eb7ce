/* cause_words.c - see cause_words.h. */
#include "cause_words.h"
#include "text.h"

#include <inttypes.h>
#include <string.h>

/* ---- One fact ------------------------------------------------------------------------------------------------ */

/* "8, was 4" */
static void print_change(FILE *out, const cause_fact *fact)
{
    cause_print_value(out, &fact->b);
    fputs(", was ", out);
    cause_print_value(out, &fact->a);
}

typedef void print_fact(FILE *out, const cause_fact *fact);

static void print_option(FILE *out, const cause_fact *fact)
{
    fprintf(out, "another %s (", fact->name);
    print_change(out, fact);
    fputc(')', out);
}

static void print_length(FILE *out, const cause_fact *fact)
{
    fputs("another last tick (", out);
    print_change(out, fact);
    fputc(')', out);
}

static void print_start(FILE *out, const cause_fact *fact)
{
    static const char *const words[CAUSE_KINDS] = {
        [CAUSE_START_MORE] = "one more point at the start",
        [CAUSE_START_LESS] = "one point fewer at the start",
        [CAUSE_START_MOVED] = "another start of a point",
        [CAUSE_VELOCITY] = "another velocity of a point",
    };
    fprintf(out, "%s (point %" PRIu64, words[fact->kind], fact->id);
    if (fact->kind == CAUSE_START_MOVED || fact->kind == CAUSE_VELOCITY) {
        fputs(": ", out);
        print_change(out, fact);
    } else {
        fputs(" at ", out);
        cause_print_value(out, fact->kind == CAUSE_START_MORE ? &fact->b : &fact->a);
    }
    fputc(')', out);
}

static void print_key(FILE *out, const cause_fact *fact)
{
    fprintf(out, "another key at tick %" PRIu64 " (", fact->tick);
    print_change(out, fact);
    fputc(')', out);
}

static void print_deed(FILE *out, const cause_fact *fact, const cause_value *place)
{
    fprintf(out, "point %" PRIu64 " %s", fact->id,
            strcmp(fact->name, "insert") == 0 ? "inserted at "
            : strcmp(fact->name, "move") == 0 ? "moved to "
                                              : "removed");
    cause_print_value(out, place);
}

static void print_edit(FILE *out, const cause_fact *fact)
{
    const bool less = fact->kind == CAUSE_EDIT_LESS;
    fprintf(out, "%s at tick %" PRIu64 " (", less ? "one edit fewer" : "one more edit", fact->tick);
    print_deed(out, fact, less ? &fact->a : &fact->b);
    fputc(')', out);
}

static void print_other_edit(FILE *out, const cause_fact *fact)
{
    fprintf(out, "another edit at tick %" PRIu64 " (", fact->tick);
    if (fact->kind == CAUSE_EDIT_SPEED) {
        fprintf(out, "point %" PRIu64 " inserted with velocity ", fact->id);
        cause_print_value(out, &fact->b);
    } else {
        print_deed(out, fact, &fact->b);
    }
    fputs(", was ", out);
    cause_print_value(out, &fact->a);
    fputc(')', out);
}

static void print_order(FILE *out, const cause_fact *fact)
{
    if (fact->kind == CAUSE_START_ORDER) {
        fputs("another order of the points at the start", out);
        return;
    }
    fprintf(out, "another order of the edits of tick %" PRIu64, fact->tick);
}

static void print_when(FILE *out, const cause_fact *fact)
{
    if (fact->tick == CAUSE_NO_TICK)
        fputs(" at every tick", out);
    else
        fprintf(out, " at tick %" PRIu64, fact->tick);
}

static void print_query(FILE *out, const cause_fact *fact)
{
    fprintf(out,
            fact->kind == CAUSE_QUERY_MORE   ? "one more %s query"
            : fact->kind == CAUSE_QUERY_LESS ? "one %s query fewer"
                                             : "another %s query",
            fact->name);
    print_when(out, fact);
}

/* What a label says is quoted. */
static void print_shape_value(FILE *out, const cause_value *value)
{
    const char *quote = value->type == VALUE_WORD ? "\"" : "";
    fputs(quote, out);
    cause_print_value(out, value);
    fputs(quote, out);
}

static void print_shape(FILE *out, const cause_fact *fact)
{
    fprintf(out,
            fact->kind == CAUSE_SHAPE_MORE   ? "one more %s shown"
            : fact->kind == CAUSE_SHAPE_LESS ? "one %s fewer shown"
                                             : "another %s shown",
            fact->name);
    print_when(out, fact);
    fputs(" (", out);
    print_shape_value(out, fact->kind == CAUSE_SHAPE_LESS ? &fact->a : &fact->b);
    if (fact->kind == CAUSE_SHAPE_OTHER) {
        fputs(", was ", out);
        print_shape_value(out, &fact->a);
    }
    fputc(')', out);
}

static void print_layer(FILE *out, const cause_fact *fact)
{
    fprintf(out, fact->kind == CAUSE_LAYER_MORE ? "one more layer (%s)" : "one layer fewer (%s)", fact->name);
}

static void print_point(FILE *out, const cause_fact *fact)
{
    fprintf(out, "point %" PRIu64, fact->id);
    if (fact->kind == CAUSE_POINT_MOVED) {
        fputs(" moved from ", out);
        cause_print_value(out, &fact->a);
        fputs(" to ", out);
    } else {
        fputs(fact->kind == CAUSE_POINT_MORE ? " added at " : " removed from ", out);
    }
    cause_print_value(out, fact->kind == CAUSE_POINT_LESS ? &fact->a : &fact->b);
}

static void print_path(FILE *out, const cause_fact *fact)
{
    static const char *const words[CAUSE_KINDS] = {
        [CAUSE_PRESSED] = "key ", [CAUSE_PLAYER] = "the player at ", [CAUSE_ATTEMPT] = "its attempt at "};
    fputs(words[fact->kind], out);
    cause_print_value(out, &fact->b);
    fputs(" instead of ", out);
    cause_print_value(out, &fact->a);
}

static void print_way(FILE *out, const cause_fact *fact)
{
    (void)fact;
    fputs("another way to there", out);
}

static void print_heat(FILE *out, const cause_fact *fact)
{
    (void)fact;
    fputs("other heat of the ticks before", out);
}

static void print_event(FILE *out, const cause_fact *fact)
{
    fprintf(out, fact->kind == CAUSE_EVENT_MORE ? "event %s" : "no event %s", fact->name);
}

/* "the range query"; where a tick has several, "query 3 (range)", counted from 1 as its lines list them. */
static void print_which(FILE *out, const cause_fact *fact)
{
    if (fact->only)
        fprintf(out, "the %s query", fact->name);
    else
        fprintf(out, "query %zu (%s)", fact->query + 1, fact->name);
}

static void print_answer(FILE *out, const cause_fact *fact)
{
    if (fact->gained)
        fprintf(out, "%zu more hit%s", fact->gained, plural(fact->gained));
    if (fact->gained && fact->lost)
        fprintf(out, " and %zu fewer", fact->lost);
    else if (fact->lost)
        fprintf(out, "%zu hit%s fewer", fact->lost, plural(fact->lost));
    fputs(" in ", out);
    print_which(out, fact);
}

static void print_nearest(FILE *out, const cause_fact *fact)
{
    fputs("another nearest point (", out);
    print_change(out, fact);
    fputs(") in ", out);
    print_which(out, fact);
}

static void print_asked(FILE *out, const cause_fact *fact)
{
    print_which(out, fact);
    fputs(fact->kind == CAUSE_ANSWER_MORE   ? " asked besides"
          : fact->kind == CAUSE_ANSWER_LESS ? " not asked"
                                            : " asked or answered at another place",
          out);
}

static void print_refusal(FILE *out, const cause_fact *fact)
{
    fprintf(out, "point %" PRIu64 "%s refused (%s)", fact->id, fact->kind == CAUSE_REFUSAL_LESS ? " not" : "",
            fact->name);
}

static void print_counts(FILE *out, const cause_fact *fact)
{
    const char *what = fact->kind == CAUSE_VISITS ? "node" : "point";
    const char *verb = fact->kind == CAUSE_VISITS ? "visited" : "compared";
    if (fact->a.whole == fact->b.whole) {
        fprintf(out, "other %ss %s", what, verb);
        return;
    }
    fprintf(out, "%" PRIu64 " %s%s %s instead of %" PRIu64, fact->b.whole, what, plural(fact->b.whole), verb,
            fact->a.whole);
}

/* ---- Many of a kind ------------------------------------------------------------------------------------------ */

/* How a kind is told: a fact by itself; and several of them in one, around what they are about. */
typedef struct phrase {
    print_fact *one;
    const char *before, *after; /* of many; null before: each by itself */
    bool brief;                 /* one fact, too, is told as many are where there is little room */
    bool minor;                 /* told behind the others; where there is little room, only without them */
} phrase;

static const phrase phrases[CAUSE_KINDS] = {
    [CAUSE_OPTION] = {print_option, NULL, NULL, false, false},
    [CAUSE_LENGTH] = {print_length, NULL, NULL, false, false},
    [CAUSE_START_MORE] = {print_start, "more points at the start (", ")", false, false},
    [CAUSE_START_LESS] = {print_start, "points fewer at the start (", ")", false, false},
    [CAUSE_START_MOVED] = {print_start, "points start elsewhere (", ")", false, false},
    [CAUSE_VELOCITY] = {print_start, "points with another velocity (", ")", false, false},
    [CAUSE_START_ORDER] = {print_order, NULL, NULL, false, false},
    [CAUSE_KEY] = {print_key, "other keys (ticks ", ")", false, false},
    [CAUSE_EDIT_MORE] = {print_edit, "more edits (of points ", ")", false, false},
    [CAUSE_EDIT_LESS] = {print_edit, "edits fewer (of points ", ")", false, false},
    [CAUSE_EDIT_OTHER] = {print_other_edit, "other edits (of points ", ")", false, false},
    [CAUSE_EDIT_SPEED] = {print_other_edit, "edits with another velocity (of points ", ")", false, false},
    [CAUSE_EDIT_ORDER] = {print_order, NULL, NULL, false, false},
    [CAUSE_QUERY_MORE] = {print_query, NULL, NULL, false, false},
    [CAUSE_QUERY_LESS] = {print_query, NULL, NULL, false, false},
    [CAUSE_QUERY_OTHER] = {print_query, NULL, NULL, false, false},
    [CAUSE_SHAPE_MORE] = {print_shape, NULL, NULL, false, false},
    [CAUSE_SHAPE_LESS] = {print_shape, NULL, NULL, false, false},
    [CAUSE_SHAPE_OTHER] = {print_shape, NULL, NULL, false, false},
    [CAUSE_VIEW] = {print_option, NULL, NULL, false, false},
    [CAUSE_LAYER_MORE] = {print_layer, NULL, NULL, false, false},
    [CAUSE_LAYER_LESS] = {print_layer, NULL, NULL, false, false},
    [CAUSE_NODE_SPLIT] = {NULL, "node", " split", true, false},
    [CAUSE_NODE_MERGED] = {NULL, "node", " merged", true, false},
    [CAUSE_NODE_BORN] = {NULL, "node", " born", true, false},
    [CAUSE_NODE_GONE] = {NULL, "node", " gone", true, false},
    [CAUSE_POINT_MORE] = {print_point, "point", " added", true, false},
    [CAUSE_POINT_LESS] = {print_point, "point", " removed", true, false},
    [CAUSE_POINT_MOVED] = {print_point, "point", " moved", true, false},
    [CAUSE_PRESSED] = {print_path, NULL, NULL, false, true},
    [CAUSE_PLAYER] = {print_path, NULL, NULL, false, false},
    [CAUSE_ATTEMPT] = {print_path, NULL, NULL, false, true},
    [CAUSE_WAY] = {print_way, NULL, NULL, false, true},
    [CAUSE_EVENT_MORE] = {print_event, NULL, NULL, false, true},
    [CAUSE_EVENT_LESS] = {print_event, NULL, NULL, false, true},
    [CAUSE_HIT_MORE] = {NULL, "point", " hit by the player", true, false},
    [CAUSE_HIT_LESS] = {NULL, "point", " not hit by the player", true, false},
    [CAUSE_ANSWER] = {print_answer, NULL, NULL, false, false},
    [CAUSE_NEAREST] = {print_nearest, NULL, NULL, false, false},
    [CAUSE_ANSWER_MORE] = {print_asked, NULL, NULL, false, false},
    [CAUSE_ANSWER_LESS] = {print_asked, NULL, NULL, false, false},
    [CAUSE_ANSWER_PLACE] = {print_asked, NULL, NULL, false, true},
    [CAUSE_REFUSAL_MORE] = {print_refusal, NULL, NULL, false, false},
    [CAUSE_REFUSAL_LESS] = {print_refusal, NULL, NULL, false, false},
    [CAUSE_SPLITS_NOW] = {NULL, "node", " split at this tick", true, true},
    [CAUSE_MERGES_NOW] = {NULL, "node", " merged at this tick", true, true},
    [CAUSE_NOT_NOW] = {NULL, "node", " as it was at this tick", true, true},
    [CAUSE_VISITS] = {print_counts, NULL, NULL, false, true},
    [CAUSE_COST] = {print_counts, NULL, NULL, false, true},
    [CAUSE_HEAT] = {print_heat, NULL, NULL, false, true},
};

/* What several facts of a kind are told by: the node, the tick of a key, or the point. */
static void print_subject(FILE *out, const cause_fact *fact)
{
    char text[OCTREE_ADDRESS_TEXT];
    if (fact->node)
        fputs(octree_address_format(fact->node, text), out);
    else
        fprintf(out, "%" PRIu64, fact->kind == CAUSE_KEY ? fact->tick : fact->id);
}

/* Those of a kind that are listed; returns how many there are. */
static size_t pick(const cause_facts *facts, cause_kind kind, const cause_fact *picked[CAUSE_LISTED])
{
    size_t count = 0;
    for (size_t i = 0; i < facts->count && count < CAUSE_LISTED; i++)
        if (facts->facts[i].kind == kind)
            picked[count++] = &facts->facts[i];
    return count;
}

enum { BRIEF_SUBJECTS = 3, FULL_SUBJECTS = 5 };

/* Of so many that are listed. "and 1 more" would be no shorter than naming it. */
static size_t count_told(size_t count, bool brief)
{
    const size_t most = brief ? BRIEF_SUBJECTS : FULL_SUBJECTS;
    return count > most + 1 ? most : count;
}

/* "nodes 0/3/7, 0/3/6 and 9 more split"; "12 more edits (ticks 3, 4, 5 and 9 more)". */
static void print_many(FILE *out, const cause_fact *const *picked, size_t count, uint64_t found, bool brief)
{
    const phrase *p = &phrases[picked[0]->kind];
    const bool noun = strchr(p->before, ' ') == NULL;
    const size_t listed = count_told(count, brief);
    if (noun)
        fprintf(out, "%s%s ", p->before, plural(found));
    else
        fprintf(out, "%" PRIu64 " %s", found, p->before);
    for (size_t i = 0; i < listed; i++) {
        if (i)
            fputs(i + 1 == found ? " and " : ", ", out);
        print_subject(out, picked[i]);
    }
    if (found > listed)
        fprintf(out, " and %" PRIu64 " more", found - listed);
    fputs(p->after, out);
}

static void print_each(FILE *out, const cause_fact *const *picked, size_t count, uint64_t found, bool brief)
{
    const phrase *p = &phrases[picked[0]->kind];
    const size_t listed = count_told(count, brief);
    for (size_t i = 0; i < listed; i++) {
        if (i)
            fputs(", ", out);
        p->one(out, picked[i]);
    }
    if (found > listed)
        fprintf(out, " and %" PRIu64 " more of that kind", found - listed);
}

static void print_kind(FILE *out, const cause_facts *facts, cause_kind kind, bool brief)
{
    const phrase *p = &phrases[kind];
    const cause_fact *picked[CAUSE_LISTED];
    const size_t count = pick(facts, kind, picked);
    const bool apart = p->one && !(brief && p->brief) && (!p->before || facts->found[kind] == 1);
    if (count)
        (apart ? print_each : print_many)(out, picked, count, facts->found[kind], brief);
}

static unsigned count_kinds(const cause_facts *facts, bool minor)
{
    unsigned count = 0;
    for (int i = 0; i < CAUSE_KINDS; i++)
        count += facts->found[i] && phrases[i].minor == minor;
    return count;
}

/* Those that matter, or those that do not. */
static void print_half(FILE *out, const cause_facts *facts, bool minor, bool brief)
{
    unsigned told = 0;
    for (int i = 0; i < CAUSE_KINDS; i++) {
        if (facts->found[i] == 0 || phrases[i].minor != minor)
            continue;
        if (brief && told == CAUSE_BRIEF) {
            fputs(" and more", out);
            return;
        }
        fputs(told++ ? ", " : "", out);
        print_kind(out, facts, (cause_kind)i, brief);
    }
}

void cause_print_facts(FILE *out, const cause_facts *facts, bool brief)
{
    const bool major = count_kinds(facts, false) > 0, minor = count_kinds(facts, true) > 0 && !(brief && major);
    print_half(out, facts, false, brief);
    if (major && minor)
        fputs("; ", out);
    if (minor)
        print_half(out, facts, true, brief);
}

/* ---- The headline -------------------------------------------------------------------------------------------- */

/* What follows from another option: how many ticks differ. */
static void print_extent(FILE *out, const cause *c)
{
    if (c->differing == 0) /* frames may: what is shown, such as a shape or an arrow, need not have happened */
        fputs("the same happens in all ticks that both have", out);
    else if (c->differing == c->compared - c->first)
        fprintf(out, "every tick from %" PRIu64 " differs", c->first);
    else
        fprintf(out, "%" PRIu64 " of %" PRIu64 " ticks differ, the first is %" PRIu64, c->differing, c->compared,
                c->first);
}

/* What follows from another point, key, edit or query: what the first tick that differs shows of it. */
static void print_first(FILE *out, const cause *c)
{
    const cause_tick *first = cause_at(c, c->first);
    if (c->differing == 0 || !first || !cause_any(&first->facts)) {
        print_extent(out, c);
        return;
    }
    fprintf(out, "tick %" PRIu64 ": ", c->first);
    cause_print_facts(out, &first->facts, true);
}

void cause_print_headline(FILE *out, const cause *c)
{
    const bool options = c->session.found[CAUSE_OPTION] > 0;
    if (cause_any(&c->session)) {
        cause_print_facts(out, &c->session, true);
        fputs(options ? ": " : "; ", out);
        (options ? print_extent : print_first)(out, c);
    }
    if (cause_any(&c->look)) {
        fputs(cause_any(&c->session) ? "; " : "", out);
        cause_print_facts(out, &c->look, true);
        if (!cause_any(&c->session))
            fputs(": the same ticks, looked at in another way", out);
    }
}
