/* cause_facts.c - see cause_facts.h. */
#include "cause_facts.h"

#include <stdlib.h>

const char *cause_kind_name(cause_kind kind)
{
    static const char *const names[CAUSE_KINDS] = {
#define CAUSE_KIND_NAME(name, text) [CAUSE_##name] = text,
        CAUSE_KIND_MAP(CAUSE_KIND_NAME)
#undef CAUSE_KIND_NAME
    };
    return names[kind];
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

void cause_add_options(cause_facts *facts, cause_kind kind, const cause_option *a, const cause_option *b, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!cause_same_value(&a[i].value, &b[i].value))
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
