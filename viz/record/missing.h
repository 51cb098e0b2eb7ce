/* missing.h - what of a recording is not there. */
#ifndef RECORD_MISSING_H
#define RECORD_MISSING_H

#include "chunks.h"

/* True when each of the ticks [0, ticks) has a line in a part, and each every-th a frame, and the folder has no other
 * frames. Else one sentence that names what is missing or odd. */
bool missing_nothing(const char *folder, const chunk_list *parts, uint64_t ticks, uint64_t every, octreel_error *error);

/* The frames of the ticks [first, last) that are not in the folder, in words: "frame_000003.png" or "frame_000003.png,
 * frame_000007.png to frame_000009.png and 12 more"; empty when there are none. Returns their number. */
#define MISSING_TEXT 256
uint64_t missing_frames(const char *folder, uint64_t first, uint64_t last, uint64_t every, char text[MISSING_TEXT]);

#endif
