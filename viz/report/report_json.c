/* SPDX-License-Identifier: MIT */
/* report_json.c - writes a comparison as JSON. */
#include "report_json.h"
#include "cause_json.h"
#include "contact_sheet.h"
#include "diff_words.h"
#include "ticks_write.h"

#include <stdlib.h>
#include <string.h>

/* Write the members that describe a rule. */
static void write_rule_members(json_writer *w, const baseline_rule *rule)
{
    json_write_text_member(w, "file", rule->file);
    json_write_integer_member(w, "line", rule->line);
    json_write_text_member(w, "pattern", rule->pattern);
    if (rule->date)
        json_write_text_member(w, "date", rule->date);
    if (rule->expires)
        json_write_text_member(w, "expires", rule->expires);
    json_write_text_member(w, "reason", rule->reason);
}

static void write_rules(json_writer *w, const diff_result *result)
{
    json_begin_array_member(w, "rules");
    for (size_t i = 0; i < result->rule_count; i++) {
        json_write_begin_object(w);
        write_rule_members(w, &result->rules[i]);
        json_write_integer_member(w, "frames", result->rules[i].matched);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_two_numbers(json_writer *w, const char *key, int a, int b)
{
    json_write_key(w, key);
    json_write_numbers(w, (double[]){a, b}, 2);
}

static void write_side(json_writer *w, const char *key, const diff_side *side)
{
    json_begin_object_member(w, key);
    json_write_text_member(w, "path", side->path);
    json_write_text_member(w, "kind", diff_kind_name(side->kind));
    json_write_integer_member(w, "frames", side->count);
    json_write_end_object(w);
}

/* Write a comma-separated list of layers as a JSON array of strings. */
static void write_layers(json_writer *w, const char *layers)
{
    char name[64];
    for (const char *at = layers; *at; at += *at == ',') {
        const size_t length = strcspn(at, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        json_write_string(w, name);
        at += length;
    }
}

static void write_tolerance(json_writer *w, const diff_result *result)
{
    const diff_options *options = &result->options;
    const image_tolerance *t = &options->tolerance;
    const image_color ground = options->background;
    char color[8];
    json_begin_object_member(w, "tolerance");
    json_write_integer_member(w, "max_pixels", t->max_pixels);
    json_write_number_member(w, "max_delta", t->max_delta);
    json_write_text_member(w, "delta_unit", IMAGE_DELTA_UNIT);
    if (t->max_share > 0)
        json_write_number_member(w, "max_share", t->max_share);
    if (t->max_channel > 0)
        json_write_integer_member(w, "max_channel", (uint64_t)t->max_channel);
    if (t->flip) {
        json_write_number_member(w, "max_flip", t->max_flip);
        json_write_number_member(w, "pixels_per_degree", t->pixels_per_degree);
    }
    json_write_bool_member(w, "antialias", t->antialias);
    json_begin_array_member(w, "ignore");
    for (size_t i = 0; i < t->ignored_count; i++) {
        const image_rectangle *r = &t->ignored[i];
        json_write_numbers(w, (double[]){r->x, r->y, r->width, r->height}, 4);
    }
    json_write_end_array(w);
    json_begin_array_member(w, "ignore_layers");
    if (options->ignored_layers)
        write_layers(w, options->layers);
    json_write_end_array(w);
    json_write_end_object(w);
    snprintf(color, sizeof color, "#%02x%02x%02x", ground.r, ground.g, ground.b);
    json_write_text_member(w, "background", color);
    json_write_integer_member(w, "color_spaces_ignored", diff_count_color_spaces(result));
}

static void write_tally(json_writer *w, const char *key, const image_tally *t)
{
    json_begin_object_member(w, key);
    json_write_integer_member(w, "pixels", t->pixels);
    if (t->pixels > 0) {
        json_write_number_member(w, "worst_delta", t->worst_delta);
        write_two_numbers(w, "worst_at", t->worst_x, t->worst_y);
        json_write_integer_member(w, "largest_channel", (uint64_t)t->largest_channel);
        write_two_numbers(w, "min", t->min_x, t->min_y);
        write_two_numbers(w, "max", t->max_x, t->max_y);
    }
    json_write_end_object(w);
}

static void write_flip(json_writer *w, const image_flip *flip)
{
    json_begin_object_member(w, "flip");
    json_write_number_member(w, "mean", flip->mean);
    json_write_number_member(w, "worst", flip->worst);
    if (flip->worst > 0)
        write_two_numbers(w, "worst_at", flip->worst_x, flip->worst_y);
    json_write_end_object(w);
}

static void write_difference(json_writer *w, const image_difference *d)
{
    json_write_integer_member(w, "channel_range", (uint64_t)d->channel_range);
    write_tally(w, "unlike", &d->unlike);
    write_tally(w, "counted", &d->counted);
    json_write_integer_member(w, "close", d->close);
    json_write_integer_member(w, "antialiased", d->antialiased);
    json_write_integer_member(w, "ignored", d->ignored);
    if (d->has_flip)
        write_flip(w, &d->flip);
}

void diff_json_finding(json_writer *w, const diff_report *report, size_t i)
{
    const diff_pair *pair = &report->result->pairs[i];
    const char *cause = explanation_cause(report->why, i);
    char digest[DIGEST_TEXT];
    json_write_text_member(w, "frame", diff_pair_name(pair));
    json_write_text_member(w, "finding", diff_finding_name(pair->finding));
    if (pair->about[0].width)
        write_two_numbers(w, "reference_size", pair->about[0].width, pair->about[0].height);
    if (pair->about[1].width)
        write_two_numbers(w, "frame_size", pair->about[1].width, pair->about[1].height);
    if (pair->finding == FOUND_PIXELS || pair->finding == FOUND_WITHIN)
        write_difference(w, &pair->difference);
    if (pair->finding == FOUND_DIGEST) {
        json_write_text_member(w, "reference_digest", digest_print(pair->about[0].pixels, digest));
        json_write_text_member(w, "frame_digest", digest_print(pair->about[1].pixels, digest));
    }
    if (pair->flaky)
        json_write_text_member(w, "flaky", pair->flaky);
    if (pair->trouble)
        json_write_text_member(w, "trouble", pair->trouble);
    if (pair->no_picture)
        json_write_text_member(w, "no_picture", pair->no_picture);
    if (pair->effect != RULE_UNUSED) {
        json_begin_object_member(w, "rule");
        json_write_text_member(w, "effect", diff_rule_effect_name(pair->effect));
        write_rule_members(w, pair->rule);
        json_write_end_object(w);
    }
    if (cause)
        json_write_text_member(w, "cause", cause);
}

static void write_evidence(json_writer *w, const diff_report *report, size_t i)
{
    json_begin_object_member(w, "evidence");
    for (int picture = 0; picture < EVIDENCE_PICTURES; picture++) {
        char *path = evidence_path(report->evidence, report->result, i, (evidence_picture)picture);
        if (path)
            json_write_text_member(w, evidence_picture_name((evidence_picture)picture), path);
        free(path);
    }
    json_write_end_object(w);
}

static void write_findings(json_writer *w, const diff_report *report)
{
    json_begin_array_member(w, "findings");
    for (size_t i = 0; i < report->result->count; i++) {
        const diff_pair *pair = &report->result->pairs[i];
        if (!diff_is_listed(pair->finding))
            continue;
        json_write_begin_object(w);
        diff_json_finding(w, report, i);
        if (report->evidence && report->evidence->pictures[i])
            write_evidence(w, report, i);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

/* Write the names of all frames of a group. Each listed frame is in exactly one group. */
void diff_json_group_frames(json_writer *w, const diff_report *report, size_t group)
{
    const frame_group *g = &report->groups->groups[group];
    json_begin_array_member(w, "frames");
    for (size_t i = g->first; i <= g->last; i++)
        if (report->groups->of[i] == group)
            json_write_string(w, diff_pair_name(&report->result->pairs[i]));
    json_write_end_array(w);
}

static void write_groups(json_writer *w, const diff_report *report)
{
    json_begin_array_member(w, "groups");
    for (size_t i = 0; i < report->groups->count; i++) {
        const frame_group *g = &report->groups->groups[i];
        json_write_begin_object(w);
        json_write_text_member(w, "finding", diff_finding_name(report->result->pairs[g->first].finding));
        if (g->cause)
            json_write_text_member(w, "cause", g->cause);
        diff_json_group_frames(w, report, i);
        json_write_end_object(w);
    }
    json_write_end_array(w);
}

static void write_counts(json_writer *w, const diff_result *result)
{
    json_write_integer_member(w, "frames", result->count);
    json_begin_object_member(w, "found");
    for (int i = 0; i < DIFF_FINDINGS; i++)
        json_write_integer_member(w, diff_finding_name((diff_finding)i), result->found[i]);
    json_write_end_object(w);
}

void diff_json_summary(json_writer *w, const diff_report *report)
{
    const diff_result *result = report->result;
    const explanation *why = report->why;
    json_write_text_member(w, "verdict", diff_verdict_name(explanation_verdict(why, result)));
    if (why->headline)
        json_write_text_member(w, "headline", why->headline);
    if (why->trouble)
        json_write_text_member(w, "trouble", why->trouble);
    write_side(w, "reference", report->a);
    write_side(w, "compared", report->b);
    write_tolerance(w, result);
    if (result->rule_count > 0)
        write_rules(w, result);
    write_counts(w, result);
}

static void write_evidence_folder(json_writer *w, const diff_report *report)
{
    const evidence *e = report->evidence;
    char *page = path_join(e->folder, EVIDENCE_PAGE), *sheet = path_join(e->folder, CONTACT_SHEET);
    json_begin_object_member(w, "evidence");
    json_write_text_member(w, "folder", e->folder);
    if (page)
        json_write_text_member(w, "page", page);
    if (sheet && frame_groups_count_failing(report->groups, report->result) > 0)
        json_write_text_member(w, "contact_sheet", sheet);
    json_write_end_object(w);
    free(sheet);
    free(page);
}

void diff_report_json(FILE *out, const diff_report *report)
{
    json_writer writer = {.out = out}, *w = &writer;
    json_write_begin_object(w);
    json_write_text_member(w, "octreel", "diff");
    json_write_integer_member(w, "version", DIFF_REPORT_JSON_VERSION);
    diff_json_summary(w, report);
    if (report->evidence)
        write_evidence_folder(w, report);
    write_findings(w, report);
    write_groups(w, report);
    if (report->why->recordings) {
        json_write_key(w, "cause");
        cause_write_json(w, report->why);
    }
    json_write_end_object(w);
    json_write_end_line(w);
}
