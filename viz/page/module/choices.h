/* SPDX-License-Identifier: MIT */
/* choices.h - writes the choices that the page offers in its controls. Private to viz/page/module. */
#ifndef WEB_CHOICES_H
#define WEB_CHOICES_H

#include <stdbool.h>
#include <stdio.h>

/* Write the choices as one JSON object: the possible values of each view option, the layers with their colours, and the
 * query kinds with their members. Returns true. */
bool choices_write(FILE *out);

#endif
