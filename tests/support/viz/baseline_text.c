/* SPDX-License-Identifier: MIT */
/* baseline_text.c - see baseline_text.h. */
#include "baseline_text.h"

#include <stdlib.h>
#include <string.h>

#include "fixture.h"

bool parse_baseline(const char *text, diff_side *side, octreel_error *error)
{
    char *copy = strdup(text);
    assert_non_null(copy);
    *side = (diff_side){.path = "file"};
    const bool ok = baseline_parse(side, copy, strlen(text), error);
    free(copy);
    return ok;
}

diff_side assert_baseline_parsed(const char *text)
{
    diff_side side;
    octreel_error error = {""};
    if (!parse_baseline(text, &side, &error))
        fail_msg("%s", error.text);
    return side;
}

char *write_baseline_text(const diff_side *side)
{
    char *text;
    size_t size;
    octreel_error error;
    FILE *out = open_memstream(&text, &size);
    assert_true(out && baseline_write(out, side, &error) && fclose(out) == 0);
    return text;
}
