/* SPDX-License-Identifier: MIT */
/* test_golden.c - the frames of golden/ are drawn exactly as before.
 *
 * GL draws all of them into the folder golden/ of the build's tests; integers, the default, must give the same. The
 * frames are compared with the references as octreel diff does it. A different frame leaves <name>.ref.difference.png
 * in the current folder, and both renderers are named. `test_golden --draw` only draws: the target golden-update runs
 * it before octreel accept. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "evidence.h"
#include "golden_frames.h"
#include "image_compare.h"
#include "png_read.h"
#include "diff_words.h"
#include "png_write.h"

#define NAME_SIZE 512
#define TEXT_SIZE 256

/* All frames, drawn and compared. */
typedef struct gallery {
    diff_side references, drawn;
    diff_result result;
    char renderer[TEXT_SIZE]; /* the names of the renderers */
} gallery;

/* The frame that one test compares. */
typedef struct exhibit {
    const gallery *gallery;
    const golden_frame *frame;
} exhibit;

static const char *file_name(const golden_frame *frame, char name[NAME_SIZE])
{
    snprintf(name, NAME_SIZE, "%s.ref.png", frame->name);
    return name;
}

/* ---- Drawing ------------------------------------------------------------------------------------------------ */

/* Remove frames that an earlier build has drawn. */
static bool empty_folder(void)
{
    diff_side before;
    octreel_error error;
    mkdir(OCTREEL_DRAWN, 0777);
    if (!diff_side_open(&before, OCTREEL_DRAWN, NULL, &error))
        return fprintf(stderr, "%s\n", error.text) < 0;
    bool ok = true;
    for (size_t i = 0; i < before.count; i++)
        ok = remove(before.frames[i].path) == 0 && ok;
    diff_side_release(&before);
    return ok;
}

static bool draw_one(const golden_frame *frame, char *renderer)
{
    char name[NAME_SIZE], path[2 * NAME_SIZE];
    octreel_error failed = {""};
    octreel_error unwritten = {""};
    image drawn;
    snprintf(path, sizeof path, "%s/%s", OCTREEL_DRAWN, file_name(frame, name));
    bool ok = golden_draw(frame, DRAW_FILL_GL, &drawn, renderer, TEXT_SIZE, &failed);
    if (ok) {
        ok = image_write_png(&drawn, path, NULL, 0, &unwritten);
        image_release(&drawn);
    }
    if (!ok)
        fprintf(stderr, "%s%s\n", failed.text, unwritten.text);
    return ok;
}

static bool draw_all(char *renderer)
{
    if (!empty_folder())
        return false;
    for (size_t i = 0; i < golden_frame_count; i++)
        if (!draw_one(&golden_frames[i], renderer))
            return false;
    FILE *file = fopen(OCTREEL_DRAWN "/renderer.txt", "w");
    const bool written = file && fprintf(file, "%s\n", renderer) > 0;
    return file && fclose(file) == 0 && written;
}

/* ---- Judging ------------------------------------------------------------------------------------------------ */

static bool open_gallery(gallery *g)
{
    const diff_options exact = diff_options_default();
    octreel_error error = {""};
    if (draw_all(g->renderer) && diff_side_open(&g->references, OCTREEL_GOLDEN, NULL, &error) &&
        diff_side_open(&g->drawn, OCTREEL_DRAWN, NULL, &error) &&
        diff_run(&g->references, &g->drawn, &exact, &g->result, &error))
        return true;
    fprintf(stderr, "%s\n", error.text);
    return false;
}

static void close_gallery(gallery *g)
{
    diff_release(&g->result);
    diff_side_release(&g->references);
    diff_side_release(&g->drawn);
}

static void read_renderer(char text[TEXT_SIZE])
{
    FILE *file = fopen(OCTREEL_GOLDEN "/renderer.txt", "r");
    if (!file || !fgets(text, TEXT_SIZE, file))
        snprintf(text, TEXT_SIZE, "unknown");
    text[strcspn(text, "\n")] = 0;
    if (file)
        fclose(file);
}

