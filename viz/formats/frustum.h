/* SPDX-License-Identifier: MIT */
/* frustum.h - half-spaces in sessions and ticks: a list of [nx, ny, nz, offset]. */
#ifndef FORMATS_FRUSTUM_H
#define FORMATS_FRUSTUM_H

#include "json_table.h"

extern const json_codec json_frustum; /* a codec of an octree_frustum */

#endif
