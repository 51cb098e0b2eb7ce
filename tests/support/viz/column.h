/* SPDX-License-Identifier: MIT */
/* column.h - finds texts and swatches in the column beside a picture. */
#ifndef SUPPORT_VIZ_COLUMN_H
#define SUPPORT_VIZ_COLUMN_H

#include "scene.h"

/* The first label of the column that contains a text, or null. */
const scene_label *find_text(const scene *s, const char *text);

/* Whether a label of the column contains a text. */
bool has_label_with(const scene *s, const char *text);

/* The x coordinate at which the texts of the legend begin, in pixels. */
int find_legend_text_x(const scene *s);

/* Whether a panel has this colour. */
bool has_swatch(const scene *s, unsigned role);

/* Whether a label is a part of the caption. */
bool is_in_caption(const scene *s, const scene_label *label);

/* The test fails unless ids are unique, texts are terminated, and every element begins in the column or the caption. */
void assert_inside_column(const scene *s);

#endif
