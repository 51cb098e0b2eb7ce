/* journal.c - see journal.h. */
#include "undo_log.h"
#include "leaf.h"

/* What is given back: a group of nodes, or a leaf's points. */
typedef struct entry {
    node node; /* its block alone; of a group as many octants as there are nodes */
} entry;

static bool note(journal *j, list *entries, node n)
{
    entry *e = list_append(&j->tree->memory, entries, sizeof *e);
    if (e)
        *e = (entry){n};
    return e != NULL;
}

static void give_back(octree *tree, node n)
{
    if (n.octants)
        pool_give(&tree->nodes, n.below, bits_count8(n.octants));
    else
        leaf_release(tree, &n);
}

node *journal_make_group(journal *j, unsigned count)
{
    node group = {.octants = (uint8_t)((1u << count) - 1)};
    group.below = pool_take(&j->tree->nodes, count);
    if (!group.below)
        return NULL;
    if (note(j, &j->made, group))
        return group.below;
    give_back(j->tree, group);
    return NULL;
}

bool journal_make_leaf(journal *j, node *leaf, uint32_t count)
{
    if (!leaf_create(j->tree, leaf, count))
        return false;
    if (count == 0 || note(j, &j->made, *leaf))
        return true;
    leaf_release(j->tree, leaf);
    return false;
}

bool journal_replace(journal *j, const node *n)
{
    return !n->below || note(j, &j->replaced, *n);
}

/* And all that is below it too. */
static bool replace_all(journal *j, const node *n)
{
    const node *pending[STACK_ROOM];
    size_t size = 0;
    pending[size++] = n;
    while (size > 0) {
        const node *next = pending[--size];
        if (!journal_replace(j, next))
            return false;
        for (unsigned i = bits_count8(next->octants); i-- > 0;)
            pending[size++] = &children_of(next)[i];
    }
    return true;
}

bool journal_collapse(journal *j, node *n)
{
    node leaf;
    if (!journal_make_leaf(j, &leaf, n->count))
        return false;
    leaf_gather(&leaf, n, NULL);
    if (!replace_all(j, n))
        return false;
    *n = leaf;
    return true;
}

static void end(journal *j, const list *given_back)
{
    const entry *entries = given_back->items;
    for (size_t i = 0; i < given_back->count; i++)
        give_back(j->tree, entries[i].node);
    list_release(&j->tree->memory, &j->made, sizeof(entry));
    list_release(&j->tree->memory, &j->replaced, sizeof(entry));
}

void journal_commit(journal *j, node root)
{
    j->tree->root = root;
    j->tree->version++;
    end(j, &j->replaced);
}

void journal_abandon(journal *j)
{
    end(j, &j->made);
}
