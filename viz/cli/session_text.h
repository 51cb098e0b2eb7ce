/* SPDX-License-Identifier: MIT */
/* session_text.h - what a session file holds, for people: formats/session.txt, as CMake makes an array of it. */
#ifndef CLI_SESSION_TEXT_H
#define CLI_SESSION_TEXT_H

/* ASCII, with its final zero. */
extern const char session_text[];

#endif
