/* SPDX-License-Identifier: MIT */
/* error.h - the error type of Octreel's functions. The functions of the octree library return octree_status instead. */
#ifndef OCTREEL_ERROR_H
#define OCTREEL_ERROR_H

/* An error. A function that fails writes one sentence here, such as "flight: cannot create the folder: Permission
 * denied". */
typedef struct octreel_error {
    char text[512];
} octreel_error;

#endif
