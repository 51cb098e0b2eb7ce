/* SPDX-License-Identifier: MIT */
/* session_texts.h - sessions read from texts, and written into them. */
#ifndef TESTS_SESSION_TEXTS_H
#define TESTS_SESSION_TEXTS_H

#include "session_file.h"

/* The test fails with the reader's sentence where it is refused. To be released. */
session_file session_of_text(const char *text);

/* `values` may be null. The caller frees it. */
char *text_of_session(const octree_session *session, const point_values *values);

#endif
