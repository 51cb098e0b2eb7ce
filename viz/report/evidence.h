/* evidence.h - a folder that shows what a comparison found: pictures of each pair that differs, and report.html. */
#ifndef DIFF_EVIDENCE_H
#define DIFF_EVIDENCE_H

#include "evidence_pictures.h"

#define EVIDENCE_PAGE "report.html"

typedef struct evidence {
    const char *folder; /* not owned */
    unsigned *pictures; /* of each pair, a bit (1 << evidence_picture) for each that is there; owned */
} evidence;

/* Make the folder, or empty it of an earlier comparison's evidence, so that what is in it is of this one alone. Refused
 * is a folder that holds anything else, or that is or holds what is compared. */
bool evidence_prepare(const char *folder, const diff_side *a, const diff_side *b, octreel_error *error);

/* Draw each pair that differs, one after the other. */
bool evidence_collect(evidence *e, const char *folder, const diff_result *result, const diff_options *options,
                      octreel_error *error);
void evidence_release(evidence *e);

/* The path of a picture of the i-th pair: null when it is not there, or there is no memory; the caller frees it. */
char *evidence_path(const evidence *e, const diff_result *result, size_t i, evidence_picture picture);

#endif
