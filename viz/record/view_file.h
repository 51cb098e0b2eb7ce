/* view_file.h - a view as members of recording.json.
 *
 *   "width": 1280, "height": 720, "camera": "iso", "layers": ["world", "nodes", ...], "color_by": "depth",
 * and, where something of the tree is left out,
 *   "slice": {"z": 100}, "depths": [2, 5], "leaves": true, "region": {"min": [x, y, z], "max": [x, y, z]}
 */
#ifndef RECORD_VIEW_FILE_H
#define RECORD_VIEW_FILE_H

#include "json_write.h"
#include "view.h"

/* Write the members into an object that has begun. */
void view_write(json_writer *w, const view *v);

#endif
