/* SPDX-License-Identifier: MIT */
/* verified.h - films a short recording, and checks the report of `octreel verify`. */
#ifndef VERIFIED_H
#define VERIFIED_H

#include "files.h"
#include "fixture.h"
#include "verify.h"

#define SHORT_TICKS 14
#define SHORT_EVERY 3
#define SHORT_FRAMES 5

/* The beginning of the paper's session: ticks 0 to 13, frames of 0, 3, 6, 9 and 12. */
place film_short(const temp_folder *own);

/* Empty the folder of the test. */
void empty_test_folder(void **state);

/* Verify a recording; the test fails with the error if that is impossible. */
verify_report verify(const place *folder);

/* The test fails unless there is no finding, and this number of ticks and frames. */
void assert_identical(const place *folder, uint64_t ticks, uint64_t frames);

/* The test fails unless verifying finds one difference, at this tick, with a sentence that contains `part`. */
verify_report assert_found(const place *folder, verify_kind kind, uint64_t tick, const char *part);

/* The test fails unless verifying is refused with a sentence that contains `part`. */
void assert_not_verified(const place *folder, const char *part);

#endif
