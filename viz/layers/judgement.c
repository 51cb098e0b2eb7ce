/* SPDX-License-Identifier: MIT */
/* judgement.c - texts about wrong foreign answers, and the order from bad to worse: see judgement.h. */
#include "judgement.h"
#include "number.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

/* A ratio below 1.01 is printed as a percentage, such as "0.5% farther"; other ratios are printed as a factor. */
#define PERCENT_BELOW 1.01

static void print_ratio(double ratio, char text[JUDGEMENT_TEXT])
{
    char number[NUMBER_TEXT];
    if (isinf(ratio))
        snprintf(text, JUDGEMENT_TEXT, "infinite ratio");
    else if (ratio < PERCENT_BELOW)
        snprintf(text, JUDGEMENT_TEXT, "%s%% farther", number_format((ratio - 1) * 100, 2, number));
    else
        snprintf(text, JUDGEMENT_TEXT, "%s times as far", number_format(ratio, 3, number));
}

static void print_counts(size_t missing, size_t extra, char text[JUDGEMENT_TEXT])
{
    if (missing && extra)
        snprintf(text, JUDGEMENT_TEXT, "%zu missing, %zu extra", missing, extra);
    else
        snprintf(text, JUDGEMENT_TEXT, "%zu %s", missing ? missing : extra, missing ? "missing" : "extra");
}

const char *judgement_text(const octree_judgement *judgement, char text[JUDGEMENT_TEXT])
{
    switch (judgement->wrong) {
    case OCTREE_WRONG_UNKNOWN:
        snprintf(text, JUDGEMENT_TEXT, "no point has id %" PRIu64, judgement->wrong_id);
        break;
    case OCTREE_WRONG_DUPLICATE:
        snprintf(text, JUDGEMENT_TEXT, "%" PRIu64 " is listed twice", judgement->wrong_id);
        break;
    case OCTREE_WRONG_SKIPPED:
        snprintf(text, JUDGEMENT_TEXT, "%" PRIu64 " is left out", judgement->wrong_id);
        break;
    case OCTREE_WRONG_COUNT:
        snprintf(text, JUDGEMENT_TEXT, "%zu points, not %zu", judgement->given_count, judgement->expected);
        break;
    case OCTREE_WRONG_FARTHER:
        print_ratio(judgement->ratio, text);
        break;
    case OCTREE_WRONG_MISSING:
    case OCTREE_WRONG_EXTRA:
        print_counts(judgement->missing_count, judgement->extra_count, text);
        break;
    default:
        snprintf(text, JUDGEMENT_TEXT, "right");
        break;
    }
    return text;
}

const char *pair_judgement_text(const octree_pair_judgement *judgement, char text[JUDGEMENT_TEXT])
{
    const octree_pair *pair = &judgement->wrong_pair;
    if (judgement->wrong == OCTREE_WRONG_UNKNOWN)
        snprintf(text, JUDGEMENT_TEXT, "no body has id %" PRIu64, pair->a);
    else if (judgement->wrong == OCTREE_WRONG_DUPLICATE)
        snprintf(text, JUDGEMENT_TEXT, "%" PRIu64 " and %" PRIu64 " twice", pair->a, pair->b);
    else
        print_counts(judgement->missing_count, judgement->extra_count, text);
    return text;
}

bool judgement_is_worse(const octree_judgement *judgement, const octree_judgement *than)
{
    if (judgement->ratio != than->ratio)
        return judgement->ratio > than->ratio;
    return judgement->missing_count + judgement->extra_count > than->missing_count + than->extra_count;
}

size_t judgement_count_wrong(const octree_answer *answers, size_t count, size_t *worst)
{
    size_t wrong = 0;
    for (size_t i = 0; i < count; i++)
        if (answers[i].judgement.wrong &&
            (wrong++ == 0 || judgement_is_worse(&answers[i].judgement, &answers[*worst].judgement)))
            *worst = i;
    return wrong;
}
