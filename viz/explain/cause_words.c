/* SPDX-License-Identifier: MIT */
/* cause_words.c - prints facts as sentences. The nouns and verbs are in cause_places.c. */
#include "cause_words.h"
#include "cause_places.h"
#include "number.h"
#include "text.h"

#include <inttypes.h>
#include <string.h>

/* ---- Values -------------------------------------------------------------------------------------------------- */

static void print_value(FILE *out, const json_t *value, bool is_member);

static void print_number(FILE *out, double number)
{
    char text[NUMBER_TEXT];
    number_print(number, text);
    fputs(text, out);
}

/* the number of elements that are printed from a longer list, such as a list of ids */
enum { LONGEST_LIST = 4 };

/* Print a list: "(1, 2, 3)", "(1, 2, 3, 4 and 8 more)", or for a segment "(0, 0, 0) to (9, 9, 9)". */
static void print_list(FILE *out, const json_t *list)
{
    const bool nested = json_is_array(json_array_get(list, 0));
    const size_t count = json_array_size(list), printed = count > LONGEST_LIST + 1 ? LONGEST_LIST : count;
    fputs(nested ? "" : "(", out);
    for (size_t i = 0; i < printed; i++) {
        fputs(i == 0 ? "" : nested ? " to " : ", ", out);
        print_value(out, json_array_get(list, i), false);
    }
    if (count > printed)
        fprintf(out, " and %zu more", count - printed);
    fputs(nested ? "" : ")", out);
}

static bool is_box(const json_t *value)
{
    return json_object_size(value) == 2 && json_object_get(value, "min");
}

/* Print a box as its two corners. Print any other object as a list of its members, each with its name. */
static void print_object(FILE *out, json_t *object)
{
    const char *key;
    json_t *value;
    bool first = true;
    const bool box = is_box(object);
    json_object_foreach(object, key, value)
    {
        if (box)
            fputs(first ? "" : " to ", out);
        else
            fprintf(out, "%s%s ", first ? "" : ", ", key);
        print_value(out, value, true);
        first = false;
    }
}

/* Print a value. With `is_member`, the value is a member of an object, and a text is printed in quotes. */
static void print_value(FILE *out, const json_t *value, bool is_member)
{
    if (json_is_number(value))
        print_number(out, json_number_value(value));
    else if (json_is_string(value))
        fprintf(out, is_member ? "\"%s\"" : "%s", json_string_value(value));
    else if (json_is_array(value))
        print_list(out, value);
    else if (json_is_object(value))
        print_object(out, (json_t *)(uintptr_t)value);
    else
        fputs(json_is_true(value) ? "on" : json_is_false(value) ? "off" : "none", out);
}

static bool has_members(const json_t *value)
{
    return json_is_object(value) && !is_box(value);
}

/* Print the new and the old value: "8, was 4". For objects print every member, and print the old value of each
 * changed member: "radius 101, was 100, at (1, 2, 3)". */
static void print_change(FILE *out, const json_t *a, const json_t *b, bool is_member)
{
    const char *key;
    json_t *value;
    bool first = true;
    if (!has_members(a) || !has_members(b)) {
        print_value(out, b, is_member);
        fputs(", was ", out);
        print_value(out, a, is_member);
        return;
    }
    json_object_foreach((json_t *)(uintptr_t)b, key, value)
    {
        const json_t *before = json_object_get(a, key);
        fprintf(out, "%s%s ", first ? "" : ", ", key);
        if (cause_values_are_equal(before, value, true))
            print_value(out, value, true);
        else
            print_change(out, before, value, true);
        first = false;
    }
    json_object_foreach((json_t *)(uintptr_t)a, key, value)
    {
        if (json_object_get(b, key))
            continue;
        fprintf(out, ", %s ", key);
        print_change(out, value, NULL, true);
    }
}

/* ---- One fact ------------------------------------------------------------------------------------------------ */

static void print_tick_of_fact(FILE *out, const cause_row *p, const cause_fact *fact)
{
    if (fact->tick != CAUSE_NO_TICK)
        fprintf(out, " at tick %" PRIu64, fact->tick);
    else if (p->every)
        fputs(" at every tick", out);
}

/* Print " in the range query" if the facts of the group are about the answer of this query. */
static void print_query(FILE *out, const cause_group *group)
{
    if (*group->query)
        fprintf(out, " in %s", group->query);
}

