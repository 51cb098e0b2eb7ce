/* view_file.h - a view as members of recording.json.
 *
 *   "width": 1280, "height": 720, "camera": "iso", "layers": ["world", "nodes", ...], "color_by": "depth",
 *   "lod": 2, "budget": 250000, "aa": 1,
 * and, where something of the tree is left out,
 *   "slice": {"z": 100}, "depths": [2, 5], "leaves": true, "region": {"min": [x, y, z], "max": [x, y, z]}
 * where the tree is drawn as a tree too,
 *   "diagram": "beside"
 * where nodes have their paths on them,
 *   "labels": true
 * and, where the camera frames a box and not the world,
 *   "fit": {"min": [x, y, z], "max": [x, y, z]}
 */
#ifndef RECORD_VIEW_FILE_H
#define RECORD_VIEW_FILE_H

#include "file.h"
#include "json_write.h"
#include "view.h"

/* The version of recording.json that is written, and the only one that is read. 2: scene digests hash names. */
#define RECORDING_VERSION 2

/* Write the members into an object that has begun. */
void view_write(json_writer *w, const view *v);

/* Read the view of a recording, which is the folder that its recording.json is in. Members that are not there are off.
 * False, with file, line and reason, when it is none. */
bool view_read(const char *folder, view *v, octreel_error *error);

/* The same, and each how many ticks a frame was filmed. */
bool view_read_recording(const char *folder, view *v, uint64_t *every, octreel_error *error);

#endif
