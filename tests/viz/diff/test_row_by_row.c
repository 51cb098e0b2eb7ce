/* SPDX-License-Identifier: MIT */
/* test_row_by_row.c - comparing pictures row by row finds the same as comparing whole pictures. */
#include "diff.h"
#include "images.h"
#include "naive_compare.h"
#include "stored_png.h"
#include "temp_folder.h"
#include "image_digest.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static const image_color ground = {20, 120, 240};

static uint64_t next_random(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state >> 33;
}

static int within(uint64_t *state, int least, int most)
{
    return least + (int)(next_random(state) % (uint64_t)(most - least + 1));
}

/* ---- Files --------------------------------------------------------------------------------------------------- */

static size_t load(const char *path, uint8_t **bytes)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    *bytes = malloc(1 << 20);
    assert_non_null(*bytes);
    const size_t size = fread(*bytes, 1, 1 << 20, file);
    assert_true(size < 1 << 20);
    fclose(file);
    return size;
}

static void save(const char *path, const uint8_t *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Cut short, or with a byte changed, anywhere; or behind the header, where all the rows are. */
static void damage(const char *path, uint64_t *random)
{
    uint8_t *bytes;
    size_t size = load(path, &bytes);
    const size_t from = next_random(random) % 2 ? 0 : 200 % size;
    const size_t at = from + next_random(random) % (size - from);
    if (next_random(random) % 2)
        size = at;
    else
        bytes[at] ^= (uint8_t)(1 << next_random(random) % 8);
    save(path, bytes, size);
    free(bytes);
}

/* ---- The same rows ------------------------------------------------------------------------------------------- */

static void assert_same_but_pixels(const image *a, const image *b)
{
    assert_true(a->width == b->width && a->height == b->height);
    assert_true(a->channels == b->channels && a->wide == b->wide && a->transparent == b->transparent);
    assert_memory_equal(&a->palette, &b->palette, sizeof a->palette);
}

/* Up to where it fails, when it does. */
static bool read_in_bands(const char *path, int rows, const image *whole, octreel_error *error)
{
    image_source *source = image_source_open(path, ground, false, error);
    if (!source)
        return false;
    const image *about = image_source_description(source);
    int y = 0;
    for (image band; image_source_read_band(source, rows, &band); y += band.height) {
        const size_t size = (size_t)band.width * image_pixel_size(&band);
        assert_true(band.height == rows || y + band.height == about->height);
        if (whole->pixels)
            assert_memory_equal(band.pixels, whole->pixels + (size_t)y * size, size * (size_t)band.height);
    }
    const bool ok = !image_source_has_failed(source);
    assert_true(!ok || y == about->height);
    if (whole->pixels)
        assert_same_but_pixels(about, whole);
    image_source_close(source);
    return ok;
}

static void assert_digest_alike(const char *path, const image *whole, const char *trouble)
{
    image about;
    octreel_error error = {""};
    uint64_t digest;
    const bool read = image_digest_png(IMAGE_DIGEST_NEWEST, path, ground, &about, &digest, &error);
    assert_int_equal(read, whole->pixels != NULL);
    assert_string_equal(error.text, trouble);
    if (!read)
        return;
    assert_null(about.pixels);
    assert_same_but_pixels(&about, whole);
    assert_true(digest == image_digest(whole));
}

static void assert_read_alike(const char *path, int rows)
{
    image whole;
    octreel_error errors[2] = {{""}, {""}};
    const bool read = image_read_png_over(path, ground, &whole, &errors[0]);
    assert_int_equal(read_in_bands(path, rows, &whole, &errors[1]), read);
    assert_string_equal(errors[0].text, errors[1].text);
    assert_digest_alike(path, &whole, errors[0].text);
    image_release(&whole);
}

static stored_png random_picture(uint64_t *random, int storage)
{
    return (stored_png){.width = within(random, 1, 60),
                        .height = within(random, 1, 40),
                        .storage = png_storage_at(storage),
                        .seed = next_random(random),
                        .spoiling_seed = next_random(random),
                        .spoiled = within(random, 0, 50)};
}

static void rows_equal_those_of_the_whole_picture(void **state)
{
    const char *path = temp_file(*state, "a.png");
    uint64_t random = 1;
    for (int i = 0; i < 3 * PNG_STORAGES; i++) {
        stored_png picture = random_picture(&random, i % PNG_STORAGES);
        picture.width = i % 5 ? picture.width : within(&random, 1000, 2000); /* of more than one usual band */
        stored_png_save(&picture, path);
        assert_read_alike(path, within(&random, 1, i % 3 ? 9 : 60));
    }
}

static void damaged_files_fail_with_the_same_error(void **state)
{
    const char *path = temp_file(*state, "a.png");
    uint64_t random = 2;
    for (int i = 0; i < 8 * PNG_STORAGES; i++) {
        const stored_png picture = random_picture(&random, i % PNG_STORAGES);
        stored_png_save(&picture, path);
        damage(path, &random);
        assert_read_alike(path, within(&random, 1, 9));
    }
}

/* ---- The same findings --------------------------------------------------------------------------------------- */

static diff_finding expected_finding(const image_difference *difference, const image_tolerance *tolerance)
{
    if (!difference->same_size)
        return FOUND_SIZE;
    if (image_has_no_difference(difference))
        return FOUND_SAME_PIXELS;
    return image_is_within_tolerance(difference, tolerance) ? FOUND_WITHIN : FOUND_PIXELS;
}

static void assert_same_finding(const diff_pair *pair, const image images[2], const image_tolerance *tolerance)
{
    const image_difference expected = naive_compare(&images[0], &images[1], tolerance);
    assert_null(pair->trouble);
    assert_same_difference(&pair->difference, &expected);
    assert_int_equal(pair->finding, expected_finding(&expected, tolerance));
    assert_int_equal(pair->transparent, images[0].transparent || images[1].transparent);
    for (int i = 0; i < 2; i++)
        assert_true(pair->about[i].width == images[i].width && pair->about[i].height == images[i].height);
}

/* Compare both files as octreel diff does, and as they are in memory. */
static void assert_compared_alike(char *paths[2], const image_tolerance *tolerance)
{
    const diff_frame frames[2] = {{.name = "a.png", .path = paths[0]}, {.name = "b.png", .path = paths[1]}};
    const diff_options options = {.tolerance = *tolerance, .background = ground};
    diff_pair pair = {.a = &frames[0], .b = &frames[1]};
    image images[2];
    octreel_error errors[2];
    bool read[2];
    for (int i = 0; i < 2; i++)
        read[i] = image_read_png_over(paths[i], ground, &images[i], &errors[i]);
    compare_pixels(&pair, &options);
    if (read[0] && read[1]) {
        assert_same_finding(&pair, images, tolerance);
    } else {
        assert_int_equal(pair.finding, FOUND_UNREADABLE);
        assert_string_equal(pair.trouble, errors[read[0] ? 1 : 0].text);
    }
    free(pair.trouble);
    image_release(&images[0]);
    image_release(&images[1]);
}

static image_tolerance random_tolerance(uint64_t *random)
{
    static const image_rectangle ignored[] = {{30, 20, 50, 40}, {-4, -4, 100, 9}, {150, 60, 2147483647, 2147483647}};
    return (image_tolerance){.max_pixels = next_random(random) % 4 ? 0 : next_random(random) % 300,
                             .max_delta = next_random(random) % 2 ? 0 : (double)(next_random(random) % 100) / 150,
                             .antialias = next_random(random) % 6 == 0,
                             .ignored = ignored,
                             .ignored_count = next_random(random) % 4};
}

/* A second picture: the same, another, or one of another size; stored in the same way or in another. */
static stored_png other_picture(uint64_t *random, const stored_png *first)
{
    stored_png other = *first;
    other.spoiled += within(random, 0, 30);
    if (next_random(random) % 3 == 0)
        other.storage = png_storage_at(within(random, 0, PNG_STORAGES - 1));
    if (next_random(random) % 8 == 0)
        other.seed++;
    if (next_random(random) % 8 == 0)
        other.height += within(random, -1, 60);
    if (next_random(random) % 8 == 0)
        other.width += within(random, -1, 60);
    return other;
}

/* So large that they have many bands, or small. */
static void save_pair(uint64_t *random, int i, char *paths[2])
{
    stored_png pictures[2] = {random_picture(random, i % PNG_STORAGES)};
    if (i % 8 == 0)
        pictures[0].width = within(random, 300, 700);
    if (i % 16 == 0)
        pictures[0].height = within(random, 200, 500);
    pictures[0].width += 2;
    pictures[0].height += 2;
    pictures[1] = other_picture(random, &pictures[0]);
    for (int side = 0; side < 2; side++)
        stored_png_save(&pictures[side], paths[side]);
}

static void findings_equal_those_of_whole_pictures(void **state)
{
    char *paths[2] = {strdup(temp_file(*state, "a.png")), strdup(temp_file(*state, "b.png"))};
    uint64_t random = 3;
    for (int i = 0; i < 3 * PNG_STORAGES; i++) {
        const image_tolerance tolerance = random_tolerance(&random);
        save_pair(&random, i, paths);
        assert_compared_alike(paths, &tolerance);
    }
    free(paths[0]);
    free(paths[1]);
}

static void first_of_two_damaged_files_is_reported(void **state)
{
    char *paths[2] = {strdup(temp_file(*state, "a.png")), strdup(temp_file(*state, "b.png"))};
    uint64_t random = 4;
    for (int i = 0; i < 4 * PNG_STORAGES; i++) {
        const image_tolerance tolerance = random_tolerance(&random);
        const int which = within(&random, 1, 3);
        save_pair(&random, i, paths);
        for (int side = 0; side < 2; side++)
            if (which & (1 << side))
                damage(paths[side], &random);
        assert_compared_alike(paths, &tolerance);
    }
    free(paths[0]);
    free(paths[1]);
}

/* ---- Memory -------------------------------------------------------------------------------------------------- */

enum { WIDE = 2000, HIGH = 3000 };

/* A row of a picture that never is in memory. */
static const uint8_t *draw_row(int y, void *context)
{
    static uint8_t row[3 * WIDE];
    const int phase = *(const int *)context;
    for (int i = 0; i < 3 * WIDE; i++)
        row[i] = (uint8_t)(y % 100 < 3 ? i * phase : y / 100);
    return row;
}

/* 18 MB each. This comes first: what a process had at most only grows. */
static void large_pictures_are_not_held_in_memory(void **state)
{
    char *paths[2] = {strdup(temp_file(*state, "a.png")), strdup(temp_file(*state, "b.png"))};
    const diff_frame frames[2] = {{.path = paths[0]}, {.path = paths[1]}};
    const diff_options options = diff_options_default();
    diff_pair pair = {.a = &frames[0], .b = &frames[1]};
    struct rusage before, after;
    octreel_error error;
    for (int phase = 0; phase < 2; phase++) {
        const image_rows rows = {.width = WIDE, .height = HIGH, .row = draw_row, .context = &phase};
        assert_true(image_write_png_rows(&rows, paths[phase], &error));
    }
    assert_int_equal(getrusage(RUSAGE_SELF, &before), 0);
    compare_pixels(&pair, &options);
    assert_int_equal(getrusage(RUSAGE_SELF, &after), 0);
    assert_int_equal(pair.finding, FOUND_PIXELS);
    assert_true(after.ru_maxrss - before.ru_maxrss < 6000); /* kilobytes */
    free(paths[0]);
    free(paths[1]);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, temp_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(large_pictures_are_not_held_in_memory),  WITH_FOLDER(rows_equal_those_of_the_whole_picture),
        WITH_FOLDER(damaged_files_fail_with_the_same_error), WITH_FOLDER(findings_equal_those_of_whole_pictures),
        WITH_FOLDER(first_of_two_damaged_files_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
