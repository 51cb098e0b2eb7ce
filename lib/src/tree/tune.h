/* tune.h - a capacity that is chosen by itself. Private. */
#ifndef OCTREE_TUNE_H
#define OCTREE_TUNE_H

#include "tree.h"

/* With fewer points there is nothing to gain. */
#define TUNE_LEAST 1024

/* After points have been inserted: choose the capacity if it is time to. Without memory it stays as it is. */
void tune_if_due(octree *tree);

#endif
