/* SPDX-License-Identifier: MIT */
/* explained.h - films pairs of recordings for tests, compares them, and explains their differences. */
#ifndef EXPLAINED_H
#define EXPLAINED_H

#include "explain.h"
#include "galleries.h"
#include "recordings.h"

/* Film a session into a folder of this name; `how` is null for a small film. */
place film_into(const temp_folder *own, const char *name, const octree_session *session, const film_options *how);

/* Film a short session with these keys twice, into the folders a and b. Returns a. */
place film_twice(const temp_folder *own, const char *keys, place *b);

/* Compare two recordings and explain the first `most` pairs. */
comparison_of assert_explained(const place *a, const place *b, uint64_t most);

#endif
