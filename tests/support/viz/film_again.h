/* SPDX-License-Identifier: MIT */
/* film_again.h - checks that filming the session of a recorder's recording yields the same recording. */
#ifndef FILM_AGAIN_H
#define FILM_AGAIN_H

#include "files.h"

#include <stdint.h>

/* The recording is whole, verifies, has so many ticks, and is to the byte what the session and the view in it are
 * filmed to anew, in `again`. */
void assert_films_again(const place *folder, const place *again, uint64_t ticks);

/* The digest of the tree that each line of ticks.jsonl tells, into digests[0 .. room - 1]; 0 for a gap; their number.
 * No line tells of a refusal: what the program's tree took is taken. */
size_t tree_digests(const char *folder, uint64_t *digests, size_t room);

#endif
