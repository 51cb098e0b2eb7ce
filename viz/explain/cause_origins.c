/* SPDX-License-Identifier: MIT */
/* cause_origins.c - collects differences by tick and finds the causes of each tick; cause_origins.h explains how. */
#include "cause_origins.h"
#include "array.h"
#include "cause_facts.h"
#include "text.h"
#include "tick_scene.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

bool cause_is_origin_shown(const char *where, uint64_t origin, uint64_t tick)
{
    const bool keys = strcmp(where, "keys") == 0;
    return origin == tick || (keys && origin < tick + KEYS_AHEAD + 1 && tick < origin + KEYS_BEHIND + 1);
}

/* ---- Collecting ---------------------------------------------------------------------------------------------- */

/* Return the index of the kind with this name, or SIZE_MAX if memory runs out. */
static size_t find_or_add_kind(cause_origins *o, const char *name)
{
    for (size_t i = 0; i < o->kind_count; i++)
        if (strcmp(o->kinds[i].name, name) == 0)
            return i;
    if (!array_grow(&o->kinds, o->kind_count + 1, &o->kind_room, sizeof *o->kinds))
        return SIZE_MAX;
    cause_kind *kind = &o->kinds[o->kind_count];
    kind->since = CAUSE_NO_TICK;
    snprintf(kind->name, sizeof kind->name, "%s", name);
    return o->kind_count++;
}

/* Return whether a difference at this path affects only the tick at which it occurs. An effect on the heat of later
 * ticks is ignored. */
static bool is_momentary(const char *where)
{
    return strncmp(where, "queries", 7) == 0 || strncmp(where, "shapes", 6) == 0;
}

/* A difference that is not momentary affects all later ticks. In a later tick, the effects of several such differences
 * at the same path cannot be separated, so all of them get the same kind: the path alone. */
bool cause_origins_add(cause_origins *o, uint64_t tick, const char *where, const char *kind)
{
    char name[CAUSE_KIND];
    snprintf(name, sizeof name, "%s%s%s", where, is_momentary(where) ? " " : "", is_momentary(where) ? kind : "");
    const cause_origin origin = {tick, find_or_add_kind(o, name)};
    const cause_origin *last = o->count ? &o->listed[o->count - 1] : NULL;
    if (origin.kind == SIZE_MAX || (last && last->tick == tick && last->kind == origin.kind))
        return origin.kind != SIZE_MAX;
    if (!array_grow(&o->listed, o->count + 1, &o->room, sizeof *o->listed))
        return false;
    o->listed[o->count++] = origin;
    return true;
}

void cause_origins_sort(cause_origins *o)
{
    if (o->count)
        qsort(o->listed, o->count, sizeof *o->listed, compare_uint64);
}

void cause_origins_release(cause_origins *o)
{
    for (size_t i = 0; i < o->stretch_count; i++)
        free(o->stretches[i].causes);
    free(o->stretches);
    free(o->listed);
    free(o->kinds);
    *o = (cause_origins){0};
}

/* ---- Stretches of ticks with the same causes ----------------------------------------------------------------- */

/* Begin a stretch at a tick, and write the kinds that are now in effect to its text. */
static bool begin_stretch(cause_origins *o, uint64_t tick)
{
    text_stream s;
    bool any = false;
    if (!array_grow(&o->stretches, o->stretch_count + 1, &o->stretch_room, sizeof *o->stretches))
        return false;
    if (text_stream_begin(&s))
        for (size_t i = 0; i < o->kind_count; i++) {
            if (o->kinds[i].since == CAUSE_NO_TICK)
                continue;
            fprintf(s.stream, "%s%s %" PRIu64, any ? ", " : "", o->kinds[i].name, o->kinds[i].since);
            any = true;
        }
    o->stretches[o->stretch_count] = (cause_stretch){.first = tick};
    if (!text_stream_end(&s, &o->stretches[o->stretch_count].causes))
        return false;
    o->stretch_count++;
    return true;
}

static bool has_difference_of_kind(const cause_origins *o, uint64_t tick, size_t kind)
{
    for (size_t i = o->next; i < o->count && o->listed[i].tick == tick; i++)
        if (o->listed[i].kind == kind)
            return true;
    return false;
}

bool cause_origins_update(cause_origins *o, uint64_t tick, bool games_differ, bool other_heat)
{
    bool changed = false;
    for (size_t i = 0; i < o->kind_count; i++) {
        cause_kind *kind = &o->kinds[i];
        const bool lasts = other_heat || (games_differ && !is_momentary(kind->name));
        const uint64_t before = kind->since;
        if (!has_difference_of_kind(o, tick, i))
            kind->since = lasts ? kind->since : CAUSE_NO_TICK;
        else if (kind->since == CAUSE_NO_TICK)
            kind->since = tick;
        changed = changed || kind->since != before;
    }
    while (o->next < o->count && o->listed[o->next].tick == tick)
        o->next++;
    return !changed || begin_stretch(o, tick);
}

/* Return the number of items whose tick is before `end`. Each item begins with its tick as a uint64_t. The items are
 * sorted by tick in ascending order. */
static size_t count_items_before(const void *items, size_t count, size_t item_size, uint64_t end)
{
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (*(const uint64_t *)((const char *)items + middle * item_size) < end)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static const char *find_causes_at(const cause_origins *o, uint64_t tick)
{
    const size_t count = count_items_before(o->stretches, o->stretch_count, sizeof *o->stretches, tick + 1);
    return count && o->stretches[count - 1].causes ? o->stretches[count - 1].causes : "";
}

/* A frame also lists the key presses of neighbouring ticks. If no difference is in effect at this tick, search for
 * differing key presses: first at this tick and later ticks, then at earlier ticks. */
const char *cause_origins_find_causes(const cause_origins *o, uint64_t tick)
{
    const char *causes = find_causes_at(o, tick);
    const size_t here = count_items_before(o->listed, o->count, sizeof *o->listed, tick);
    for (size_t i = here; !*causes && i < o->count && o->listed[i].tick <= tick + KEYS_AHEAD; i++)
        if (cause_is_origin_shown(o->kinds[o->listed[i].kind].name, o->listed[i].tick, tick))
            causes = find_causes_at(o, o->listed[i].tick);
    for (size_t i = here; !*causes && i > 0 && o->listed[i - 1].tick + KEYS_BEHIND >= tick; i--)
        if (cause_is_origin_shown(o->kinds[o->listed[i - 1].kind].name, o->listed[i - 1].tick, tick))
            causes = find_causes_at(o, o->listed[i - 1].tick);
    return causes;
}
