/* SPDX-License-Identifier: MIT */
/* texts.h - what files hold, for people: formats/NAME.txt, as CMake makes an array of each. */
#ifndef CLI_TEXTS_H
#define CLI_TEXTS_H

/* ASCII, with their final zeros. */
extern const char session_text[], recording_text[], baseline_text[];

#endif
