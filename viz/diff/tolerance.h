/* SPDX-License-Identifier: MIT */
/* tolerance.h - the tolerances by name: each is an option of octreel diff, --max-delta 0.02, and a key of a rule in a
 * baseline, max-delta=0.02. */
#ifndef DIFF_TOLERANCE_H
#define DIFF_TOLERANCE_H

#include "image_compare.h"
#include "octreel/error.h"

/* Return the index of the tolerance with this name, such as "max-delta", or -1. */
int tolerance_find(const char *name);

/* Return the name of the i-th tolerance. After the last, return null. */
const char *tolerance_name(int i);

/* Read the value of the i-th tolerance into *into. `text` is null if no value was given. Return false with an error if
 * the value is invalid; the error begins with `place` and the name of the tolerance. The rectangles that were read
 * belong to *into; tolerance_release() frees them. */
bool tolerance_read(int i, const char *text, const char *place, image_tolerance *into, octreel_error *error);
void tolerance_release(image_tolerance *tolerance);

/* Return whether the tolerance forgives and ignores nothing. */
bool tolerance_is_exact(const image_tolerance *tolerance);

/* Let *tolerance forgive also what `by` forgives: of each number, the larger one counts. Rectangles are not added. */
void tolerance_widen(image_tolerance *tolerance, const image_tolerance *by);

/* Return whether pixels_per_degree was given without `flip`, so that it has no effect. */
bool tolerance_has_idle_resolution(const image_tolerance *tolerance);

#endif
