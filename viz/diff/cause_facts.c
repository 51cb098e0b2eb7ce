/* cause_facts.c - see cause_facts.h. */
#include "cause_facts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *cause_kind_name(cause_kind kind)
{
    static const char *const names[CAUSE_KINDS] = {
#define CAUSE_KIND_NAME(name, text) [CAUSE_##name] = text,
        CAUSE_KIND_MAP(CAUSE_KIND_NAME)
#undef CAUSE_KIND_NAME
    };
    return names[kind];
}

cause_value cause_whole(uint64_t whole)
{
    return (cause_value){.type = VALUE_WHOLE, .whole = whole};
}

cause_value cause_number(double number)
{
    return (cause_value){.type = VALUE_NUMBER, .numbers = {number}};
}

cause_value cause_word(const char *word)
{
    cause_value value = {.type = VALUE_WORD};
    snprintf(value.word, sizeof value.word, "%s", word);
    return value;
}

cause_value cause_place(const double place[3])
{
    return (cause_value){.type = VALUE_PLACE, .numbers = {place[0], place[1], place[2]}};
}

cause_value cause_box(const octree_box *box)
{
    cause_value value = {.type = VALUE_BOX};
    memcpy(value.numbers, box->min, sizeof box->min);
    memcpy(value.numbers + 3, box->max, sizeof box->max);
    return value;
}

void cause_add(cause_facts *facts, cause_fact fact)
{
    if (facts->found[fact.kind]++ >= CAUSE_LISTED || facts->out_of_memory)
        return;
    if (facts->count == facts->room) {
        const size_t room = facts->room ? 2 * facts->room : 8;
        cause_fact *grown = realloc(facts->facts, room * sizeof *grown);
        if (!grown) {
            facts->out_of_memory = true;
            return;
        }
        facts->facts = grown;
        facts->room = room;
    }
    facts->facts[facts->count++] = fact;
}

static bool same_value(const cause_value *a, const cause_value *b)
{
    bool same = a->type == b->type && a->whole == b->whole && strcmp(a->word, b->word) == 0;
    for (int i = 0; same && i < 6; i++)
        same = a->numbers[i] == b->numbers[i];
    return same;
}

void cause_add_options(cause_facts *facts, cause_kind kind, const cause_option *a, const cause_option *b, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!same_value(&a[i].value, &b[i].value))
            cause_add(
                facts,
                (cause_fact){.kind = kind, .tick = CAUSE_NO_TICK, .name = a[i].name, .a = a[i].value, .b = b[i].value});
}

void cause_facts_release(cause_facts *facts)
{
    free(facts->facts);
    *facts = (cause_facts){0};
}

bool cause_any(const cause_facts *facts)
{
    for (int i = 0; i < CAUSE_KINDS; i++)
        if (facts->found[i])
            return true;
    return false;
}
