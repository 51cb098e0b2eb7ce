/* SPDX-License-Identifier: MIT */
/* texts.h - the texts of help topics: CMake turns formats/NAME.txt into an array each. */
#ifndef CLI_TEXTS_H
#define CLI_TEXTS_H

/* ASCII, ended by a zero. */
extern const char session_text[], recording_text[], baseline_text[];

#endif
