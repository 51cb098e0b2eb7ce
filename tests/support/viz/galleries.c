/* SPDX-License-Identifier: MIT */
/* galleries.c - see galleries.h. */
#include "galleries.h"
#include "fixture.h"
#include "png_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

image gallery_picture(uint64_t seed)
{
    image made;
    uint64_t state = seed + 1;
    assert_true(image_create(&made, GALLERY_WIDTH, GALLERY_HEIGHT, 3));
    for (int n = 0; n < GALLERY_WIDTH * GALLERY_HEIGHT * 3; n++)
        made.pixels[n] = (uint8_t)random_below(&state, 256);
    return made;
}

void gallery_write(const char *path, uint64_t seed, int spoilt)
{
    image picture = gallery_picture(seed);
    octreel_error error = {""};
    for (int i = 0; i < spoilt; i++)
        picture.pixels[3 * (3 * GALLERY_WIDTH + i) + 1] ^= 1;
    if (!image_write_png(&picture, path, NULL, 0, &error))
        fail_msg("%s", error.text);
    image_release(&picture);
}

place gallery_make(const temp_folder *in, const char *folder, const char *names)
{
    char list[512];
    const place made = place_in(in, folder);
    uint64_t seed = 0;
    assert_int_equal(mkdir(made.path, 0777), 0);
    assert_true(strlen(names) < sizeof list);
    strcpy(list, names);
    for (char *name = strtok(list, " "); name; name = strtok(NULL, " ")) {
        octreel_error error = {""};
        if (!folder_create_parents(made.path, name, &error))
            fail_msg("%s", error.text);
        gallery_write(place_below(made.path, name).path, seed++, 0);
    }
    return made;
}

diff_side assert_side(const char *path)
{
    diff_side side;
    octreel_error error = {""};
    if (!diff_side_open(&side, path, NULL, &error))
        fail_msg("%s", error.text);
    return side;
}

comparison_of assert_compared(const char *a, const char *b, const diff_options *options)
{
    const diff_options exact = diff_options_default();
    comparison_of made = {.a = assert_side(a), .b = assert_side(b)};
    octreel_error error = {""};
    if (!diff_run(&made.a, &made.b, options ? options : &exact, &made.result, &error))
        fail_msg("%s", error.text);
    return made;
}

const frame_groups *group_frames(comparison_of *made, bool each)
{
    octreel_error error;
    frame_groups_release(&made->groups);
    assert_true(frame_groups_make(&made->groups, &made->result, &made->why, each, &error));
    return &made->groups;
}

char *list_groups(comparison_of *made, bool each, bool others)
{
    const frame_groups *g = group_frames(made, each);
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    for (size_t i = 0; i < g->count; i++)
        fprintf(out, "%s\n", others ? g->groups[i].others : g->groups[i].frames);
    assert_int_equal(fclose(out), 0);
    return text;
}

void assert_groups(comparison_of *made, bool each, const char *expected)
{
    char *text = list_groups(made, each, false);
    assert_string_equal(text, expected);
    free(text);
}

const char *find_cause_text(const comparison_of *made, const char *name)
{
    const diff_pair *pair = diff_find(&made->result, name);
    if (!pair)
        fail_msg("there is no pair %s", name);
    return explanation_cause(&made->why, (size_t)(pair - made->result.pairs));
}

void set_cause(comparison_of *made, size_t i, const char *text)
{
    explanation *why = &made->why;
    if (!why->pairs)
        why->pairs = calloc(why->count = made->result.count, sizeof *why->pairs);
    assert_non_null(why->pairs);
    why->pairs[i].text = strdup(text);
}

void comparison_release(comparison_of *made)
{
    frame_groups_release(&made->groups);
    explanation_release(&made->why);
    diff_release(&made->result);
    diff_side_release(&made->a);
    diff_side_release(&made->b);
}

diff_finding find_finding(const comparison_of *made, const char *name)
{
    const diff_pair *pair = diff_find(&made->result, name);
    if (!pair)
        fail_msg("there is no pair %s", name);
    return pair->finding;
}

void assert_not_compared(const char *a, const char *b, const diff_options *options, const char *part)
{
    const diff_options exact = diff_options_default();
    diff_side sides[2] = {assert_side(a), assert_side(b)};
    diff_result result;
    octreel_error error = {""};
    assert_false(diff_run(&sides[0], &sides[1], options ? options : &exact, &result, &error));
    assert_contains(error.text, part);
    diff_side_release(&sides[0]);
    diff_side_release(&sides[1]);
}
