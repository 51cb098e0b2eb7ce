/* query_options.c - queries on a command line, and the sentences for those that do not fit. */
#include "query_options.h"
#include "number.h"
#include "options.h"

#include <math.h>
#include <string.h>

/* The numbers of an option, with commas between: at most `most`. False, with the sentence said. */
static bool read_numbers(const char *option, const char *text, double *values, size_t most, size_t *count)
{
    const char *limit = text + strlen(text), *at = text;
    *count = 0;
    for (;;) {
        const size_t length = strcspn(at, ",");
        const char *end = at;
        double value;
        if (!number_parse(at, limit, &end, &value) || end != at + length) {
            trouble("%s: \"%.*s\" in \"%s\" is not a finite number", option, (int)length, at, text);
            return false;
        }
        if (*count < most)
            values[*count] = value;
        ++*count;
        if (*end == 0)
            return true;
        at = end + 1;
    }
}

bool read_nearest(const char *text, octree_query *query)
{
    double values[4];
    size_t count;
    if (!read_numbers("--nearest", text, values, 4, &count))
        return false;
    if (count != 3 && count != 4) {
        trouble("--nearest takes a place, and a number of neighbours where it is not one, as in 1,2,3 or 1,2,3,8, not "
                "\"%s\"",
                text);
        return false;
    }
    if (count == 4 && !(values[3] >= 1 && values[3] < 0x1p53 && values[3] == floor(values[3]))) {
        trouble("--nearest: the number of neighbours is whole, from 1 to %.0f, not so in \"%s\"", 0x1p53 - 1, text);
        return false;
    }
    *query = (octree_query){.kind = count == 4 ? OCTREE_QUERY_KNEAREST : OCTREE_QUERY_NEAREST};
    memcpy(query->target, values, sizeof query->target);
    query->k = count == 4 ? (size_t)values[3] : 1;
    return true;
}

bool read_radius(const char *text, octree_query *query)
{
    double values[4];
    size_t count;
    if (!read_numbers("--radius", text, values, 4, &count))
        return false;
    if (count != 4) {
        trouble("--radius takes a centre and a radius as in 1,2,3,10, not \"%s\"", text);
        return false;
    }
    if (values[3] < 0) {
        trouble("--radius: a radius must not be negative, as in \"%s\"", text);
        return false;
    }
    *query = (octree_query){.kind = OCTREE_QUERY_RADIUS, .radius = values[3]};
    memcpy(query->target, values, sizeof query->target);
    return true;
}

bool read_range(const char *text, octree_query *query)
{
    double values[6];
    size_t count;
    if (!read_numbers("--range", text, values, 6, &count))
        return false;
    if (count != 6) {
        trouble("--range takes two corners as in -10,-10,-10,10,10,10, not \"%s\"", text);
        return false;
    }
    *query = (octree_query){.kind = OCTREE_QUERY_RANGE};
    for (int i = 0; i < 3; i++) {
        query->box.min[i] = values[i];
        query->box.max[i] = values[i + 3];
        if (values[i] > values[i + 3]) {
            trouble("--range: min is above max on %c in \"%s\"", "xyz"[i], text);
            return false;
        }
    }
    return true;
}
