/* who_drew.h - a renderer in one phrase: context, renderer and version. */
#ifndef RECORD_WHO_DREW_H
#define RECORD_WHO_DREW_H

#include "renderer.h"

#include <stddef.h>

/* The renderer at hand. Returns `text`. */
char *who_draws(const renderer_info *info, char *text, size_t size);

/* The one that renderer.json names; "an unknown renderer" where it names none. Returns `text`. */
char *who_drew(const char *folder, char *text, size_t size);

#endif