/* Print the subject of a fact: the id of a point, the tick of a key, a node, or a word. */
static void print_subject(FILE *out, const cause_fact *fact)
{
    const json_t *value = fact->b ? fact->b : fact->a;
    if (fact->id != CAUSE_NO_ID)
        fprintf(out, "%" PRIu64, fact->id);
    else if (fact->tick != CAUSE_NO_TICK)
        fprintf(out, "%" PRIu64, fact->tick);
    else
        print_value(out, value, false);
}

/* Print the values of a fact: " (8, was 4)" or " (point 3: (7, -7, 7), was (7, 7, 7))". Numbers of visited nodes and
 * long lists are printed only in the JSON report. */
static void print_values(FILE *out, const cause_row *p, const cause_group *group, const cause_fact *fact)
{
    const json_t *value = fact->b ? fact->b : fact->a;
    const bool has_id = fact->id != CAUSE_NO_ID && !json_is_object(value);
    const bool is_id = has_id && json_is_number(value) && group->change != CAUSE_OTHER;
    if (!value || (p->minor && json_is_object(value)) || json_array_size(value) > LONGEST_LIST)
        return;
    fputs(" (", out);
    if (has_id)
        fprintf(out, "point %" PRIu64 "%s", fact->id, is_id ? "" : ": ");
    if (group->change == CAUSE_OTHER)
        print_change(out, fact->a, fact->b, false);
    else if (!is_id)
        print_value(out, value, false);
    fputc(')', out);
}

static void print_noun(FILE *out, const cause_row *p, bool is_plural)
{
    fputs(is_plural && p->plural ? p->plural : p->noun, out);
    fputs(is_plural && !p->plural ? "s" : "", out);
}

static void print_fact(FILE *out, const cause_row *p, const cause_group *group, const cause_fact *fact)
{
    static const char *const beginnings[] = {[CAUSE_OTHER] = "another ",
                                             [CAUSE_MORE] = "one more ",
                                             [CAUSE_LESS] = "one ",
                                             [CAUSE_ORDER] = "another order of the "};
    /* here the query was asked in only one recording */
    if (strcmp(group->where, "answers") == 0 && group->change != CAUSE_ORDER) {
        fprintf(out, "%s%s", group->query,
                group->change == CAUSE_MORE ? " asked only in the frames" : " asked only in the reference");
        return;
    }
    fputs(beginnings[group->change], out);
    print_noun(out, p, group->change == CAUSE_ORDER);
    fputs(group->change == CAUSE_LESS ? " fewer" : "", out);
    print_query(out, group);
    print_tick_of_fact(out, p, fact);
    print_values(out, p, group, fact);
}

/* ---- Groups of several facts ----------------------------------------------------------------------------------- */

enum { MINOR_SUBJECTS = 2, BRIEF_SUBJECTS = 3, FULL_SUBJECTS = 5 };

/* Return how many facts of a group are printed with their subjects; the other facts are only counted. If only one
 * fact would be left over, print its subject, too: "and 1 more" would not be shorter. */
static size_t count_printed_subjects(const cause_group *group, bool brief)
{
    const size_t most = brief ? BRIEF_SUBJECTS : FULL_SUBJECTS, count = cause_count_listed(group);
    return count > most + 1 ? most : count;
}

static void print_subjects(FILE *out, const cause_group *group, bool brief)
{
    const size_t printed = count_printed_subjects(group, brief);
    for (size_t i = 0; i < printed; i++) {
        if (i)
            fputs(i + 1 == group->found ? " and " : ", ", out);
        print_subject(out, &group->listed[i]);
    }
    if (group->found > printed)
        fprintf(out, " and %" PRIu64 " more", group->found - printed);
}

/* Print a group with the verb of its place: "points 12 and 13 moved", "49 points moved (such as 12)" or "point 12
 * moved from (0, 0, 0) to (1, 2, 3)". */
