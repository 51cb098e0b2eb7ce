/* SPDX-License-Identifier: MIT */
/* choices.h - the choices that the page offers in its controls. Private to this folder. */
#ifndef WEB_CHOICES_H
#define WEB_CHOICES_H

#include <stdbool.h>
#include <stdio.h>

/* Write the choices of a view, its layers with their colours, and the query kinds with their members, as JSON. Returns
 * true. */
bool choices_write(FILE *out);

#endif
