/* SPDX-License-Identifier: MIT */
/* verified.h - a short recording, and what verifying says of it, for tests. */
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

/* The folder of the test anew, empty. */
void start_over(void **state);

/* Verify; the test fails, with the sentence, when it cannot be done. */
verify_report verify(const place *folder);

/* No finding, and these many ticks and frames. */
void assert_identical(const place *folder, uint64_t ticks, uint64_t frames);

/* One finding in a short recording, about this tick, whose sentence holds `part`; the ticks before it are the same. */
verify_report assert_found(const place *folder, verify_kind kind, uint64_t tick, const char *part);

/* It cannot be verified, and the sentence holds `part`. */
void assert_not_verified(const place *folder, const char *part);

#endif
