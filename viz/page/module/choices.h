/* SPDX-License-Identifier: MIT */
/* choices.h - the choices that the page offers in its controls. Private to this folder. */
#ifndef WEB_CHOICES_H
#define WEB_CHOICES_H

#include <stdbool.h>
#include <stdio.h>

/* The choices of a view, its layers with their colours, and the kinds of queries with what they read, as JSON. True. */
bool choices_write(FILE *out);

#endif
