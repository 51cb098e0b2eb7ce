#include "undo_log.h"

static bool note(undo_log *log, list *nodes, node n)
{
    node *entry = list_append(&log->store->memory, nodes, sizeof *entry);
    if (entry)
        *entry = n;
    return entry != NULL;
}

/* Free a node's own block; of a group the node has as many octants as there are siblings. */
static void free_block(store *s, node n)
{
    if (n.octants)
        pool_give(&s->nodes, n.below, bits_count8(n.octants));
    else
        leaf_release(s, &n);
}

/* Note a block that was just made; false when there is no memory, the block is then freed. */
static bool note_made(undo_log *log, node n)
{
    if (note(log, &log->made, n))
        return true;
    free_block(log->store, n);
    return false;
}

node *undo_log_make_group(undo_log *log, unsigned count)
{
    void *group = pool_take(&log->store->nodes, count);
    const node parent = {.below = group, .octants = (uint8_t)((1u << count) - 1)};
    return group && note_made(log, parent) ? group : NULL;
}

bool undo_log_make_leaf(undo_log *log, node *leaf, uint32_t count)
{
    return leaf_create(log->store, leaf, count) && (count == 0 || note_made(log, *leaf));
}

bool undo_log_replace(undo_log *log, const node *n)
{
    return !n->below || note(log, &log->replaced, *n);
}

static bool replace_all(undo_log *log, const node *n)
{
    const unsigned children = bits_count8(n->octants);
    bool ok = undo_log_replace(log, n);
    for (unsigned i = 0; ok && i < children; i++)
        ok = replace_all(log, &children_of(n)[i]);
    return ok;
}

bool undo_log_collapse(undo_log *log, node *n)
{
    node leaf;
    if (!undo_log_make_leaf(log, &leaf, n->count))
        return false;
    node_gather(&leaf, n, NULL);
    if (!replace_all(log, n))
        return false;
    *n = leaf;
    return true;
}

static void end(undo_log *log, const list *freed)
{
    const node *nodes = freed->items;
    for (size_t i = 0; i < freed->count; i++)
        free_block(log->store, nodes[i]);
    list_release(&log->store->memory, &log->made, sizeof(node));
    list_release(&log->store->memory, &log->replaced, sizeof(node));
}

void undo_log_commit(undo_log *log)
{
    end(log, &log->replaced);
}

void undo_log_abandon(undo_log *log)
{
    end(log, &log->made);
}
