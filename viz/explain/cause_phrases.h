/* SPDX-License-Identifier: MIT */
/* cause_phrases.h - the noun and the verbs with which facts of a place are printed. */
#ifndef EXPLAIN_CAUSE_PHRASES_H
#define EXPLAIN_CAUSE_PHRASES_H

#include "cause_facts.h"

/* How the facts of one place are printed. Without a verb: "another NOUN (8, was 4)", "one more NOUN (...)", "one NOUN
 * fewer (...)". With a verb: "NOUN 12 VERB". */
typedef struct phrase {
    const char *where, *noun, *plural; /* plural null: the noun with an s */
    const char *moved, *added, *gone;  /* the verbs for another, an additional and a missing value; null: no verb */
    bool option;                       /* an option of the whole session: it affects all ticks */
    bool every;                        /* print "at every tick" for facts without a tick */
    bool minor;                        /* print after the other facts; in brief texts only if there are no others */
} phrase;

/* The phrase of a group's place. If the place has no row, the phrase borrows from the group. */
phrase cause_phrase(const cause_group *group);

#endif
