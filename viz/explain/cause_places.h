/* SPDX-License-Identifier: MIT */
/* cause_places.h - the table of places in which two recordings can differ (cause_facts.h). Each row states how the
 * values at its place are compared, and with which noun and verbs facts are printed. */
#ifndef EXPLAIN_CAUSE_PLACES_H
#define EXPLAIN_CAUSE_PLACES_H

#include "cause_facts.h"

/* How two values at a place are compared. */
typedef enum cause_rule {
    /* Choose by the type of the values. Objects are compared member by member, but boxes as one value. Lists of
     * numbers are compared as one value. The elements of lists of words, and of lists of objects with ids, are
     * paired by key. The elements of other lists are paired by similarity. */
    CAUSE_BY_TYPE,
    CAUSE_WHOLE,   /* compare an object as one value */
    CAUSE_BY_KEY,  /* pair the elements of two lists by key: an id, or an action with an id */
    CAUSE_QUERIES, /* pair the queries of two sessions by their parameters */
    CAUSE_ANSWERS  /* pair the answers of two ticks by query, then compare by member */
} cause_rule;

/* A row of the table. With a verb, facts are printed as "NOUN 12 VERB". Without a verb, they are printed as "another
 * NOUN (8, was 4)", "one more NOUN (...)" or "one NOUN fewer (...)". */
typedef struct cause_row {
    const char *where, *noun, *plural; /* plural of the noun; null: the noun and an s */
    const char *verbs[CAUSE_CHANGES];  /* the verb for each cause_change; null: facts are printed without a verb */
    bool option;                       /* the value is an option of the whole session and affects all ticks */
    bool every;                        /* print "at every tick" after facts that have no tick */
    bool minor; /* true: facts are printed last; a brief text prints them only if no other facts exist */
    cause_rule rule;
} cause_row;

cause_rule cause_rule_of(const char *where);

/* Return the table row of a group's place. If the table has no row for the place, return a new row whose texts are
 * stored in the group. */
cause_row cause_row_of(const cause_group *group);

#endif
