/* SPDX-License-Identifier: MIT */
/* A program may have functions of any name. These have names that the library has inside, and it never calls them. */
#include <octree/octree.h>

#include <stdlib.h>

void insert_point(void);
void find_point(void);
void list_append(void);

void insert_point(void)
{
    abort();
}

void find_point(void)
{
    abort();
}

void list_append(void)
{
    abort();
}

int main(void)
{
    const octree_def def = octree_def_default();
    const octree_point many[] = {{{1, 2, 3}, 1}, {{4, 5, 6}, 2}};
    octree *tree;
    if (octree_create(&def, &tree) != OCTREE_OK)
        return 1;
    const bool done = octree_insert_many(tree, many, 2, NULL, NULL) == OCTREE_OK &&
                      octree_insert(tree, (double[]){7, 8, 9}, 3) == OCTREE_OK &&
                      octree_remove(tree, (double[]){4, 5, 6}, 2) == OCTREE_OK && octree_count(tree) == 2;
    octree_destroy(tree);
    return done ? 0 : 1;
}
