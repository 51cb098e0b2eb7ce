/* SPDX-License-Identifier: MIT */
/* galleries.h - folders of small pictures for tests of comparisons, and sides opened on them. */
#ifndef GALLERIES_H
#define GALLERIES_H

#include "groups.h"
#include "files.h"

#define GALLERY_WIDTH 24
#define GALLERY_HEIGHT 16

/* A picture whose pixels follow from `seed`; release it. */
image gallery_picture(uint64_t seed);

/* Write the picture of a seed. In `spoilt` of its pixels (at most 16, from the start of row 3), green is one level off.
 */
void gallery_write(const char *path, uint64_t seed, int spoilt);

/* Make a folder in a test's folder. For each of the names, which are separated by blanks and may lie in subfolders,
 * write a picture; picture i has the seed i. */
place gallery_make(const temp_folder *in, const char *folder, const char *names);

/* The test fails with the error if a side cannot be opened, or if two sides cannot be compared. */
diff_side assert_side(const char *path);

/* Two sides, the result of their comparison, and its explanation. */
typedef struct comparison_of {
    diff_side a, b;
    diff_result result;
    explanation why;     /* zero until the test explains */
    frame_groups groups; /* zero until the test groups */
} comparison_of;

comparison_of assert_compared(const char *a, const char *b, const diff_options *options);

/* Group the frames by finding and cause; with `each`, every frame is a group of its own. */
const frame_groups *group_frames(comparison_of *made, bool each);

/* List the groups, one line each: the names of all frames, or with `others`, all but the first. The caller frees it. */
char *list_groups(comparison_of *made, bool each, bool others);
void assert_groups(comparison_of *made, bool each, const char *expected);

/* The sentence of a pair of this name, or null. */
const char *find_cause_text(const comparison_of *made, const char *name);

/* Set the sentence of the i-th pair, as an explanation would. */
void set_cause(comparison_of *made, size_t i, const char *text);
void comparison_release(comparison_of *made);

/* The finding for the pair with a name; the test fails if there is no such pair. */
diff_finding find_finding(const comparison_of *made, const char *name);

/* The test fails unless the comparison is refused with a sentence that contains `part`. */
void assert_not_compared(const char *a, const char *b, const diff_options *options, const char *part);

#endif
