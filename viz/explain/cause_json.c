/* cause_json.c - see cause_json.h. */
#include "cause_json.h"
#include "text.h"
#include "trace_words.h"

#include <stdlib.h>
#include <string.h>

/* What a fact of a kind names beside its values. */
enum { NAMES_POINT = 1, NAMES_QUERY = 2, NAMES_COUNTS = 4 };

static const unsigned char named[CAUSE_KINDS] = {
    [CAUSE_START_MORE] = NAMES_POINT,   [CAUSE_START_LESS] = NAMES_POINT,
    [CAUSE_START_MOVED] = NAMES_POINT,  [CAUSE_VELOCITY] = NAMES_POINT,
    [CAUSE_EDIT_MORE] = NAMES_POINT,    [CAUSE_EDIT_LESS] = NAMES_POINT,
    [CAUSE_EDIT_OTHER] = NAMES_POINT,   [CAUSE_EDIT_SPEED] = NAMES_POINT,
    [CAUSE_POINT_MORE] = NAMES_POINT,   [CAUSE_POINT_LESS] = NAMES_POINT,
    [CAUSE_POINT_MOVED] = NAMES_POINT,  [CAUSE_HIT_MORE] = NAMES_POINT,
    [CAUSE_HIT_LESS] = NAMES_POINT,     [CAUSE_REFUSAL_MORE] = NAMES_POINT,
    [CAUSE_REFUSAL_LESS] = NAMES_POINT, [CAUSE_ANSWER] = NAMES_QUERY | NAMES_COUNTS,
    [CAUSE_NEAREST] = NAMES_QUERY,      [CAUSE_ANSWER_MORE] = NAMES_QUERY,
    [CAUSE_ANSWER_LESS] = NAMES_QUERY,  [CAUSE_ANSWER_PLACE] = NAMES_QUERY,
};

static void write_value(json_writer *w, const char *key, const cause_value *value)
{
    octree_box box;
    switch (value->type) {
    case VALUE_NONE:
        break;
    case VALUE_WHOLE:
        json_member_integer(w, key, value->whole);
        break;
    case VALUE_NUMBER:
        json_write_key(w, key);
        json_write_number(w, value->numbers[0]);
        break;
    case VALUE_WORD:
        json_member_text(w, key, value->word);
        break;
    case VALUE_PLACE:
        json_member_vector(w, key, value->numbers);
        break;
    case VALUE_SEGMENT:
        json_write_key(w, key);
        json_write_begin_array(w);
        json_write_numbers(w, value->numbers, 3);
        json_write_numbers(w, value->numbers + 3, 3);
        json_write_end_array(w);
        break;
    case VALUE_BOX:
        memcpy(box.min, value->numbers, sizeof box.min);
        memcpy(box.max, value->numbers + 3, sizeof box.max);
        json_member_box(w, key, &box);
        break;
    }
}

static void write_fact(json_writer *w, const cause_fact *fact)
{
    char text[OCTREE_ADDRESS_TEXT];
    const unsigned names = named[fact->kind];
    json_write_begin_object(w);
    json_member_text(w, "kind", cause_kind_name(fact->kind));
    if (fact->tick != CAUSE_NO_TICK)
        json_member_integer(w, "tick", fact->tick);
    if (fact->name)
        json_member_text(w, "name", fact->name);
    if (names & NAMES_POINT)
        json_member_integer(w, "id", fact->id);
    if (fact->node)
        json_member_text(w, "node", octree_address_format(fact->node, text));
    if (names & NAMES_QUERY)
        json_member_integer(w, "query", fact->query);
    if (names & NAMES_COUNTS) {
        json_member_integer(w, "gained", fact->gained);
        json_member_integer(w, "lost", fact->lost);
    }
    write_value(w, "reference", &fact->a);
    write_value(w, "frames", &fact->b);
    json_write_end_object(w);
}

/* "facts" or another key, and "more" where not all are listed. */
static void write_facts(json_writer *w, const char *key, const char *more, const cause_facts *facts)
{
    bool all = true;
    json_write_key(w, key);
    json_write_begin_array(w);
    for (size_t i = 0; i < facts->count; i++)
        write_fact(w, &facts->facts[i]);
    json_write_end_array(w);
    for (int i = 0; i < CAUSE_KINDS; i++)
        all = all && facts->found[i] <= CAUSE_LISTED;
    if (all)
        return;
    json_write_key(w, more);
    json_write_begin_object(w);
    for (int i = 0; i < CAUSE_KINDS; i++)
        if (facts->found[i] > CAUSE_LISTED)
            json_member_integer(w, cause_kind_name((cause_kind)i), facts->found[i] - CAUSE_LISTED);
    json_write_end_object(w);
}

static void write_element(json_writer *w, const trace_part *part)
{
    char *what = NULL;
    text_stream s;
    if (text_stream_begin(&s))
        trace_print_part(s.stream, part);
    if (!text_stream_end(&s, &what))
        return;
    json_write_begin_object(w);
    json_member_text(w, "what", what);
    json_member_integer(w, "pixels", part->pixels);
    json_write_end_object(w);
    free(what);
}

static void write_trace(json_writer *w, const trace *t)
{
    json_member_integer(w, "pixels", t->pixels);
    json_write_key(w, "elements");
    json_write_begin_array(w);
    for (size_t i = 0; i < t->count && i < CAUSE_ELEMENTS; i++)
        write_element(w, &t->parts[i]);
    json_write_end_array(w);
}

static void write_ticks(json_writer *w, const explanation *e)
{
    const cause *c = &e->cause;
    json_write_key(w, "ticks");
    json_write_begin_array(w);
    for (size_t i = 0; i < c->count; i++) {
        json_write_begin_object(w);
        json_member_integer(w, "tick", c->ticks[i].tick);
        write_facts(w, "facts", "more", &c->ticks[i].facts);
        if (tracer_at(&e->tracer, c->ticks[i].tick))
            write_trace(w, tracer_at(&e->tracer, c->ticks[i].tick));
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_sides(json_writer *w, const explanation *e)
{
    json_write_key(w, "doubts");
    json_write_begin_array(w);
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < e->sides[side].doubt_count; i++)
            json_write_string(w, e->sides[side].doubts[i]);
    json_write_end_array(w);
    json_write_key(w, "drawn_by");
    json_write_begin_array(w);
    for (int side = 0; side < 2; side++)
        json_write_string(w, e->sides[side].drawn_by);
    json_write_end_array(w);
}

void cause_write_json(json_writer *w, const explanation *e)
{
    const cause *c = &e->cause;
    json_write_begin_object(w);
    write_facts(w, "session", "session_more", &c->session);
    write_facts(w, "look", "look_more", &c->look);
    json_member_integer(w, "compared", c->compared);
    json_member_integer(w, "differing", c->differing);
    if (c->differing) {
        json_member_integer(w, "first", c->first);
        json_member_integer(w, "last", c->last);
    }
    write_ticks(w, e);
    write_sides(w, e);
    if (*e->tracer.untraced)
        json_member_text(w, "untraced", e->tracer.untraced);
    json_write_end_object(w);
}
