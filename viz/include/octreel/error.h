/* SPDX-License-Identifier: MIT */
/* error.h - what could not be done, and why: the one type of error of all that films. */
#ifndef OCTREEL_ERROR_H
#define OCTREEL_ERROR_H

/* A failed operation writes one sentence here, such as "flight: cannot create the folder: Permission denied". */
typedef struct octreel_error {
    char text[512];
} octreel_error;

#endif