static void fail_pair(const gallery *g, const diff_pair *pair)
{
    char *sentence = NULL, before[TEXT_SIZE];
    size_t size;
    FILE *out = open_memstream(&sentence, &size);
    assert_non_null(out);
    diff_print_pair(out, pair);
    fclose(out);
    read_renderer(before);
    fail_msg(
        "%s: see its .difference.png and the others beside it, in the current folder.\nreference: %s\nnow:       %s",
        sentence, before, g->renderer);
}

static void frame_equals_its_reference(void **state)
{
    const exhibit *e = *state;
    const diff_options exact = diff_options_default();
    octreel_error error;
    unsigned written;
    char name[NAME_SIZE];
    const diff_pair *pair = diff_find(&e->gallery->result, file_name(e->frame, name));
    assert_non_null(pair);
    if (diff_finding_verdict(pair->finding) == DIFF_SAME)
        return;
    if (!evidence_write_pair(pair, &exact, ".", &written, &error))
        print_error("%s\n", error.text);
    fail_pair(e->gallery, pair);
}

static void integers_draw_the_frame_as_gl_does(void **state)
{
    const exhibit *e = *state;
    char name[NAME_SIZE], path[2 * NAME_SIZE], renderer[TEXT_SIZE];
    octreel_error error = {""};
    image by_gl, by_integers;
    snprintf(path, sizeof path, "%s/%s", OCTREEL_DRAWN, file_name(e->frame, name));
    if (!image_read_png(path, &by_gl, &error) ||
        !golden_draw(e->frame, DRAW_FILL_INTEGERS, &by_integers, renderer, sizeof renderer, &error))
        fail_msg("%s", error.text);
    assert_int_equal(image_compare(&by_gl, &by_integers).unlike.pixels, 0);
    image_release(&by_gl);
    image_release(&by_integers);
}

static void every_reference_has_a_frame(void **state)
{
    const exhibit *e = *state;
    for (size_t i = 0; i < e->gallery->result.count; i++)
        if (e->gallery->result.pairs[i].finding == FOUND_NO_FRAME)
            fail_msg("no test draws %s", e->gallery->result.pairs[i].a->path);
}

static int run_exhibits(gallery *g, struct CMUnitTest *tests, exhibit *exhibits)
{
    const size_t count = golden_frame_count;
    for (size_t i = 0; i < count; i++) {
        exhibits[i] = (exhibit){g, &golden_frames[i]};
        tests[2 * i] = (struct CMUnitTest){
            .name = golden_frames[i].name, .test_func = frame_equals_its_reference, .initial_state = &exhibits[i]};
        tests[2 * i + 1] = (struct CMUnitTest){.name = golden_frames[i].name,
                                               .test_func = integers_draw_the_frame_as_gl_does,
                                               .initial_state = &exhibits[i]};
    }
    exhibits[count] = (exhibit){g, NULL};
    tests[2 * count] = (struct CMUnitTest){.name = "every_reference_has_a_frame",
                                           .test_func = every_reference_has_a_frame,
                                           .initial_state = &exhibits[count]};
    return _cmocka_run_group_tests("golden", tests, 2 * count + 1, NULL, NULL);
}

int main(int argc, char **argv)
{
    gallery g = {.renderer = ""};
    if (argc > 1 && strcmp(argv[1], "--draw") == 0)
        return draw_all(g.renderer) ? 0 : 2;
    struct CMUnitTest *tests = calloc(2 * golden_frame_count + 1, sizeof *tests);
    exhibit *exhibits = calloc(golden_frame_count + 1, sizeof *exhibits);
    const int failed = tests && exhibits && open_gallery(&g) ? run_exhibits(&g, tests, exhibits) : 2;
    close_gallery(&g);
    free(exhibits);
    free(tests);
    return failed;
}
