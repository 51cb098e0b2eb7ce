/* SPDX-License-Identifier: MIT */
/* images.c - see images.h. */
#include "images.h"

#include <string.h>

image_twins make_twins(int width, int height)
{
    static const image_palette palette = {{{10, 20, 30}, {255, 255, 255}, {0, 200, 7}, {0, 200, 7}}, 4};
    image_twins twins;
    assert_true(image_create(&twins.indexed, width, height, 1));
    assert_true(image_create(&twins.rgb, width, height, 3));
    twins.indexed.palette = palette;
    for (int n = 0; n < width * height; n++) {
        uint8_t index = (uint8_t)((n / 5 + n % 7) % 4);
        twins.indexed.pixels[n] = index;
        memcpy(twins.rgb.pixels + 3 * n, &palette.colors[index], 3);
    }
    return twins;
}

void release_twins(image_twins *twins)
{
    image_release(&twins->indexed);
    image_release(&twins->rgb);
}

void assert_written(const image *image, const char *path)
{
    octreel_error error = {""};
    if (!image_write_png(image, path, NULL, 0, &error))
        fail_msg("%s", error.text);
}

image assert_read(const char *path)
{
    image read;
    octreel_error error = {""};
    if (!image_read_png(path, &read, &error))
        fail_msg("%s", error.text);
    return read;
}

image assert_read_rgb(const char *path)
{
    image read = assert_read(path), rgb;
    assert_true(image_create(&rgb, read.width, read.height, 3));
    for (int n = 0; n < read.width * read.height; n++) {
        const image_color color = image_color_at(&read, n % read.width, n / read.width);
        memcpy(rgb.pixels + 3 * n, &color, 3);
    }
    image_release(&read);
    return rgb;
}

void assert_sentence(const octreel_error *error, const char *path, const char *reason)
{
    size_t length = strlen(path);
    assert_memory_equal(error->text, path, length);
    assert_memory_equal(error->text + length, ": ", 2);
    assert_true(strlen(error->text) > length + 2);
    assert_null(strchr(error->text, '\n'));
    assert_non_null(strstr(error->text, reason));
}
