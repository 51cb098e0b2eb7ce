/* SPDX-License-Identifier: MIT */
/* texts.h - the texts of help topics. CMake turns each file formats/NAME.txt into an array. */
#ifndef CLI_TEXTS_H
#define CLI_TEXTS_H

/* ASCII text, zero-terminated. */
extern const char session_text[], recording_text[], baseline_text[];

#endif
