/* test_golden.c - the frames of golden/ are drawn as they were: exactly.
 *
 * What differs is left in the current folder as <name>.out.png, with <name>.diff.png beside it, and both renderers are
 * named. `test_golden --update` writes the references anew: the target golden-update runs it, nothing else does.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <dirent.h>

#include "golden_frames.h"

#define RENDERER_FILE OCTREEL_GOLDEN "/renderer.txt"
#define NAME_SIZE 512

static void read_renderer(char *text, int size)
{
    FILE *file = fopen(RENDERER_FILE, "r");
    if (!file || !fgets(text, size, file))
        snprintf(text, (size_t)size, "unknown");
    text[strcspn(text, "\n")] = 0;
    if (file)
        fclose(file);
}

static void leave_evidence(const golden_frame *frame, const image *drawn, const image *reference)
{
    char name[NAME_SIZE];
    image_error error;
    image difference;
    snprintf(name, sizeof name, "%s.out.png", frame->name);
    image_write_png(drawn, name, NULL, 0, &error);
    if (!image_draw_difference(reference, drawn, &difference))
        return;
    snprintf(name, sizeof name, "%s.diff.png", frame->name);
    image_write_png(&difference, name, NULL, 0, &error);
    image_release(&difference);
}

static void frame_is_its_reference(void **state)
{
    const golden_frame *frame = *state;
    char renderer[256], before[256], path[NAME_SIZE];
    record_error failed;
    image_error unread;
    image drawn, reference;
    if (!golden_draw(frame, &drawn, renderer, sizeof renderer, &failed))
        fail_msg("%s", failed.text);
    snprintf(path, sizeof path, "%s/%s.ref.png", OCTREEL_GOLDEN, frame->name);
    if (!image_read_png(path, &reference, &unread))
        fail_msg("%s", unread.text);
    const image_difference difference = image_compare(&reference, &drawn);
    if (!image_same(&difference)) {
        leave_evidence(frame, &drawn, &reference);
        read_renderer(before, sizeof before);
        fail_msg("%s differs in %llu pixels, by up to %d, within (%d,%d)-(%d,%d): see %s.out.png and %s.diff.png in "
                 "tests/ of the build folder.\nreference: %s\nnow:       %s",
                 frame->name, (unsigned long long)difference.unlike.pixels, difference.unlike.largest_channel,
                 difference.unlike.min_x, difference.unlike.min_y, difference.unlike.max_x, difference.unlike.max_y,
                 frame->name, frame->name, before, renderer);
    }
    image_release(&drawn);
    image_release(&reference);
}

static bool is_known(const char *file)
{
    for (size_t i = 0; i < golden_frame_count; i++) {
        const size_t length = strlen(golden_frames[i].name);
        if (strncmp(file, golden_frames[i].name, length) == 0 && strcmp(file + length, ".ref.png") == 0)
            return true;
    }
    return false;
}

/* Visit the references that no frame is drawn for. Returns their number. */
static int unknown_references(bool delete)
{
    int count = 0;
    DIR *folder = opendir(OCTREEL_GOLDEN);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        char path[NAME_SIZE];
        if (!strstr(entry->d_name, ".ref.png") || is_known(entry->d_name))
            continue;
        count++;
        printf("nobody draws golden/%s%s\n", entry->d_name, delete ? ": removed" : "");
        snprintf(path, sizeof path, "%s/%s", OCTREEL_GOLDEN, entry->d_name);
        if (delete)
            remove(path);
    }
    if (folder)
        closedir(folder);
    return count;
}

static void every_reference_has_its_frame(void **state)
{
    (void)state;
    assert_int_equal(unknown_references(false), 0);
}

/* A reference with the same pixels stays as it is, so that what is committed is what changed. */
static bool is_unchanged(const char *path, const image *drawn)
{
    image_error unread;
    image reference;
    if (!image_read_png(path, &reference, &unread))
        return false;
    const image_difference difference = image_compare(&reference, drawn);
    image_release(&reference);
    return image_same(&difference);
}

static bool update_one(const golden_frame *frame, char *renderer, size_t size)
{
    char path[NAME_SIZE];
    record_error failed = {""};
    image_error unwritten = {""};
    image drawn;
    bool ok = golden_draw(frame, &drawn, renderer, size, &failed);
    snprintf(path, sizeof path, "%s/%s.ref.png", OCTREEL_GOLDEN, frame->name);
    if (ok) {
        ok = is_unchanged(path, &drawn) || image_write_png(&drawn, path, NULL, 0, &unwritten);
        image_release(&drawn);
    }
    if (!ok)
        fprintf(stderr, "%s%s\n", failed.text, unwritten.text);
    return ok;
}

static int update_all(void)
{
    char renderer[256] = "";
    for (size_t i = 0; i < golden_frame_count; i++)
        if (!update_one(&golden_frames[i], renderer, sizeof renderer))
            return 2;
    unknown_references(true);
    FILE *file = fopen(RENDERER_FILE, "w");
    if (!file)
        return 2;
    const bool written = fprintf(file, "%s\n", renderer) > 0;
    return fclose(file) == 0 && written ? 0 : 2;
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--update") == 0)
        return update_all();
    struct CMUnitTest *tests = calloc(golden_frame_count + 1, sizeof *tests);
    if (!tests)
        return 2;
    for (size_t i = 0; i < golden_frame_count; i++)
        tests[i] = (struct CMUnitTest){.name = golden_frames[i].name,
                                       .test_func = frame_is_its_reference,
                                       .initial_state = (void *)(uintptr_t)&golden_frames[i]};
    tests[golden_frame_count] = (struct CMUnitTest)cmocka_unit_test(every_reference_has_its_frame);
    const int failed = _cmocka_run_group_tests("golden", tests, golden_frame_count + 1, NULL, NULL);
    free(tests);
    return failed;
}
