/* SPDX-License-Identifier: MIT */
/* cause_facts.c - collects facts in groups. All facts of a group have the same place, query and change
 * (cause_facts.h). */
#include "cause_facts.h"
#include "array.h"
#include "cause_pairs.h"

#include <stdio.h>
#include <string.h>

static bool is_about_all_ticks(const cause_group *group)
{
    return group->listed[0].tick == CAUSE_NO_TICK;
}

static bool is_group_with(const cause_group *group, const char *where, const char *query, cause_change change)
{
    return group->change == change && strcmp(group->where, where) == 0 && strcmp(group->query, query) == 0;
}

static cause_group *find_group(const cause_facts *facts, const char *where, const char *query, cause_change change,
                               bool about_all)
{
    for (size_t i = 0; i < facts->count; i++)
        if (is_group_with(&facts->groups[i], where, query, change) &&
            is_about_all_ticks(&facts->groups[i]) == about_all)
            return &facts->groups[i];
    return NULL;
}

static cause_group *add_group(cause_facts *facts, const char *where, const char *query, cause_change change)
{
    if (!array_grow(&facts->groups, facts->count + 1, &facts->room, sizeof *facts->groups))
        return NULL;
    cause_group *group = &facts->groups[facts->count++];
    *group = (cause_group){.change = change};
    snprintf(group->where, sizeof group->where, "%s", where);
    snprintf(group->query, sizeof group->query, "%s", query);
    return group;
}

void cause_add_fact(cause_facts *facts, const char *where, const char *query, cause_change change, cause_fact fact)
{
    cause_group *group = find_group(facts, where, query, change, fact.tick == CAUSE_NO_TICK);
    if (!group)
        group = add_group(facts, where, query, change);
    facts->out_of_memory |= !group;
    if (fact.tick != CAUSE_NO_TICK)
        facts->out_of_memory |=
            !cause_origins_add(&facts->origins, fact.tick, where, cause_kind_of(fact.b ? fact.b : fact.a));
    if (group && group->found++ < CAUSE_LISTED) {
        group->listed[group->found - 1] = fact;
    } else {
        json_decref(fact.a);
        json_decref(fact.b);
    }
}

const cause_group *cause_find_group(const cause_facts *facts, const char *where, cause_change change)
{
    for (size_t i = 0; i < facts->count; i++)
        if (is_group_with(&facts->groups[i], where, "", change))
            return &facts->groups[i];
    return NULL;
}

static bool is_group_before(const cause_group *a, const cause_group *b)
{
    return !is_about_all_ticks(b) && (is_about_all_ticks(a) || a->listed[0].tick < b->listed[0].tick);
}

/* Sort the groups by their first tick. Insertion sort is stable, so groups that begin at the same tick keep their
 * order. */
void cause_facts_sort(cause_facts *facts)
{
    for (size_t i = 1; i < facts->count; i++)
        for (size_t j = i; j > 0 && is_group_before(&facts->groups[j], &facts->groups[j - 1]); j--) {
            const cause_group swapped = facts->groups[j];
            facts->groups[j] = facts->groups[j - 1];
            facts->groups[j - 1] = swapped;
        }
    cause_origins_sort(&facts->origins);
}

/* Return a copy of a group that holds only the facts that the frame of a tick can show. */
static cause_group select_group_facts_of_tick(const cause_group *group, uint64_t tick)
{
    cause_group shown = *group;
    if (is_about_all_ticks(group)) {
        if (strcmp(group->where, "every") == 0 || strcmp(group->where, "ticks") == 0)
            shown.found = 0;
        return shown;
    }
    shown.found = 0;
    for (size_t i = 0; i < cause_count_listed(group); i++)
        if (cause_is_origin_shown(group->where, group->listed[i].tick, tick))
            shown.listed[shown.found++] = group->listed[i];
    return shown;
}

bool cause_has_facts_of_tick(const cause_facts *facts, uint64_t tick)
{
    for (size_t i = 0; i < facts->count; i++)
        if (select_group_facts_of_tick(&facts->groups[i], tick).found > 0)
            return true;
    return false;
}

cause_facts cause_select_facts_of_tick(const cause_facts *facts, uint64_t tick)
{
    cause_facts shown = {.groups = malloc((facts->count + 1) * sizeof *shown.groups)};
    shown.out_of_memory = !shown.groups;
    for (size_t i = 0; shown.groups && i < facts->count; i++) {
        shown.groups[shown.count] = select_group_facts_of_tick(&facts->groups[i], tick);
        shown.count += shown.groups[shown.count].found > 0;
    }
    return shown;
}

void cause_facts_release(cause_facts *facts)
{
    for (size_t i = 0; i < facts->count; i++)
        for (size_t j = 0; j < cause_count_listed(&facts->groups[i]); j++) {
            json_decref(facts->groups[i].listed[j].a);
            json_decref(facts->groups[i].listed[j].b);
        }
    free(facts->groups);
    cause_origins_release(&facts->origins);
    *facts = (cause_facts){0};
}
