/* SPDX-License-Identifier: MIT */
/* film_again.h - checks that filming the session of a recorder's recording yields the same recording. */
#ifndef FILM_AGAIN_H
#define FILM_AGAIN_H

#include "files.h"

#include <stdint.h>

/* The test fails unless the recording is complete, verifies, has this number of ticks, and filming its session with its
 * view into `again` yields the same bytes. */
void assert_films_again(const place *folder, const place *again, uint64_t ticks);

/* Store the tree digest of each line of ticks.jsonl in digests[0 .. room - 1], 0 for a gap. Returns their number. The
 * test fails if a line has a refusal: every point of the program's tree must have been accepted. */
size_t tree_digests(const char *folder, uint64_t *digests, size_t room);

#endif
