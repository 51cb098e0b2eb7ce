/* SPDX-License-Identifier: MIT */
/* cause_json.c - writes an explanation as JSON. */
#include "cause_json.h"

/* ---- Facts --------------------------------------------------------------------------------------------------- */

static void write_value(json_writer *w, json_t *value)
{
    const char *key;
    json_t *member;
    size_t i;
    if (json_is_number(value)) {
        json_write_number(w, json_number_value(value));
    } else if (json_is_string(value)) {
        json_write_string(w, json_string_value(value));
    } else if (json_is_boolean(value)) {
        json_write_bool(w, json_is_true(value));
    } else if (json_is_array(value)) {
        json_write_begin_array(w);
        json_array_foreach(value, i, member) write_value(w, member);
        json_write_end_array(w);
    } else if (json_is_object(value)) {
        json_write_begin_object(w);
        json_object_foreach(value, key, member)
        {
            json_write_key(w, key);
            write_value(w, member);
        }
        json_write_end_object(w);
    } else {
        json_write_null(w);
    }
}

static void write_member(json_writer *w, const char *key, json_t *value)
{
    if (!value)
        return;
    json_write_key(w, key);
    write_value(w, value);
}

static void write_fact(json_writer *w, const cause_fact *fact)
{
    json_write_begin_object(w);
    if (fact->tick != CAUSE_NO_TICK)
        json_write_integer_member(w, "tick", fact->tick);
    if (fact->id != CAUSE_NO_ID)
        json_write_integer_member(w, "id", fact->id);
    write_member(w, "reference", fact->a);
    write_member(w, "frames", fact->b);
    json_write_end_object(w);
}

static void write_group(json_writer *w, const cause_group *group)
{
    static const char *const changes[] = {
        [CAUSE_OTHER] = "other", [CAUSE_MORE] = "more", [CAUSE_LESS] = "less", [CAUSE_ORDER] = "order"};
    json_write_begin_object(w);
    json_write_text_member(w, "where", group->where);
    json_write_text_member(w, "change", changes[group->change]);
    if (*group->query)
        json_write_text_member(w, "query", group->query);
    json_write_integer_member(w, "count", group->found);
    json_begin_array_member(w, "facts");
    for (size_t i = 0; i < cause_count_listed(group); i++)
        write_fact(w, &group->listed[i]);
    json_write_end_array(w);
    json_write_end_object(w);
}

static void write_facts(json_writer *w, const char *key, const cause_facts *facts)
{
    json_begin_array_member(w, key);
    for (size_t i = 0; i < facts->count; i++)
        write_group(w, &facts->groups[i]);
    json_write_end_array(w);
}

/* ---- The explanation ------------------------------------------------------------------------------------------- */

static void write_trace(json_writer *w, const trace *t)
{
    char text[TRACE_TEXT];
    json_write_integer_member(w, "pixels", t->pixels);
    json_begin_array_member(w, "elements");
    for (size_t i = 0; i < t->count && i < CAUSE_ELEMENTS; i++) {
        json_write_begin_object(w);
        json_write_text_member(w, "what", trace_part_text(&t->parts[i], text));
        json_write_integer_member(w, "pixels", t->parts[i].pixels);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

/* Write how the wrong answers of the two recordings differ. If they do not differ, write nothing. */
static void write_wrong_answers(json_writer *w, const cause_span wrong[WRONG_CHANGES])
{
    static const char *const names[] = {[WRONG_MORE] = "more", [WRONG_FEWER] = "fewer", [WRONG_OTHER] = "other"};
    if (wrong[WRONG_MORE].count + wrong[WRONG_FEWER].count + wrong[WRONG_OTHER].count == 0)
        return;
    json_begin_object_member(w, "wrong_answers");
    for (int i = 0; i < WRONG_CHANGES; i++) {
        if (wrong[i].count == 0)
            continue;
        json_begin_object_member(w, names[i]);
        json_write_integer_member(w, "count", wrong[i].count);
        json_write_integer_member(w, "first", wrong[i].first);
        json_write_integer_member(w, "last", wrong[i].last);
        json_write_end_object(w);
    }
    json_write_end_object(w);
}

static void write_ticks(json_writer *w, const explanation *e)
{
    const cause *c = &e->cause;
    json_begin_array_member(w, "ticks");
    for (size_t i = 0; i < c->count; i++) {
        json_write_begin_object(w);
        json_write_integer_member(w, "tick", c->ticks[i].tick);
        write_facts(w, "causes", &c->ticks[i].facts);
        if (c->ticks[i].trace.made)
            write_trace(w, &c->ticks[i].trace);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_warnings_and_renderers(json_writer *w, const explanation *e)
{
    json_begin_array_member(w, "warnings");
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < e->sides[side].warning_count; i++)
            json_write_string(w, e->sides[side].warnings[i]);
    json_write_end_array(w);
    json_begin_array_member(w, "drawn_by");
    for (int side = 0; side < 2; side++)
        json_write_string(w, e->sides[side].drawn_by);
    json_write_end_array(w);
}

void cause_write_json(json_writer *w, const explanation *e)
{
    const cause *c = &e->cause;
    json_write_begin_object(w);
    write_facts(w, "session", &c->session);
    write_facts(w, "view", &c->view);
    write_wrong_answers(w, c->wrong);
    json_write_integer_member(w, "compared", c->compared);
    json_write_integer_member(w, "differing", c->differing.count);
    if (c->differing.count) {
        json_write_integer_member(w, "first", c->differing.first);
        json_write_integer_member(w, "last", c->differing.last);
    }
    write_ticks(w, e);
    write_warnings_and_renderers(w, e);
    if (*e->tracer.untraced)
        json_write_text_member(w, "untraced", e->tracer.untraced);
    json_write_end_object(w);
}