static void print_group_with_verb(FILE *out, const cause_row *p, const cause_group *group, bool brief)
{
    const cause_fact *fact = &group->listed[0];
    if (group->found > (p->minor ? MINOR_SUBJECTS : count_printed_subjects(group, brief))) {
        fprintf(out, "%" PRIu64 " %ss %s (such as ", group->found, p->noun, p->verbs[group->change]);
        print_subject(out, fact);
        fputc(')', out);
        return;
    }
    fprintf(out, "%s%s ", p->noun, plural_ending(group->found));
    print_subjects(out, group, brief);
    fprintf(out, " %s", p->verbs[group->change]);
    if (brief || group->found > 1 || fact->id == CAUSE_NO_ID)
        return;
    fputs(group->change == CAUSE_MORE ? " at " : " from ", out);
    print_value(out, fact->a ? fact->a : fact->b, false);
    if (group->change == CAUSE_OTHER) {
        fputs(" to ", out);
        print_value(out, fact->b, false);
    }
}

/* Print a group of several facts without a verb: "12 more edits (points 3, 4, 5 and 9 more)". */
static void print_group_as_count(FILE *out, const cause_row *p, const cause_group *group, bool brief)
{
    static const char *const words[] = {
        [CAUSE_OTHER] = "other ", [CAUSE_MORE] = "more ", [CAUSE_LESS] = "fewer ", [CAUSE_ORDER] = "reordered "};
    const cause_fact *first = &group->listed[0];
    fprintf(out, "%" PRIu64 " %s", group->found, words[group->change]);
    print_noun(out, p, true);
    print_query(out, group);
    const bool of_nodes = strcmp(group->where, "foreign_nodes") == 0;
    fputs(first->id != CAUSE_NO_ID       ? of_nodes ? " (nodes " : " (points "
          : first->tick != CAUSE_NO_TICK ? " (ticks "
                                         : " (",
          out);
    print_subjects(out, group, brief);
    fputc(')', out);
}

/* Print a group whose facts have no id and no word, with the verb of its place: "the query visited other nodes at tick
 * 3 (visited 12, was 9)" or "17 queries visited other nodes, the first at tick 3 (...)". */
static void print_verb_without_subjects(FILE *out, const cause_row *p, const cause_group *group)
{
    const cause_fact *first = &group->listed[0];
    if (group->found == 1)
        fprintf(out, "the %s %s", p->noun, p->verbs[group->change]);
    else
        fprintf(out, "%" PRIu64 " %s %s, the first", group->found, p->plural, p->verbs[group->change]);
    print_tick_of_fact(out, p, first);
    print_values(out, p, group, first);
}

/* Return whether a fact has a subject: the id of a point, or a word. Facts with subjects can share one clause. */
static bool has_subject(const cause_fact *fact)
{
    const json_t *value = fact->b ? fact->b : fact->a;
    return fact->id != CAUSE_NO_ID || json_is_string(value);
}

static void print_group(FILE *out, const cause_group *group, bool brief)
{
    const cause_row p = cause_row_of(group);
    const size_t listed = count_printed_subjects(group, brief), printed = brief && listed > 2 ? 1 : listed;
    if (p.verbs[group->change]) {
        if (has_subject(&group->listed[0]))
            print_group_with_verb(out, &p, group, brief);
        else
            print_verb_without_subjects(out, &p, group);
        return;
    }
    if (group->found > 1 && has_subject(&group->listed[0])) {
        print_group_as_count(out, &p, group, brief);
        return;
    }
    for (size_t i = 0; i < printed; i++) {
        fputs(i ? ", " : "", out);
        print_fact(out, &p, group, &group->listed[i]);
    }
    if (group->found > printed)
        fprintf(out, " and %" PRIu64 " more of this kind", group->found - printed);
}

/* ---- All groups ------------------------------------------------------------------------------------------------ */

void cause_print_facts(FILE *out, const cause_facts *facts, bool brief)
{
    size_t printed[2] = {0, 0}; /* the number of printed major groups, then the number of printed minor groups */
    for (int minor = 0; minor < 2; minor++) {
        if (minor && brief && printed[0] > 0)
            return;
        for (size_t i = 0; i < facts->count; i++) {
            if (cause_row_of(&facts->groups[i]).minor != minor)
                continue;
            if (brief && printed[minor] == CAUSE_BRIEF) {
                fputs(" and more", out);
                break;
            }
            fputs(printed[minor] > 0 ? ", " : printed[0] > 0 ? "; " : "", out);
            print_group(out, &facts->groups[i], brief);
            printed[minor]++;
        }
    }
}

/* ---- The headline -------------------------------------------------------------------------------------------- */

