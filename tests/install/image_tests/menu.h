/* SPDX-License-Identifier: MIT */
/* menu.h - draws the picture of the example projects: a disc on a gradient. */
#ifndef MENU_H
#define MENU_H

#include <stdlib.h>

enum { MENU_WIDTH = 64, MENU_HEIGHT = 48 };

/* Returns MENU_HEIGHT rows of r, g, b, alpha, from the top down. The environment variable MENU_SHIFT moves the disc to
 * the right by this number of pixels, as a bug would. */
static inline const unsigned char *draw_menu(void)
{
    static unsigned char pixels[MENU_HEIGHT][MENU_WIDTH][4];
    const char *shift = getenv("MENU_SHIFT");
    const int center_x = MENU_WIDTH / 2 + (shift ? atoi(shift) : 0), center_y = MENU_HEIGHT / 2;
    for (int y = 0; y < MENU_HEIGHT; y++) {
        for (int x = 0; x < MENU_WIDTH; x++) {
            const int in_disc = (x - center_x) * (x - center_x) + (y - center_y) * (y - center_y) < 15 * 15;
            pixels[y][x][0] = (unsigned char)(in_disc ? 250 : 2 * x);
            pixels[y][x][1] = (unsigned char)(in_disc ? 220 : 3 * y);
            pixels[y][x][2] = 90;
            pixels[y][x][3] = 255;
        }
    }
    return &pixels[0][0][0];
}

#endif
