/* SPDX-License-Identifier: MIT */
/* track.c - follows the positions of a program's points, or their half extents: see track.h. */
#include "track.h"
#include "array.h"

enum { FEW = 1024 };

void track_release(track *t)
{
    points_release(&t->now);
    points_release(&t->next);
    point_table_release(&t->table);
    change_list_release(&t->changes);
    *t = (track){.tabled = false};
}

void track_begin_tick(track *t)
{
    change_list *list = &t->changes;
    if (list->count > FEW && list->count / 2 > t->settled)
        list->count = t->settled = combine_changes(list->items, list->count);
    t->kept = list->count;
}

void track_revert_tick(track *t)
{
    while (t->changes.count > t->kept) {
        t->changes.count--;
        if (t->tabled)
            change_revert(&t->changes.items[t->changes.count], &t->table);
    }
}

void track_accept_tick(track *t)
{
    t->settled = 0;
    if (!t->tabled)
        points_swap(&t->now, &t->next); /* the next tick's list will be compared with this tick's list */
}

bool track_switch_to_table(track *t)
{
    if (t->tabled)
        return true;
    if (!point_table_reserve(&t->table, t->now.count))
        return false;
    for (size_t i = 0; i < t->now.count; i++)
        point_table_set(&t->table, &t->now.items[i]);
    points_release(&t->now);
    points_release(&t->next);
    t->tabled = true;
    return true;
}

bool track_switch_to_lists(track *t, points *spare)
{
    if (!t->tabled)
        return true;
    track_revert_tick(t); /* some changes of the tree's log may already be applied */
    if (!point_table_list(&t->table, &t->now, spare))
        return false;
    point_table_release(&t->table);
    t->tabled = false;
    return true;
}

static bool reserve_changes(track *t, size_t more)
{
    return more <= UINT32_MAX - t->changes.count && ARRAY_GROW(&t->changes, more);
}

bool track_change_point(track *t, uint64_t id, const double *from, const double *to)
{
    if (!reserve_changes(t, 1) || (!from && !point_table_reserve(&t->table, t->table.count + 1)))
        return false;
    if (change_make(id, from, to, &t->changes.items[t->changes.count]))
        change_apply(&t->changes.items[t->changes.count++], &t->table);
    return true;
}

bool track_compare_lists(track *t, bool many_changes)
{
    list_comparison lists = {.before = &t->now, .after = &t->next};
    change_list *list = &t->changes;
    size_t more = (t->now.count == 0 || many_changes) && t->next.count > FEW ? t->next.count : FEW;
    for (; !list_comparison_has_ended(&lists); more = list->room) {
        if (!reserve_changes(t, more))
            return false;
        list->count += list_next_changes(&lists, list->items + list->count, list->room - list->count);
    }
    return true;
}
