/* SPDX-License-Identifier: MIT */
/* session_texts.h - converts texts to sessions and sessions to texts. */
#ifndef TESTS_SESSION_TEXTS_H
#define TESTS_SESSION_TEXTS_H

#include "session_file.h"

/* Read a session from text; the caller releases it. The test fails with the error if it is refused. */
session_file session_of_text(const char *text);

/* The test fails unless the session s.json with this text is refused with this sentence. */
void assert_session_refused(const char *text, const char *sentence);

/* Write a session as text, which the caller frees. `values` may be null. */
char *text_of_session(const octree_session *session, const point_values *values);

#endif
