/* claim.h - whether a folder that is not empty may be filmed into: nothing in it is replaced that is not of the
 * recording that goes on there. */
#ifndef RECORD_CLAIM_H
#define RECORD_CLAIM_H

#include "film.h"

/* True for a folder without a recording, for one with this recording.json and session.json (that they are these is
 * checked elsewhere), whose frames may be damaged, and for one in which one of both is missing, but each frame says
 * that it is of this session (or of a program that died before it had one) and view. Frames of ticks that the recording
 * does not film are refused. Else false, and a sentence; nothing is written. Where a file is missing this costs a play
 * of the session, without drawing. */
bool claim_folder(const octree_session *session, uint64_t session_digest, const film_options *options,
                  octreel_error *error);

#endif
