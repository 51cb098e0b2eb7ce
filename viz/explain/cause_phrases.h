/* SPDX-License-Identifier: MIT */
/* cause_phrases.h - how facts are named in sentences, by their places. */
#ifndef EXPLAIN_CAUSE_PHRASES_H
#define EXPLAIN_CAUSE_PHRASES_H

#include "cause_facts.h"

/* How the facts of one place are printed: "another NOUN (8, was 4)", "one more NOUN (...)", "one NOUN fewer (...)"; or,
 * with a verb, "NOUN 12 VERB". */
typedef struct phrase {
    const char *where, *noun, *plural; /* null: the noun and an s */
    const char *moved, *added, *gone;  /* the verbs for each change */
    bool option;                       /* of the whole session: it affects all ticks */
    bool every;                        /* "at every tick" is printed where a fact is of no single one */
    bool minor;                        /* printed after the others; in a brief text only if there are no others */
} phrase;

/* The phrase of a group's place. One without a row is named by its path, of which the phrase refers to a part: keep the
 * group as long. */
phrase cause_phrase(const cause_group *group);

#endif
