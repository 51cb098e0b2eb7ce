/* address.c - node addresses: their octants, their text, their boxes. */
#include "plane.h"

#include <string.h>

bool is_address(octree_address address)
{
    unsigned bits = 0;
    for (octree_address rest = address; rest > 1; rest >>= 1)
        bits++;
    return address != 0 && bits % 3 == 0;
}

unsigned octree_address_depth(octree_address address)
{
    unsigned depth = 0;
    for (; address >= 8; address >>= 3)
        depth++;
    return depth;
}

unsigned octree_address_octant(octree_address address, unsigned level)
{
    const unsigned depth = octree_address_depth(address);
    return level < depth ? (unsigned)(address >> 3 * (depth - 1 - level)) & 7 : 0;
}

char *octree_address_format(octree_address address, char text[OCTREE_ADDRESS_TEXT])
{
    const unsigned depth = octree_address_depth(address);
    char *at = text;
    for (unsigned level = 0; level < depth; level++) {
        if (level > 0)
            *at++ = '/';
        *at++ = (char)('0' + octree_address_octant(address, level));
    }
    *at = 0;
    return depth ? text : strcpy(text, "root");
}

bool octree_address_parse(const char *text, octree_address *address)
{
    if (!text || !address)
        return false;
    *address = OCTREE_ROOT;
    if (strcmp(text, "root") == 0 || strcmp(text, "/") == 0)
        return true;
    octree_address parsed = OCTREE_ROOT;
    for (unsigned depth = 0; depth < OCTREE_MAX_DEPTH; depth++, text += 2) {
        if (text[0] < '0' || text[0] > '7')
            return false;
        parsed = parsed << 3 | (octree_address)(text[0] - '0');
        if (text[1] == 0) {
            *address = parsed;
            return true;
        }
        if (text[1] != '/')
            return false;
    }
    return false;
}

octree_box octree_cell_box(const octree_box *world, octree_address address)
{
    axis axes[3];
    for (int i = 0; i < 3; i++)
        axes[i] = axis_make(world->min[i], world->max[i]);
    cell c = {{0, 0, 0}, 0};
    const unsigned depth = is_address(address) ? octree_address_depth(address) : 0;
    while (c.depth < depth)
        c = cell_child(c, octree_address_octant(address, c.depth));
    return cell_bounds(axes, c);
}
