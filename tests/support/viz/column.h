/* SPDX-License-Identifier: MIT */
/* column.h - the words and swatches beside a picture, as tests look at them. */
#ifndef SUPPORT_VIZ_COLUMN_H
#define SUPPORT_VIZ_COLUMN_H

#include "scene.h"

/* The first text of the column that has these words in it, or null. */
const scene_label *find_text(const scene *s, const char *text);

/* Whether there is one. */
bool says(const scene *s, const char *text);

/* The pixel at which the words of the legend begin. */
int legend_words(const scene *s);

/* Whether a panel has this colour. */
bool has_swatch(const scene *s, unsigned role);

/* Elements have their own ids, texts end, all begins within the column. */
void check_place(const scene *s);

#endif
