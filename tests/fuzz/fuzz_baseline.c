/* SPDX-License-Identifier: MIT */
/* fuzz_baseline.c - libFuzzer entry for baselines: whatever the reader accepts is written and read back unchanged.
 * Build with clang -fsanitize=fuzzer,address,undefined.
 */
#include "baseline.h"
#include "rule.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static bool parse(const void *data, size_t size, diff_side *side)
{
    octreel_error error = {""};
    char *text = malloc(size + 1);
    if (!text)
        abort();
    memcpy(text, data, size);
    text[size] = 0;
    *side = (diff_side){.path = "fuzz"};
    const bool ok = baseline_parse(side, text, size, &error);
    if (!ok && error.text[0] == 0)
        abort();
    free(text);
    return ok;
}

static char *write_side(const diff_side *side, size_t *size)
{
    octreel_error error;
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    if (!out || !baseline_write(out, side, &error) || fclose(out) != 0)
        abort();
    return text;
}

static void check_round_trip(const diff_side *side)
{
    diff_side again;
    size_t size, size_again;
    char *text = write_side(side, &size);
    if (!parse(text, size, &again))
        abort();
    char *text_again = write_side(&again, &size_again);
    if (size != size_again || memcmp(text, text_again, size) != 0)
        abort();
    free(text_again);
    free(text);
    diff_side_release(&again);
}

/* The rule of a frame can be applied to a frame of any size. */
static void check_rules(const diff_side *side)
{
    for (size_t i = 0; i < side->count; i++) {
        const baseline_rule *rule = rule_find(side, side->frames[i].name);
        pixel_mask mask = {0};
        octreel_error error;
        if (rule && !rule->mask && !rule_add_mask(rule, 24, 16, &mask, &error))
            abort();
        if (rule && (!rule->reason || rule_has_expired(rule, "")))
            abort();
        mask_release(&mask);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    diff_side side;
    if (size == 0)
        return 0;
    if (parse(data, size, &side)) {
        check_round_trip(&side);
        check_rules(&side);
    }
    diff_side_release(&side);
    return 0;
}