/* Print how many ticks differ because of a different option. */
static void print_differing_tick_count(FILE *out, const cause *c)
{
    if (c->differing.count == 0) /* frames may still differ: shapes and arrows are not compared */
        fputs("the ticks that both sides have are equal", out);
    else if (c->differing.count == c->compared - c->differing.first)
        fprintf(out, "every tick from %" PRIu64 " on differs", c->differing.first);
    else
        fprintf(out, "%" PRIu64 " of %" PRIu64 " ticks differ%s, the first is %" PRIu64, c->differing.count,
                c->compared, verb_ending(c->differing.count), c->differing.first);
}

/* Print which point, key press, edit or query differs first: the facts of the first differing tick. */
static void print_first_difference(FILE *out, const cause *c)
{
    const cause_tick *first = cause_find_tick(c, c->differing.first);
    if (c->differing.count == 0 || !first || first->facts.count == 0) {
        print_differing_tick_count(out, c);
        return;
    }
    fprintf(out, "tick %" PRIu64 ": ", c->differing.first);
    cause_print_facts(out, &first->facts, true);
}

static bool has_option_fact(const cause_facts *facts)
{
    for (size_t i = 0; i < facts->count; i++)
        if (cause_row_of(&facts->groups[i]).option)
            return true;
    return false;
}

/* Print "4 more wrong answers from tick 41 on" or "other wrong answers in 3 ticks from tick 2 on". With `later`,
 * print only differences that begin after the first differing tick; else print only the earlier ones. Return whether
 * anything was printed. */
static bool print_wrong_answer_changes(FILE *out, const cause *c, bool later)
{
    bool any = false;
    for (int i = 0; i < WRONG_CHANGES; i++) {
        const cause_span *span = &c->wrong[i];
        if (span->count == 0 || (span->first > c->differing.first) != later)
            continue;
        fputs(any ? ", " : later ? "; " : "", out);
        if (i == WRONG_OTHER)
            fputs("other wrong answers", out);
        else
            fprintf(out, "%" PRIu64 " %s wrong answer%s", span->count, i == WRONG_MORE ? "more" : "fewer",
                    plural_ending(span->count));
        if (i == WRONG_OTHER && span->count > 1)
            fprintf(out, " in %" PRIu64 " ticks", span->count);
        fprintf(out, span->first == span->last ? " at tick %" PRIu64 : " from tick %" PRIu64 " on", span->first);
        any = true;
    }
    return any;
}

/* Return the number of groups in c->session whose first fact comes after the first differing tick; 0 if this holds for
 * all groups. The groups are sorted by tick, so these groups are the last ones. */
static size_t count_later_groups(const cause *c)
{
    size_t count = 0;
    while (c->differing.count && count < c->session.count) {
        const cause_group *group = &c->session.groups[c->session.count - count - 1];
        if (group->listed[0].tick == CAUSE_NO_TICK || group->listed[0].tick <= c->differing.first)
            break;
        count++;
    }
    return count < c->session.count ? count : 0;
}

/* Wrong answers are printed first, because users compare recordings to find them. Facts that begin after the first
 * differing tick cannot be its cause, so they are printed last. */
void cause_print_headline(FILE *out, const cause *c)
{
    const bool options = has_option_fact(&c->session);
    const size_t later = count_later_groups(c), soon = c->session.count - later;
    if (print_wrong_answer_changes(out, c, false))
        fputs("; ", out);
    if (c->session.count) {
        cause_print_facts(out, &(cause_facts){.groups = c->session.groups, .count = soon}, true);
        fputs(options ? ": " : "; ", out);
        (options ? print_differing_tick_count : print_first_difference)(out, c);
        if (c->view.count == 0 && c->drawn < (c->differing.count ? c->differing.first : CAUSE_NO_TICK))
            fprintf(out, "; frames differ from tick %" PRIu64 " on", c->drawn);
    }
    if (c->view.count) {
        fputs(c->session.count ? "; " : "", out);
        cause_print_facts(out, &c->view, true);
        if (!c->session.count)
            fputs(": the ticks are the same, only the view differs", out);
    }
    if (later) {
        fputs("; ", out);
        cause_print_facts(out, &(cause_facts){.groups = c->session.groups + soon, .count = later}, true);
    }
    print_wrong_answer_changes(out, c, true);
}
