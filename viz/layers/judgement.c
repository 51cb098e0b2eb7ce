/* SPDX-License-Identifier: MIT */
#include "judgement.h"
#include "number.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

/* Below this a ratio is told by what it is above 1. */
#define NEARLY 1.01

static void print_ratio(double ratio, char text[JUDGEMENT_WORDS])
{
    char number[NUMBER_TEXT];
    if (isinf(ratio))
        snprintf(text, JUDGEMENT_WORDS, "infinite ratio");
    else if (ratio < NEARLY)
        snprintf(text, JUDGEMENT_WORDS, "%s%% farther", number_text((ratio - 1) * 100, 2, number));
    else
        snprintf(text, JUDGEMENT_WORDS, "%s times as far", number_text(ratio, 3, number));
}

static void print_points(const octree_judgement *made, char text[JUDGEMENT_WORDS])
{
    if (made->missing_count && made->extra_count)
        snprintf(text, JUDGEMENT_WORDS, "%zu missed, %zu extra", made->missing_count, made->extra_count);
    else if (made->missing_count)
        snprintf(text, JUDGEMENT_WORDS, "%zu missed", made->missing_count);
    else
        snprintf(text, JUDGEMENT_WORDS, "%zu extra", made->extra_count);
}

const char *judgement_words(const octree_judgement *made, char text[JUDGEMENT_WORDS])
{
    switch (made->wrong) {
    case OCTREE_WRONG_UNKNOWN:
        snprintf(text, JUDGEMENT_WORDS, "no point has id %" PRIu64, made->wrong_id);
        break;
    case OCTREE_WRONG_DUPLICATE:
        snprintf(text, JUDGEMENT_WORDS, "%" PRIu64 " is named twice", made->wrong_id);
        break;
    case OCTREE_WRONG_SKIPPED:
        snprintf(text, JUDGEMENT_WORDS, "%" PRIu64 " is left out", made->wrong_id);
        break;
    case OCTREE_WRONG_COUNT:
        snprintf(text, JUDGEMENT_WORDS, "%zu named, not %zu", made->given_count, made->expected);
        break;
    case OCTREE_WRONG_FARTHER:
        print_ratio(made->ratio, text);
        break;
    case OCTREE_WRONG_MISSING:
    case OCTREE_WRONG_EXTRA:
        print_points(made, text);
        break;
    default:
        snprintf(text, JUDGEMENT_WORDS, "right");
        break;
    }
    return text;
}

const octree_point *judgement_point(const octree_judgement *made)
{
    return made->missing_count ? made->missing : made->extra_count ? made->extra : NULL;
}

bool judgement_is_worse(const octree_judgement *made, const octree_judgement *than)
{
    if (made->ratio != than->ratio)
        return made->ratio > than->ratio;
    return made->missing_count + made->extra_count > than->missing_count + than->extra_count;
}

size_t judgement_count(const octree_answer *answers, size_t count, size_t *worst)
{
    size_t wrong = 0;
    for (size_t i = 0; i < count; i++)
        if (answers[i].judgement.wrong &&
            (wrong++ == 0 || judgement_is_worse(&answers[i].judgement, &answers[*worst].judgement)))
            *worst = i;
    return wrong;
}
