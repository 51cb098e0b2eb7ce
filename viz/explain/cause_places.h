/* SPDX-License-Identifier: MIT */
/* cause_places.h - the table of places in which two recordings can differ (cause_facts.h): how the values at a place
 * are compared, and with which noun and verbs its facts are printed. */
#ifndef EXPLAIN_CAUSE_PLACES_H
#define EXPLAIN_CAUSE_PLACES_H

#include "cause_facts.h"

/* How two values at a place are compared. */
typedef enum cause_rule {
    CAUSE_BY_TYPE, /* objects by member, but boxes as one value; lists of numbers as one value, of words and of objects
                      with ids by key, others by similarity */
    CAUSE_WHOLE,   /* an object as one value */
    CAUSE_BY_KEY,  /* lists of ids and of actions with ids: by key */
    CAUSE_QUERIES, /* queries of a session: paired by their parameters */
    CAUSE_ANSWERS  /* answers of a tick: paired by their queries, then compared by member */
} cause_rule;

/* Without a verb, facts are printed as "another NOUN (8, was 4)", "one more NOUN (...)", "one NOUN fewer (...)". With a
 * verb: "NOUN 12 VERB". */
typedef struct cause_row {
    const char *where, *noun, *plural; /* plural null: the noun with an s */
    const char *verbs[CAUSE_CHANGES];  /* for each cause_change; null: no verb */
    bool option;                       /* an option of the whole session: it affects all ticks */
    bool every;                        /* print "at every tick" for facts without a tick */
    bool minor;                        /* print after the other facts; in brief texts only if there are no others */
    cause_rule rule;
} cause_row;

cause_rule cause_rule_of(const char *where);

/* The row of a group's place. If the table has none, the row borrows from the group. */
cause_row cause_row_of(const cause_group *group);

#endif
