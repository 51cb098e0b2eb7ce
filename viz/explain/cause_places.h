/* SPDX-License-Identifier: MIT */
/* cause_places.h - the table of places in which two recordings can differ (cause_facts.h). It says how the values at
 * a place are compared, and with which noun and verbs facts are printed. */
#ifndef EXPLAIN_CAUSE_PLACES_H
#define EXPLAIN_CAUSE_PLACES_H

#include "cause_facts.h"

/* How two values at a place are compared. */
typedef enum cause_rule {
    /* By the type of the values. Objects are compared by member, but boxes as one value. Lists of numbers are compared
     * as one value. Lists of words and of objects with ids are compared by key, other lists by similarity. */
    CAUSE_BY_TYPE,
    CAUSE_WHOLE,   /* compare an object as one value */
    CAUSE_BY_KEY,  /* pair the elements of a list by key: ids, or actions with ids */
    CAUSE_QUERIES, /* pair the queries of a session by their parameters */
    CAUSE_ANSWERS  /* pair the answers of a tick by their queries, then compare by member */
} cause_rule;

/* A row of the table. With a verb, facts are printed as "NOUN 12 VERB". Without a verb, they are printed as "another
 * NOUN (8, was 4)", "one more NOUN (...)" or "one NOUN fewer (...)". */
typedef struct cause_row {
    const char *where, *noun, *plural; /* if plural is null, it is the noun and an s */
    const char *verbs[CAUSE_CHANGES];  /* the verb for each cause_change; null: no verb */
    bool option;                       /* the value is an option of the whole session and affects all ticks */
    bool every;                        /* print "at every tick" after facts that have no tick */
    bool minor;                        /* print such facts last; in brief texts only if there are no others */
    cause_rule rule;
} cause_row;

cause_rule cause_rule_of(const char *where);

/* Return the row of a group's place. If the table has no such row, return a row whose texts belong to the group. */
cause_row cause_row_of(const cause_group *group);

#endif
