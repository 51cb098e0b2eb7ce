/* SPDX-License-Identifier: MIT */
/* draw_menu.c - a program that writes pictures: draw_menu FILE... writes the same picture to each file, then exits with
 * the status in the environment variable MENU_STATUS. An argument that begins with "word=" must be ODD_WORD. */
#include "../menu.h"

#include <png.h>
#include <stdio.h>
#include <string.h>

#define ODD_WORD "word=a;b  'c' \"d\" $HOME \\e (f)"

static int write_picture(const char *path)
{
    png_image image = {
        .version = PNG_IMAGE_VERSION, .width = MENU_WIDTH, .height = MENU_HEIGHT, .format = PNG_FORMAT_RGBA};
    return png_image_write_to_file(&image, path, 0, draw_menu(), 0, NULL);
}

int main(int argc, char **argv)
{
    const char *status = getenv("MENU_STATUS");
    for (int i = 1; i < argc; i++) {
        const int is_word = strncmp(argv[i], "word=", 5) == 0;
        if (is_word ? strcmp(argv[i], ODD_WORD) != 0 : !write_picture(argv[i])) {
            fprintf(stderr, "draw_menu: refused: %s\n", argv[i]);
            return 2;
        }
    }
    return status ? atoi(status) : 0;
}
