/* SPDX-License-Identifier: MIT */
/* no_gl.c - replaces gl_surface.c in programs that are built without GL, and in a recording's web page. */
#include "fill.h"

surface *surface_open(int width, int height, const renderer_choice *choice, octreel_error *error)
{
    (void)width;
    (void)height;
    (void)choice;
    error_set(error, "this program was built without OpenGL");
    return NULL;
}
